// 3D Studio's files.
#include <gtest/gtest.h>

#include "holdfast/surface_io.h"
#include "io_samples.h"

namespace holdfast::io_3ds_test {
namespace {

using namespace samples;

Surface surface(const std::string& bytes) {
  const TemporaryFolder folder;
  put(folder / "a.3ds", bytes);
  return read_surface(folder / "a.3ds");
}
std::string error(const std::string& bytes) {
  return refusal_of([&] { return surface(bytes); });
}

TEST(ThreeDsFile, MeshesAndMaterials) {
  const Surface s = surface(threeds_bytes());
  EXPECT_EQ(s.facets, (std::vector<Triangle>{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}));
  EXPECT_EQ(s.vertices, (std::vector<Point>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}));
  EXPECT_EQ(s.facet_markers, (std::vector<int>{1, 1, 2, 2}));
  EXPECT_EQ(s.names.facets, (std::map<int, std::string>{{1, "red"}, {2, "body"}}));
  ASSERT_EQ(s.remarks.size(), 1U);
  EXPECT_EQ(s.remarks[0].message, "1 mesh without triangles is left out");
}

TEST(ThreeDsFile, ErrorsNameTheByte) {
  const std::string good = threeds_bytes();
  EXPECT_EQ(error("solid"), "byte 0: expected the bytes 4D 4D with which a .3ds file begins");
  EXPECT_NE(error(good.substr(0, 60)).find("does not fit where"), std::string::npos);
  EXPECT_EQ(error(std::string("\x4D\x4D\x06\0\0\0", 6)), "the file holds no vertices");
  std::string bad = good;
  const std::size_t faces = good.find("\x20\x41");
  bad[faces + 8] = 9;  // the first corner of the first face
  EXPECT_NE(error(bad).find("face 0 of 'body' has vertex 9, but there are 4"), std::string::npos);
  bad = good;
  bad[faces + 7] = 1;  // more than 256 faces
  EXPECT_NE(error(bad).find("260 faces do not fit into their chunk"), std::string::npos);
  EXPECT_EQ(surface(good + "tail").remarks.back().message, "4 bytes after the last chunk are left out");
}

}  // namespace
}  // namespace holdfast::io_3ds_test
