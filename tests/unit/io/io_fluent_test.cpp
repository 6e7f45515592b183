// Meshes of Ansys Fluent.
#include <gtest/gtest.h>

#include "io_volumes.h"

namespace holdfast::io_fluent_test {
namespace {

using namespace samples;

/// Two tetrahedra with a face between them, as text; zones of faces: 3 inside, 4 and 5 on the boundary.
const std::string kHead =
    "(0 \"GAMBIT to Fluent (File\")\n(2 3)\n(10 (0 1 5 1 3))\n"
    "(10 (1 1 5 1 3)\n(\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n0 0 -1))\n(12 (0 1 2 0))\n";
const std::string kFaces =
    "(13 (0 1 7 0))\n(13 (3 1 1 2 3)(1 2 3 1 2))\n(13 (4 2 4 3 3)(\n1 4 2 1 0\n2 4 3 1 0\n3 4 1 1 0))\n"
    "(13 (5 5 7 a 0)(\n3 1 2 5 2 0\n3 2 3 5 2 0\n3 3 1 5 0 2\n))\n";
const std::string kCells = "(12 (2 1 2 1 2))\n";
const std::string kNames =
    "(45 (2 fluid air)())\n(45 (3 interior default-interior)())\n(39 (4 wall hull 1)(\n(temperature . "
    "300)))\n"
    "(45 (5 velocity-inlet inlet)())\n";

TEST(Fluent, ZonesAreMarkersAndRegions) {
  const Volume read = volume(kHead + kCells + kFaces + kNames, "a.msh");
  EXPECT_EQ(read.vertices.size(), 5U);
  EXPECT_EQ(read.tetrahedra, (std::vector<Tetrahedron>{{0, 1, 2, 3}, {2, 1, 0, 4}}));
  EXPECT_EQ(read.regions, (std::vector<int>{2, 2}));
  // Outwards, whichever cell the file names.
  EXPECT_EQ(read.facets,
            (std::vector<Triangle>{{1, 3, 0}, {2, 3, 1}, {0, 3, 2}, {4, 1, 0}, {4, 2, 1}, {2, 0, 4}}));
  EXPECT_EQ(read.facet_markers, (std::vector<int>{4, 4, 4, 5, 5, 5}));
  EXPECT_EQ(read.names.facets, (std::map<int, std::string>{{4, "hull"}, {5, "inlet"}}));
  EXPECT_EQ(read.names.regions, (std::map<int, std::string>{{2, "air"}}));
}

TEST(Fluent, OtherSectionsAreSkipped) {
  const std::string other =
      "(1 \"TGrid 3D 3.5\")\n(rp ((a \"text with \\\") bracket\") (b . 3)))\n(37 (\n(default-method ())))\n"
      "(18 (1 2 3 4)(\n1 2\n))\n(3300 (1 1 2)(\x01)(\x02)\nEnd of Binary Section   3300)\n(60 ((x 1)))\n";
  const Volume read = volume(other + kHead + other + kCells + kFaces + kNames + other, "a.cas");
  EXPECT_EQ(read.tetrahedra.size(), 2U);
  EXPECT_EQ(read.names.facets.size(), 2U);
}

TEST(Fluent, InnerZonesThatAUserNamedAreMarkers) {
  std::string names = kNames;
  names.replace(names.find("default-interior"), 16, "filter");
  Volume read = volume(kHead + kCells + kFaces + names, "a.msh");
  ASSERT_EQ(read.facets.size(), 7U);
  EXPECT_EQ(read.facets[0], (Triangle{2, 1, 0}));  // away from its first cell
  EXPECT_EQ(read.facet_markers[0], 3);
  EXPECT_EQ(read.names.facets.at(3), "filter");
  EXPECT_EQ(volume(kHead + kCells + kFaces, "a.msh").facets.size(), 6U);  // no names at all
}

/// A cube of a hexahedron beside a prism, and a pyramid on top, by their faces.
TEST(Fluent, OtherCellsAreFoundByTheirFaces) {
  const std::string text =
      "(2 3)\n(10 (1 1 b 1 3)(0 0 0 1 0 0 1 1 0 0 1 0 0 0 1 1 0 1 1 1 1 0 1 1 2 0 0 2 0 1 .5 .5 2))\n"
      "(12 (2 1 3 1 0)(4 6 5))\n(13 (3 1 2 2 4)(2 3 7 6 2 1 5 6 7 8 3 1))\n"
      "(13 (4 3 10 3 0)(\n4 1 2 3 4 1 0\n4 1 5 6 2 1 0\n4 3 7 8 4 1 0\n4 4 8 5 1 1 0\n"
      "3 2 9 3 2 0\n3 6 7 a 2 0\n4 9 a 7 3 2 0\n4 2 6 a 9 2 0\n"
      "3 6 5 b 3 0\n3 7 6 b 3 0\n3 8 7 b 3 0\n3 5 8 b 3 0))\n";
  std::string right = text;
  right.replace(right.find("3 10 3 0"), 8, "3 e 3 0");
  std::vector<Remark> remarks;
  const TemporaryFolder folder;
  put(folder / "a.msh", right);
  const Volume read = read_volume(folder / "a.msh", ReadOptions{}, &remarks);
  double sum = 0;
  for (const Tetrahedron& t : read.tetrahedra) {
    std::array<Point, 3> e{};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 3; ++k) e[i][k] = read.vertices[t[i + 1]][k] - read.vertices[t[0]][k];
    const double six = e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) -
                       e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
                       e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
    EXPECT_GT(six, 0);
    sum += six;
  }
  EXPECT_DOUBLE_EQ(sum, 6 + 3 + 2);
  ASSERT_FALSE(remarks.empty());
  EXPECT_EQ(remarks.back().message, "1 hexahedron, 1 prism and 1 pyramid are split into tetrahedra");
  EXPECT_EQ(error(text, "a.msh").substr(0, 8), "line 17:");  // fewer faces than announced
}

