// Surfaces of brains: GIFTI and FreeSurfer.
#include <gtest/gtest.h>

#include "holdfast/surface_io.h"
#include "io_samples.h"

namespace holdfast::io_brain_test {
namespace {

using namespace samples;

const std::vector<Triangle> kFacets{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};

Surface surface(const std::string& name, const std::string& bytes) {
  const TemporaryFolder folder;
  put(folder / name, bytes);
  return read_surface(folder / name);
}
std::string error(const std::string& name, const std::string& bytes) {
  return refusal_of([&] { return surface(name, bytes); });
}
std::string with(std::string text, const std::string& before, const std::string& after) {
  const std::size_t at = text.find(before);
  EXPECT_NE(at, std::string::npos) << before;
  return text.replace(at, before.size(), after);
}

TEST(GiftiFile, ArraysAsTextAndAsBase64) {
  const Surface s = surface("a.surf.gii", kGifti);
  EXPECT_EQ(s.vertices, (std::vector<Point>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}));
  EXPECT_EQ(s.facets, kFacets);
  ASSERT_EQ(s.remarks.size(), 1U);
  EXPECT_EQ(s.remarks[0].message, "1 array of data ('NIFTI_INTENT_SHAPE') is left out");
}

TEST(GiftiFile, PackedByZlibWithOldSpellings) {
  std::string text = with(kGifti, "AAAAAAAAAAAAAAAAAQAAAAIAAAABAAAAAwAAAAIAAAABAAAAAwAAAAIAAAADAAAA",
                          "eJxjYEAARiBmgtLMWNgg\nGgABcAAT");
  text = with(text, "Base64Binary", "GIFTI_ENCODING_B64GZ");
  text = with(text, "ColumnMajorOrder", "GIFTI_IND_ORD_COL_MAJOR");
  EXPECT_EQ(surface("a.gii", text).facets, kFacets);
}

TEST(GiftiFile, NumbersInAnotherFile) {
  const TemporaryFolder folder;
  std::string bytes = "12345";
  for (const std::int32_t v : {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3}) io::store(bytes, v, std::endian::big);
  put(folder / "a.bin", bytes);
  std::string text = with(kGifti, "\"Base64Binary\"",
                          "\"ExternalFileBinary\" ExternalFileName=\"a.bin\" ExternalFileOffset=\"5\"");
  text = with(with(text, "ColumnMajorOrder", "RowMajorOrder"), "LittleEndian\">\n<Data>",
              "BigEndian\">\n<Data>");
  put(folder / "a.gii", text);
  EXPECT_EQ(read_surface(folder / "a.gii").facets, kFacets);
}

TEST(GiftiFile, Errors) {
  EXPECT_EQ(error("a.gii", "<a/>"), "line 1: expected GIFTI's XML, which has a tag <GIFTI>");
  EXPECT_EQ(error("a.gii", with(kGifti, "0 0 1</Data>", "0 0</Data>")),
            "line 3: fewer numbers than its dimensions say");
  EXPECT_EQ(error("a.gii", with(kGifti, "Base64Binary", "Base85")), "line 6: unknown encoding 'Base85'");
  EXPECT_EQ(error("a.gii", with(kGifti, "NIFTI_TYPE_INT32", "NIFTI_TYPE_RGB24")),
            "line 6: unknown type of numbers 'NIFTI_TYPE_RGB24'");
  EXPECT_EQ(error("a.gii", with(kGifti, "AAAAAAAAAAAAAAAA", "AAAAAAAAAAAAAA!A")),
            "line 6: the data has characters that are not base64");
  EXPECT_EQ(error("a.gii", with(kGifti, "NIFTI_INTENT_POINTSET", "NIFTI_INTENT_VECTOR")),
            "line 6: triangles before any points");
  EXPECT_EQ(error("a.gii", with(kGifti, "AAAAAAAAAAAAAAAAAQ", "AAAAAAAAAAAAAAAACQ")),
            "line 6: a triangle has vertex 9, but there are 4");
}

TEST(FreeSurferFile, TrianglesAndWhatIsRefused) {
  const std::string good = freesurfer_bytes();
  for (const char* name : {"lh.pial", "rh.white", "lh.inflated.gz.sphere"}) {
    const Surface s = surface(name, good);
    EXPECT_EQ(s.vertices, (std::vector<Point>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}));
    EXPECT_EQ(s.facets, kFacets);
  }
  EXPECT_NE(error("lh.pial", good.substr(0, 90)).find("are announced, but only"), std::string::npos);
  EXPECT_EQ(error("lh.pial", "\xFF\xFF\xFF more"),
            "byte 0: an old file of quadrangles; `mris_convert IN OUT` makes one of triangles");
  EXPECT_EQ(error("lh.pial", "solid"),
            "byte 0: expected the bytes FF FF FE with which FreeSurfer's surfaces begin");
  std::string bad = good;
  bad[bad.size() - 7] = 9;
  EXPECT_EQ(error("lh.pial", bad), "byte 126: vertex 9, but there are 4");
}

}  // namespace
}  // namespace holdfast::io_brain_test
