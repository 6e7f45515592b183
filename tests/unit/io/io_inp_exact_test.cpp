// Numbers of .inp, of which Abaqus and CalculiX read 20 characters.
#include <gtest/gtest.h>

#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <random>
#include <sstream>

#include "holdfast/io.h"
#include "io/exact_nodes.h"
#include "io_samples.h"

namespace holdfast::io_inp_exact_test {
namespace {

using namespace samples;

class InpExact : public ::testing::Test, protected AsInp {};

double value_of(const std::string& text) {
  double value = 0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  EXPECT_EQ(result.ptr, text.data() + text.size()) << text;
  return value;
}

TEST_F(InpExact, NumbersHave20CharactersAtMost) {
  std::mt19937_64 random(7);
  for (int k = 0; k < 20000; ++k) {
    const int exponent = static_cast<int>(random() % 2000) - 1060;
    const double x =
        std::ldexp(static_cast<double>(random() >> 11), k % 2 == 0 ? exponent - 40 : -60 + k % 40);
    if (!std::isfinite(x)) continue;
    for (const double value : {x, -x}) {
      const std::string text = io::short_real(value, io::kInpCharacters);
      EXPECT_LE(text.size(), 20u) << text;
      EXPECT_NEAR(value_of(text), value, std::fabs(value) * 1e-12);
    }
  }
  for (const double value : {0.0, -0.0, 1.0, -0.1, -0.012345678901234567, 0.0012345678901234567, 1e300})
    EXPECT_EQ(value_of(io::short_real(value, io::kInpCharacters)), value);
  EXPECT_LE(io::short_real(-std::numeric_limits<double>::max(), io::kInpCharacters).size(), 20u);
  EXPECT_TRUE(
      std::isfinite(value_of(io::short_real(std::numeric_limits<double>::max(), io::kInpCharacters))));
}

TEST_F(InpExact, WhatIsRoundedReadsBackAsItWas) {
  Volume written;
  written.vertices = {
      {-4.0768646280975547e-14, 0, 0}, {1, -0.0012345678901234567, 0}, {0, 1, 0}, {0, 0, 1.25}};
  written.tetrahedra = {{0, 1, 2, 3}};
  written.regions = {0};
  const auto file = std::filesystem::path(::testing::TempDir()) / "inp_exact.inp";
  write_volume(file, written);
  std::stringstream text;
  text << std::ifstream(file).rdbuf();
  EXPECT_EQ(read_volume(file).vertices, written.vertices);
  std::filesystem::remove(file);

  std::string line, nodes = text.str();
  std::istringstream lines(nodes.substr(nodes.find("*NODE\n") + 6));
  for (int k = 0; k < 4 && std::getline(lines, line); ++k)
    for (std::size_t begin = 0, end = 0; end != std::string::npos; begin = end + 2) {
      end = line.find(", ", begin);
      EXPECT_LE(line.substr(begin, end == std::string::npos ? end : end - begin).size(), 20u) << line;
    }
  // A node that has moved since stays where it went.
  const std::size_t moved = nodes.find("1, -4.0768646280976");
  ASSERT_NE(moved, std::string::npos) << nodes;
  nodes.replace(moved, 5, "1, -5");
  EXPECT_EQ(volume(nodes).vertices[0][0],
            value_of("-5" + io::short_real(written.vertices[0][0], io::kInpCharacters).substr(2)));
}

}  // namespace
}  // namespace holdfast::io_inp_exact_test