TEST(Fluent, PolyhedraAreReadAsASurfaceAlone) {
  // A cube with a side in two triangles: seven faces.
  const std::string text =
      "(2 3)\n(10 (1 1 8 1 3)(0 0 0 1 0 0 1 1 0 0 1 0 0 0 1 1 0 1 1 1 1 0 1 1))\n(12 (2 1 1 1 7))\n"
      "(13 (4 1 7 3 5)(\n4 1 2 3 4 1 0\n4 1 5 6 2 1 0\n4 3 7 8 4 1 0\n4 4 8 5 1 1 0\n4 2 6 7 3 1 0\n"
      "3 5 8 7 1 0\n3 5 7 6 1 0))\n";
  const TemporaryFolder folder;
  put(folder / "a.msh", text);
  const Surface surface = read_surface(folder / "a.msh");
  EXPECT_EQ(surface.facets.size(), 12U);
  EXPECT_EQ(surface.remarks.front().message, "1 cell is left out");
  EXPECT_EQ(error(text, "a.msh"),
            "line 3: cell 1 of this zone, with 7 faces, is no tetrahedron, pyramid, prism or hexahedron");
}

TEST(Fluent, ASurfaceOfFacesWithoutCells) {
  const TemporaryFolder folder;
  put(folder / "a.msh", kHead.substr(0, kHead.find("(12")) + "(13 (4 1 2 3 3)(1 2 3 0 0 1 2 4 0 0))");
  EXPECT_EQ(read_surface(folder / "a.msh").facets, (std::vector<Triangle>{{0, 1, 2}, {0, 1, 3}}));
  Volume surface;
  surface.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  surface.facets = {{0, 1, 2}, {0, 1, 3}};
  surface.facet_markers = {5, 0};
  surface.names.facets = {{5, "in"}};
  WriteOptions fluent;
  fluent.format = "fluent";
  write_volume(folder / "b.msh", surface, fluent);
  const Surface read = read_surface(folder / "b.msh");
  EXPECT_EQ(read.facets, (std::vector<Triangle>{{0, 1, 3}, {0, 1, 2}}));
  EXPECT_EQ(read.facet_markers, (std::vector<int>{0, 5}));
  EXPECT_EQ(read.names.facets, surface.names.facets);
}

