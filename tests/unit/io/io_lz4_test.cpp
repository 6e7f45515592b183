// Blocks of LZ4, and VTK files compressed by it.
#include <gtest/gtest.h>

#include <random>

#include "io/lz4_block.h"
#include "io_volumes.h"

namespace holdfast::io_lz4_test {
namespace {

using namespace samples;

/// The content of the block, or "damaged".
std::string unpacked(const std::string& block, std::size_t size) {
  std::string bytes = "before";
  if (!io::append_lz4_block(bytes, block, size)) return "damaged";
  EXPECT_EQ(bytes.substr(0, 6), "before");
  return bytes.substr(6);
}

TEST(Lz4, LiteralsAndMatches) {
  EXPECT_EQ(unpacked(std::string("\x30") + "abc", 3), "abc");
  EXPECT_EQ(unpacked(std::string("\x32"
                                 "abc\x03\x00\x10z",
                                 8),
                     10),
            "abcabcabcz");  // into itself
  EXPECT_EQ(unpacked(std::string("\x10"
                                 "a\x01\x00\x10z",
                                 6),
                     6),
            "aaaaaz");
  EXPECT_EQ(unpacked(std::string("\x00", 1), 0), "");
}

TEST(Lz4, LengthsGoOnInFurtherBytes) {
  // 15 + 255 + 3 literals, then a match of 4 + 15 + 0.
  const std::string literals(273, 'x');
  EXPECT_EQ(unpacked(std::string("\xF0\xFF\x03", 3) + literals, 273), literals);
  EXPECT_EQ(unpacked(std::string("\x1F"
                                 "a\x01\x00\x00\x00",
                                 6),
                     20),
            std::string(20, 'a'));
  EXPECT_EQ(unpacked(std::string("\x1F"
                                 "a\x01\x00\xFF\x00\x00",
                                 7),
                     275),
            std::string(275, 'a'));
}

TEST(Lz4, DamagedBlocks) {
  EXPECT_EQ(unpacked(std::string("\x30") + "ab", 3), "damaged");    // literals that are not there
  EXPECT_EQ(unpacked(std::string("\x30") + "abc", 4), "damaged");   // too short
  EXPECT_EQ(unpacked(std::string("\x30") + "abc", 2), "damaged");   // too long
  EXPECT_EQ(unpacked(std::string("\xF0\xFF", 2), 300), "damaged");  // a length that does not end
  EXPECT_EQ(unpacked(std::string("\x10"
                                 "a\x00\x00\x10z",
                                 6),
                     6),
            "damaged");  // a match of the present
  EXPECT_EQ(unpacked(std::string("\x10"
                                 "a\x02\x00\x10z",
                                 6),
                     6),
            "damaged");  // before the block
  EXPECT_EQ(unpacked(std::string("\x10"
                                 "a\x01",
                                 3),
                     6),
            "damaged");  // half an offset
  EXPECT_EQ(unpacked(std::string("\x10"
                                 "a\x01\x00\x10z",
                                 6),
                     5),
            "damaged");
}

TEST(Lz4, ArbitraryBytesDoNoHarm) {
  std::mt19937_64 random(1);
  for (int k = 0; k < 20000; ++k) {
    std::string block(random() % 40, '\0');
    for (char& c : block) c = static_cast<char>(random() % 4 == 0 ? random() : random() % 20);
    std::string bytes;
    const std::size_t size = random() % 200;
    const bool whole = io::append_lz4_block(bytes, block, size);
    EXPECT_TRUE(!whole || bytes.size() == size);
    EXPECT_LE(bytes.size(), size);
  }
}

TEST(Lz4, PacksArraysOfVtu) {
  // One block of 12 bytes, which are literals.
  const std::string text = replaced(
      replaced(kVtu, "Name=\"offsets\" format=\"ascii\">4 7 9",
               "Name=\"offsets\" format=\"binary\">\nAQAAAAwAAAAAAAAADQAAAA==wAQAAAAHAAAACQAAAA==\n"),
      "byte_order", "compressor=\"vtkLZ4DataCompressor\" byte_order");
  EXPECT_EQ(volume(text, "a.vtu").segments, (std::vector<Segment>{{0, 1}}));
  EXPECT_EQ(error(replaced(text, "wAQAAAAHAAAACQAAAA==", "sAQAAAAHAAAACQAAAA=="), "a.vtu"),
            "byte 789: a block that cannot be decompressed; the file is damaged");
}

}  // namespace
}  // namespace holdfast::io_lz4_test
