// Pages: foreign text stays text, the data can be read back, and the embedded page is the committed one.
#include "holdfast/view.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>

#include "view/embedded.h"
#include "view/packed.h"
#include "view/text.h"

namespace holdfast::view_test {
namespace {

std::string inflated(const std::string& packed, std::size_t room) {
  std::string bytes(room, '\0');
  uLongf size = room;
  EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(bytes.data()), &size,
                       reinterpret_cast<const Bytef*>(packed.data()), packed.size()),
            Z_OK);
  bytes.resize(size);
  return bytes;
}

Volume one_tetrahedron() {
  Volume volume;
  volume.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  volume.tetrahedra = {{0, 1, 2, 3}};
  volume.regions = {7};
  volume.facets = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  return volume;
}

Page page_of(const Volume& volume) {
  Page page;
  page.parts.emplace_back().volume = &volume;
  return page;
}

TEST(ViewText, MarkupBecomesText) {
  EXPECT_EQ(view::html("</script><b a=\"'&"), "&lt;/script&gt;&lt;b a=&quot;&#39;&amp;");
  EXPECT_EQ(view::json(std::string_view("a\"b\\c\nd")), "\"a\\\"b\\\\c\\nd\"");
}

TEST(ViewText, InvalidUtf8IsReplaced) {
  const std::string mark = "\xEF\xBF\xBD";
  EXPECT_EQ(view::clean("a\xFF"), "a" + mark);
  EXPECT_EQ(view::clean(std::string("\0\x1B", 2)), mark + mark);
  EXPECT_EQ(view::clean("\xC0\xAF"), mark + mark);             // overlong
  EXPECT_EQ(view::clean("\xED\xA0\x80"), mark + mark + mark);  // a surrogate
  EXPECT_EQ(view::clean("\xF4\x90\x80\x80"), mark + mark + mark + mark);
  EXPECT_EQ(view::clean("\xE2\x82"), mark + mark);  // truncated
  EXPECT_EQ(view::clean("Schönhardt 😀"), "Schönhardt 😀");
}

TEST(ViewText, NumbersThatJsonCannotHoldAreNull) {
  EXPECT_EQ(view::json(0.1), "0.1");
  EXPECT_EQ(view::json(std::nan("")), "null");
  EXPECT_EQ(view::json(-std::numeric_limits<double>::infinity()), "null");
}

TEST(ViewPacked, Base64) {  // RFC 4648, section 10
  EXPECT_EQ(view::base64(""), "");
  EXPECT_EQ(view::base64("f"), "Zg==");
  EXPECT_EQ(view::base64("fo"), "Zm8=");
  EXPECT_EQ(view::base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(view::base64("\xFB\xFF"), "+/8=");
}

TEST(ViewPacked, ArraysStandInPlanes) {
  const Limits limits;
  io::Watch watch(limits, {});
  view::Packed packed(watch);
  const std::array<std::uint32_t, 4> words{1, 2, 0x103, 4};
  packed.words(words, 2);
  const std::array<double, 1> doubles{1.0};
  packed.doubles(doubles);
  const std::string bytes = inflated(packed.finish(), 100);
  EXPECT_EQ(bytes, std::string("\1\2\2\2\0\0\1\0\0\0\0\0\0\0\0\0"
                               "\0\0\0\0\0\0\xF0\x3F",
                               24));
}

TEST(View, TheHeaderDescribesTheArrays) {
  const Volume volume = one_tetrahedron();
  Page page = page_of(volume);
  page.parts[0].name = "</script>\"";
  const std::string bytes = inflated(page_data(page), 10000);
  const auto byte = [&](std::size_t i) {
    return static_cast<std::size_t>(static_cast<unsigned char>(bytes[i]));
  };
  const std::size_t length = byte(0) | byte(1) << 8;
  const std::string header = bytes.substr(4, length);
  EXPECT_NE(header.find("\"name\":\"</script>\\\"\",\"kind\":\"volume\""), std::string::npos) << header;
  EXPECT_NE(header.find("{\"name\":\"tetrahedra\",\"kind\":\"u32\",\"count\":4,\"step\":4}"),
            std::string::npos);
  EXPECT_EQ(bytes.size(), 4 + length + 8 * 12 + 4 * 4 + 4 + 4 * 12);
}

TEST(View, ALargeVolumeIsReducedToItsMiddle) {
  Volume volume;
  for (int i = 0; i < 9; ++i) {
    const auto first = static_cast<Index>(volume.vertices.size());
    const double x = 10 * i;
    for (const Point& p : {Point{x, 0, 0}, {x + 1, 0, 0}, {x, 1, 0}, {x, 0, 1}}) volume.vertices.push_back(p);
    volume.tetrahedra.push_back({first, first + 1, first + 2, first + 3});
  }
  PageOptions options;
  options.most_tetrahedra = 3;
  const std::string bytes = inflated(page_data(page_of(volume), options), 10000);
  EXPECT_NE(bytes.find("Of 9 tetrahedra this page holds the 3 nearest to the middle across x"),
            std::string::npos);
  EXPECT_NE(bytes.find("\"total\":9"), std::string::npos);
  EXPECT_NE(bytes.find(std::string("\3\1\1\0\0\0\0\0\0\0\0\0", 12)), std::string::npos);  // 3 4 5, as steps
}

TEST(View, TagsOfAnotherNumberAreRefused) {
  Volume volume = one_tetrahedron();
  volume.regions.push_back(1);
  EXPECT_THROW(static_cast<void>(page_data(page_of(volume))), std::invalid_argument);
}

TEST(View, AnyIndicesInASurfaceAreAccepted) {
  const std::vector<Point> vertices{{0, 0, 0}, {std::nan(""), 0, 0}};
  const std::vector<Triangle> facets{{0, 1, 99}};
  Defect defect{DefectKind::index_out_of_range, {99}, {0}, {}, {{std::nan(""), 0, 1}},
                "<img src=x onerror=alert(1)>"};
  Page page;
  page.parts.emplace_back().complex = Complex{vertices, facets, {}, {}, {}};
  page.parts[0].defects = {&defect, 1};
  const std::filesystem::path path = std::filesystem::temp_directory_path() / "holdfast_view_test.html";
  write_page(path, page);
  std::ifstream file(path);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  std::filesystem::remove(path);
  EXPECT_NE(text.find("data-entry=\"0\">&lt;img src=x onerror=alert(1)&gt;</button>"), std::string::npos);
  EXPECT_EQ(text.find("<img"), std::string::npos);
  EXPECT_EQ(text.find("@DATA@"), std::string::npos);
}

TEST(View, ACancelledPageLeavesNoFile) {
  const Volume volume = one_tetrahedron();
  PageOptions options;
  options.cancel.emplace().cancel();
  const std::filesystem::path path = std::filesystem::temp_directory_path() / "holdfast_view_cancelled.html";
  EXPECT_THROW(write_page(path, page_of(volume), options), Interrupted);
  EXPECT_FALSE(std::filesystem::exists(path));
}

TEST(View, TheEmbeddedPageIsTheCommittedOne) {
  const std::filesystem::path source = HOLDFAST_SOURCE_DIR "/viewer/dist/viewer.html";
  std::ifstream file(source, std::ios::binary);
  ASSERT_TRUE(file) << source;
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  EXPECT_TRUE(text == view::page_template());
}

}  // namespace
}  // namespace holdfast::view_test