/// The same two tetrahedra with binary sections.
std::string binary(bool big, bool wide, bool long_indices) {
  const auto number = [&](std::int64_t i) {
    return long_indices ? raw(i, big) : raw(static_cast<std::int32_t>(i), big);
  };
  const auto real = [&](double x) { return wide ? raw(x, big) : raw(static_cast<float>(x), big); };
  const std::string kind = wide ? "30" : "20";
  const auto end = [&](const char* section) {
    return ")\nEnd of Binary Section   " + kind + section + ")\n";
  };
  std::string text = std::string("(4 (") + (big ? "30" : "60") + " 0 0 1 2 4 4 4 8 8 4))\n(2 3)\n(" + kind +
                     "10 (1 1 5 1 3)(";
  for (const double x : {0., 0., 0., 1., 0., 0., 0., 1., 0., 0., 0., 1., 0., 0., -1.}) text += real(x);
  text += end("10") + "(" + kind + "12 (2 1 2 1 0)(" + number(2) + number(2) + end("12") + "(" + kind +
          "13 (3 1 1 2 3)(";
  for (const int i : {1, 2, 3, 1, 2}) text += number(i);
  text += end("13") + "(" + kind + "13 (4 2 7 3 " + (long_indices ? "3" : "0") + ")(";
  for (const std::array<int, 5> face : {std::array<int, 5>{1, 4, 2, 1, 0},
                                        {2, 4, 3, 1, 0},
                                        {3, 4, 1, 1, 0},
                                        {1, 2, 5, 2, 0},
                                        {2, 3, 5, 2, 0},
                                        {3, 1, 5, 2, 0}}) {
    if (!long_indices) text += number(3);
    for (const int i : face) text += number(i);
  }
  return text + end("13");
}

TEST(Fluent, BinarySections) {
  for (const bool big : {false, true})
    for (const bool wide : {false, true})
      for (const bool long_indices : {false, true}) {
        if (long_indices && !wide) continue;
        const Volume read = volume(binary(big, wide, long_indices), "a.msh");
        EXPECT_EQ(read.tetrahedra, (std::vector<Tetrahedron>{{0, 1, 2, 3}, {2, 1, 0, 4}}));
        EXPECT_EQ(read.vertices[4], (Point{0, 0, -1}));
        EXPECT_EQ(read.facets.size(), 6U);
      }
  std::string cut = binary(false, true, false);
  cut.erase(cut.rfind("End of"));
  EXPECT_NE(error(cut, "a.msh").find("does not end; the file is truncated"), std::string::npos);
}

