// The calling program may have set a locale with a decimal comma: no message and no file changes.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <locale>
#include <string>
#include <vector>

#include "gltf_samples.h"
#include "holdfast/check.h"
#include "holdfast/holdfast.h"
#include "io_samples.h"
#include "small_surfaces.h"
#include "text/decimal.h"

// The C library keeps what it has parsed of LOCPATH.
extern "C" const char* __lsan_default_suppressions();  // NOLINT(bugprone-reserved-identifier)
extern "C" const char* __lsan_default_suppressions() { return "leak:__argz_add_sep\n"; }  // NOLINT

namespace holdfast::locale_test {
namespace {

using namespace samples;

std::string by_printf(double value, int digits) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.*g", digits, value);
  return text.data();
}

// tests/CMakeLists.txt compiles the locale and says where it is.
class Locale : public ::testing::Test {
 protected:
  static void use_comma() {
    std::locale::global(std::locale("de_DE.UTF-8"));
    ASSERT_EQ(by_printf(1.5, 6), "1,5");
  }
  void TearDown() override { std::locale::global(std::locale::classic()); }

  // What `make` returns, the same with a decimal comma.
  template <typename Make>
  static std::string same(const Make& make) {
    const std::string usual = make();
    use_comma();
    EXPECT_EQ(make(), usual);
    std::locale::global(std::locale::classic());
    return usual;
  }
};

std::string message_of(const std::filesystem::path& path) {
  try {
    static_cast<void>(read_volume(path));
  } catch (const FileError& error) {
    return error.what();
  }
  return "";
}

TEST_F(Locale, Numbers) {
  std::vector<double> values{0, -0.0, 1, -1.5, 0.1, 1e5, 123456, 1e6, 1e-5, 1.0 / 3, 5e-324, 1e300};
  values.insert(values.end(), {std::numeric_limits<double>::max(), std::numeric_limits<double>::infinity(),
                               -std::numeric_limits<double>::infinity(), std::nan("")});
  for (const double value : values) {
    for (const int digits : {1, 6, 10, 17}) {
      const std::string text = same([&] { return decimal(value, digits); });
      EXPECT_EQ(text, by_printf(value, digits));
    }
    const std::string text = same([&] { return decimal(value); });
    const double read = std::strtod(text.c_str(), nullptr);
    EXPECT_TRUE(read == value || (std::isnan(read) && std::isnan(value))) << text;
  }
}

TEST_F(Locale, Defects) {
  Surface crossing = small::box({0.25, 0.25, 0.25}, {0.75, 0.75, 0.75});
  small::add_box(crossing, {0.5, 0.5, 0.5}, {1.5, 1.5, 1.5});
  const std::string text = same([&] {
    std::string all;
    for (const Defect& defect : diagnose(crossing.view())) all += defect.message + "\n";
    return all;
  });
  EXPECT_NE(text.find("(0.75, 0.5, "), std::string::npos) << text;
}

TEST_F(Locale, LimitsThatRanOut) {
  Options options;
  options.time_limit = 1.5e-9;
  EXPECT_NE(same([&] { return mesh(small::box(), options).message; }).find("of 1.5e-09 s ran out"),
            std::string::npos);
  options = {};
  options.memory_limit = 1500000;
  EXPECT_NE(same([&] { return mesh(small::box(), options).message; }).find("of 0.0015 GB was reached"),
            std::string::npos);
}

TEST_F(Locale, BrokenRules) {
  const Surface box = small::box({0.5, 0.5, 0.5}, {1.5, 1.5, 1.5});
  Volume volume = mesh(box.view()).volume;
  volume.vertices[0][0] += 0.125;
  const std::string text = same([&] {
    std::string all;
    for (const Rule& rule : check(box.view(), volume).rules) all += rule.detail + "\n";
    return all;
  });
  EXPECT_NE(text.find("0.625"), std::string::npos) << text;
}

TEST_F(Locale, Files) {
  const TemporaryFolder folder;
  for (const std::string& format : volume_formats()) {
    const std::filesystem::path path = folder / ("volume" + format);
    same([&] {
      write_volume(path, sample_volume());
      return get(std::filesystem::is_directory(path) ? path / "points" : path);
    });
    const std::vector<std::string> readable = readable_volume_formats();
    if (std::find(readable.begin(), readable.end(), format) == readable.end()) continue;
    use_comma();
    const std::vector<Point> again = read_volume(path).vertices;
    EXPECT_EQ(again, sample_volume().vertices) << format;
    std::locale::global(std::locale::classic());
  }
}

TEST_F(Locale, ValuesOfFiles) {
  std::string bytes = binary_vtk();
  const std::string region = raw(std::int32_t{6}, true);
  bytes.replace(bytes.find("region int"), 10, "region float");
  bytes.replace(bytes.rfind(region), region.size(), raw(0.0625f, true));
  const TemporaryFolder folder;
  const std::filesystem::path path = folder / "volume.vtk";
  put(path, bytes);
  const std::string text = same([&] { return message_of(path); });
  EXPECT_NE(text.find("a value that is not an integer, or out of range: 0.0625"), std::string::npos) << text;
}

TEST_F(Locale, NumbersOfJson) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder / "a.gltf";
  put(path, gltf(R"("nodes":[{"mesh":0,"translation":[1.5,2.25e-1,-0.1]}])"));
  use_comma();
  EXPECT_EQ(read_surface(path).vertices[0], (Point{1.5, 0.225, -0.1}));
}

TEST(Decimal, TellsTextsOfFloatsFromDoubles) {
  for (const double x :
       {0.0, -1.5, 0.333333343, 0.3333333, 0.333333, 0.33333334326744080, 1002.684265, -1e30, 6.12323e-17})
    EXPECT_TRUE(is_text_of_float(x)) << x;
  for (const double x : {1.0 / 3, 0.99999999, 1 + 1e-9, 1e300, 1e-300, HUGE_VAL, std::nan("")})
    EXPECT_FALSE(is_text_of_float(x)) << x;
}

}  // namespace
}  // namespace holdfast::locale_test
