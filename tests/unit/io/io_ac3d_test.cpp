// AC3D.
#include <gtest/gtest.h>

#include "holdfast/surface_io.h"
#include "io_samples.h"

namespace holdfast::io_ac3d_test {
namespace {

using namespace samples;

Surface surface(const std::string& bytes) {
  const TemporaryFolder folder;
  put(folder / "a.ac", bytes);
  return read_surface(folder / "a.ac");
}
std::string error(const std::string& bytes) {
  return refusal_of([&] { return surface(bytes); });
}

const std::string kHead =
    "AC3Db\nMATERIAL \"body\" rgb 1 1 1 amb 0 0 0\nMATERIAL \"glass\" rgb 1 1 1\nOBJECT world\n";
const std::string kSquare = "numvert 4\n0 0 0\n1 0 0 0 0 1\n1 1 0\n0 1 0\n";

TEST(Ac3dFile, ObjectsStandWhereTheTreePlacesThem) {
  const Surface s = surface(
      kHead + "kids 2\n" + "OBJECT group\nname \"two words\"\nloc 10 0 0\nrot 0 1 0 -1 0 0 0 0 1\nkids 1\n" +
      "OBJECT poly\nname wing\ndata 11\nkids 7\nOBJE\nloc 0 0 5\n" + kSquare +
      "numsurf 1\nSURF 0x30\nmat 0\nrefs 3\n0 0 0\n1 0.5 0\n2 1 1\nkids 0\n" +
      "OBJECT poly\nname \"tail\"\n" + kSquare + "numsurf 1\nSURF 0X0\nrefs 4\n0\n1\n2\n3\nkids 0\n");
  EXPECT_EQ(s.facets, (std::vector<Triangle>{{0, 1, 2}, {3, 4, 5}, {3, 5, 6}}));
  // The rows of a rotation are the images of the axes.
  EXPECT_EQ(s.vertices[1], (Point{10, 1, 5}));
  EXPECT_EQ(s.vertices[2], (Point{9, 1, 5}));
  EXPECT_EQ(s.vertices[4], (Point{1, 0, 0}));
  EXPECT_EQ(s.names.facets, (std::map<int, std::string>{{1, "wing"}, {2, "tail"}}));
}

TEST(Ac3dFile, MaterialsStripsAndLines) {
  const Surface s =
      surface(kHead + "kids 1\nOBJECT poly\nname \"car\"\ncrease 45\n" + kSquare +
              "numsurf 4\nSURF 0x14\nmat 1\nrefs 4\n0 0 0 1 1\n1 0 0\n3 0 0\n2 0 0\n" +
              "SURF 0x20\nmat 0\nrefs 3\n2 0 0\n1 0 0\n0 0 0\n" +
              "SURF 0x22\nmat 0\nrefs 2\n0 0 0\n1 0 0\nSURF 0x00\nmat 9\nrefs 2\n0 0 0\n1 0 0\nkids 0\n");
  EXPECT_EQ(s.facets, (std::vector<Triangle>{{0, 1, 3}, {3, 1, 2}, {2, 1, 0}}));
  EXPECT_EQ(s.facet_markers, (std::vector<int>{1, 1, 2}));
  EXPECT_EQ(s.names.facets, (std::map<int, std::string>{{1, "glass"}, {2, "body"}}));
  ASSERT_EQ(s.remarks.size(), 2U);
  EXPECT_EQ(s.remarks[0].message, "1 line is left out");
  EXPECT_EQ(s.remarks[1].message, "1 face of fewer than three corners is left out");
}

TEST(Ac3dFile, PointsOfNoFaceAreLeftOut) {
  const Surface s =
      surface(kHead + "kids 2\nOBJECT poly\nnumvert 1\n9 9 9\nkids 0\nOBJECT poly\nnumvert 4\n7 7 7\n" +
              "0 0 0\n1 0 0\n0 1 0\nnumsurf 1\nSURF 0\nrefs 3\n1 0 0\n2 0 0\n3 0 0\nkids 0\n");
  EXPECT_EQ(s.vertices, (std::vector<Point>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
  EXPECT_EQ(s.facets, (std::vector<Triangle>{{0, 1, 2}}));
  ASSERT_EQ(s.remarks.size(), 1U);
  EXPECT_EQ(s.remarks[0].message, "2 points of no face are left out");
}

TEST(Ac3dFile, FewerObjectsThanAnnounced) {
  const Surface s = surface(kHead + "kids 3\nOBJECT poly\n" + kSquare +
                            "numsurf 1\nSURF 0x0\nrefs 3\n0 0 0\n1 0 0\n3 0 0\nkids 0\n");
  EXPECT_EQ(s.facets.size(), 1U);
  ASSERT_EQ(s.remarks.size(), 2U);
  EXPECT_EQ(s.remarks[0].message,
            "the file ends before all objects that 'kids' announces: triangles may be missing");
}

TEST(Ac3dFile, NewerMaterials) {
  const Surface s =
      surface("AC3Dc\nMAT \"steel\"\nrgb 1 1 1\ndata 3\nMAT\nENDMAT\nOBJECT world\nkids 1\nOBJECT poly\n" +
              kSquare + "numsurf 1\nSURF 0x0\nmat 0\nrefs 3\n0 0 0\n1 0 0\n2 0 0\nkids 0\n");
  EXPECT_EQ(s.names.facets, (std::map<int, std::string>{{0, "steel"}}));
}

TEST(Ac3dFile, ErrorsNameTheLine) {
  const std::string poly = kHead + "kids 1\nOBJECT poly\n";
  EXPECT_EQ(error("solid\n"), "line 1: expected AC3D's first line, which begins with AC3D");
  EXPECT_EQ(error("AC3Db\nOBJEKT world\n"), "line 2: expected MATERIAL or OBJECT, found 'OBJEKT'");
  EXPECT_EQ(error(poly + "numvert 99\n0 0 0\n").substr(0, 7), "line 7:");
  EXPECT_EQ(error(poly + kSquare + "numsurf 1\nSURF 0x0\nrefs 3\n0 0 0\n4 0 0\n1 0 0\nkids 0\n"),
            "line 16: a vertex is out of range: 4 (they run from 0 to 3)");
  EXPECT_EQ(error(poly + kSquare + "numsurf 1\nSURF 0x3\nrefs 3\n0 0 0\n2 0 0\n1 0 0\nkids 0\n"),
            "line 13: unknown kind of surface 3");
  std::string deep = "AC3Db\n";
  for (int i = 0; i < 300; ++i) deep += "OBJECT group\nkids 1\n";
  EXPECT_NE(error(deep).find("objects stand more than 256 deep"), std::string::npos);
}

}  // namespace
}  // namespace holdfast::io_ac3d_test