TEST(Fluent, ErrorsNameTheLine) {
  const auto with = [&](std::string_view old, const std::string& replacement) {
    std::string text = kHead + kCells + kFaces + kNames;
    text.replace(text.find(old), old.size(), replacement);
    return error(text, "a.msh");
  };
  EXPECT_EQ(with("(2 3)", "(2 2)"), "line 2: a mesh of 2 dimensions; only those of 3 are read");
  EXPECT_EQ(with("1 0 0\n", "1 x 0\n"), "line 7: expected a coordinate, found 'x'");
  EXPECT_EQ(with("1 0 0\n", "1 0\n"), "line 10: expected a coordinate, found ')'");
  EXPECT_EQ(
      with("(1 1 5 1 3)", "(1 1 ffffff 1 3)"),
      "line 5: 16777215 nodes are announced, but only 347 bytes follow; the file is truncated or damaged");
  EXPECT_EQ(with("(1 1 5 1 3)", "(1 0 4 1 3)"), "line 5: nodes from 0 to 4 are none that 32 bits count");
  EXPECT_EQ(with("(1 1 5 1 3)", "(1 2 6 1 3)"), "line 4: nodes from 2 on, but those before end with 0");
  EXPECT_EQ(with("1 4 2 1 0", "1 4 9 1 0"), "line 15: a face of this zone names node 9, but there are 5");
  EXPECT_EQ(with("1 4 2 1 0", "1 4 2 3 0"), "line 15: a face of this zone names cell 3, but there are 2");
  EXPECT_EQ(with("1 4 2 1 0", "1 4 2 2 0"),
            "line 12: cell 1 of this zone, with 3 faces, is no tetrahedron, pyramid, prism or hexahedron");
  EXPECT_EQ(with("1 4 2 1 0", "1 5 2 1 0"),
            "line 12: cell 1 of this zone, with 4 faces, is no tetrahedron, pyramid, prism or hexahedron");
  EXPECT_EQ(with("(12 (2 1 2 1 2))", "(12 (2 1 fffffff0 1 2))"),
            "line 12: 4294967280 cells, but only 7 faces; the file is truncated or damaged");
  EXPECT_EQ(with("(12 (2 1 2 1 2))", "(12 (2 1 fffffff0 20 2))"),
            "line 12: 4294967280 cells, but only 7 faces; the file is truncated or damaged");
  EXPECT_EQ(with("(12 (2 1 2 1 2))", "(12 (2 2 2 1 2))"),
            "line 12: cells from 2 on, but those before end with 0");
  EXPECT_EQ(with("3 1 2 5 2 0", "2 1 2 5 2 0"), "line 20: a face of 2 corners");
  EXPECT_EQ(with("(45 (5 velocity-inlet inlet)())\n", "(45 (5 velocity-inlet"),
            "line 28: the file ends where the name of a zone is expected; it is truncated");
  EXPECT_EQ(error("(2 3)\n", "a.msh"), "the file has no nodes");
}

TEST(Fluent, NamesAndIdsComeBack) {
  const TemporaryFolder folder;
  Volume original;
  original.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.1, 0.2, -1.0 / 3}};
  original.tetrahedra = {{0, 1, 2, 3}, {0, 2, 1, 4}};
  original.regions = {20, -3};
  // Marker 9 is inside and on the boundary; {0, 2, 4} has no facet; {0, 1, 3} faces inwards.
  original.facets = {{0, 1, 2}, {3, 1, 0}, {1, 2, 3}, {0, 3, 2}, {0, 4, 1}, {2, 1, 4}};
  original.facet_markers = {9, 9, 2, 2, 0, 4};
  original.names.regions = {{20, "part"}};
  original.names.facets = {{9, "part"}, {2, "interior"}};
  WriteOptions fluent;
  fluent.format = "fluent";
  write_volume(folder / "a.msh", original, fluent);
  const std::string text = get(folder / "a.msh");
  EXPECT_NE(text.find("wall part_surface"), std::string::npos) << text;
  EXPECT_NE(text.find("interior interior_"), std::string::npos + 1) << text;
  const Volume read = read_volume(folder / "a.msh");
  EXPECT_EQ(bits(read.vertices), bits(original.vertices));
  EXPECT_EQ(read.names.regions, original.names.regions);
  EXPECT_EQ(read.names.facets, (std::map<int, std::string>{{9, "part_surface"}, {2, "interior"}}));
  EXPECT_EQ(read.regions, (std::vector<int>{-3, 20}));
  EXPECT_EQ(read.facets.size(), 7U);
  std::map<int, int> count;
  for (const int marker : read.facet_markers) ++count[marker];
  EXPECT_EQ(count, (std::map<int, int>{{0, 2}, {2, 2}, {4, 1}, {9, 2}}));
}

TEST(Fluent, TellsWhatItDoesNotHold) {
  Volume volume = sample_volume();
  volume.tetrahedra = {{0, 1, 2, 3}};
  volume.regions = {1};
  volume.facets = {{0, 2, 1}, {2, 3, 4}};
  volume.facet_markers = {1, 1};
  WriteOptions fluent;
  fluent.format = "fluent";
  std::string all;
  for (const Remark& remark : not_held("a.msh", volume, fluent)) all += remark.message + "\n";
  EXPECT_NE(all.find("1 facets are no faces of tetrahedra"), std::string::npos) << all;
  EXPECT_NE(all.find("segments have no place in Fluent's format"), std::string::npos) << all;
}

}  // namespace
}  // namespace holdfast::io_fluent_test
