// Names and markers out of the formats of surfaces, and back into them; smooth patches as markers.
#include <gtest/gtest.h>

#include "holdfast/patches.h"
#include "holdfast/surface_io.h"
#include "io_samples.h"
#include "small_surfaces.h"

namespace holdfast::io_names_test {
namespace {

using namespace samples;
using ByMarker = std::map<int, std::string>;

class NamesOfFiles : public ::testing::Test {
 protected:
  Surface surface(const std::string& bytes, const std::string& name) {
    put(folder_ / name, bytes);
    return read_surface(folder_ / name);
  }
  TemporaryFolder folder_;
};

TEST_F(NamesOfFiles, SolidsOfStl) {
  const Surface two = surface(kStl, "a.stl");
  EXPECT_EQ(two.facet_markers, (std::vector<int>{1, 2}));
  EXPECT_EQ(two.names.facets, (ByMarker{{1, "first part"}}));
  const std::string one = std::string(kStl).substr(0, std::string(kStl).find("solid\nfacet"));
  EXPECT_TRUE(surface(one, "b.stl").facet_markers.empty());
  EXPECT_EQ(surface(one, "b.stl").names.facets, (ByMarker{{0, "first part"}}));
}

TEST_F(NamesOfFiles, AreUtf8) {
  std::string text = kStl;
  text.replace(text.find("first part"), 10, "\xC3\x9C\xFF\x01");
  EXPECT_EQ(surface(text, "a.stl").names.facets, (ByMarker{{1, "\xC3\x9C?"}}));
}

TEST_F(NamesOfFiles, GroupsAndMaterialsOfObj) {
  const std::string points = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
  const Surface groups =
      surface(points + "g inlet\nvc 1 0 0\nusemtl red\nf 1 2 3\nf 1 2 4\ng wall side\nf 1 3 4\n", "a.obj");
  EXPECT_EQ(groups.facet_markers, (std::vector<int>{1, 1, 2}));
  EXPECT_EQ(groups.names.facets, (ByMarker{{1, "inlet"}, {2, "wall side"}}));
  ASSERT_EQ(groups.remarks.size(), 1u);
  EXPECT_EQ(groups.remarks[0].message, "2 lines of looks, groups or names (vc, usemtl) are left out");
  const Surface materials = surface(points + "f 1 2 3\nusemtl red\nf 1 2 4\nusemtl blue\nf 1 3 4\n", "b.obj");
  EXPECT_EQ(materials.facet_markers, (std::vector<int>{0, 1, 2}));
  EXPECT_EQ(materials.names.facets, (ByMarker{{1, "red"}, {2, "blue"}}));
  EXPECT_EQ(surface(points + "o part\nf 1 2 3\n", "c.obj").names.facets, (ByMarker{{0, "part"}}));
}

TEST_F(NamesOfFiles, MarkersOfPly) {
  const std::string text =
      "ply\nformat ascii 1.0\ncomment surface 7 inlet\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nproperty short marker\nelement face 2\nproperty int marker\n"
      "property list uchar int vertex_indices\nend_header\n0 0 0 5\n1 0 0 0\n0 1 0 0\n7 3 0 1 2\n-3 3 0 2 "
      "1\n";
  const Surface read = surface(text, "a.ply");
  EXPECT_EQ(read.facet_markers, (std::vector<int>{7, -3}));
  EXPECT_EQ(read.vertex_markers, (std::vector<int>{5, 0, 0}));
  EXPECT_EQ(read.names.facets, (ByMarker{{7, "inlet"}}));
  EXPECT_TRUE(read.remarks.empty());
}

TEST_F(NamesOfFiles, PhysicalGroupsOfGmsh) {
  EXPECT_EQ(surface(kMsh2, "a.msh").names.facets, (ByMarker{{7, "wall"}}));
  std::string text = kMsh2;
  text.replace(text.find("1\n2 7"), 2, "2\n3 9 \"a \"solid\" one\"\n");
  put(folder_ / "b.msh", text);
  EXPECT_EQ(read_volume(folder_ / "b.msh").names.regions, (ByMarker{{9, "a \"solid\" one"}}));
}

TEST_F(NamesOfFiles, ArraysOfOtherPrograms) {
  std::string text = kVtk;
  ASSERT_NE(text.find("region"), std::string::npos);
  const Volume ours = [&] {
    put(folder_ / "a.vtk", text);
    return read_volume(folder_ / "a.vtk");
  }();
  for (std::size_t at; (at = text.find("region")) != std::string::npos;) text.replace(at, 6, "mat_id");
  put(folder_ / "b.vtk", text);
  EXPECT_EQ(read_volume(folder_ / "b.vtk").regions, ours.regions);
}

TEST_F(NamesOfFiles, GoThroughSurfaceFiles) {
  Surface original = small::box();
  for (std::size_t f = 0; f < original.facets.size(); ++f)
    original.facet_markers.push_back(f < 4 ? 3 : f < 8 ? 12 : 0);
  original.names.facets = {{3, "in \"let\""},
                           {12,
                            "\xC3\xBC"
                            "bergang"}};
  for (const char* name : {"a.stl", "a.obj", "a.ply", "a.msh", "a.vtu", "a.vtk"}) {
    write_surface(folder_ / name, original);
    const Surface copy = read_surface(folder_ / name);
    ASSERT_EQ(copy.facet_markers.size(), original.facet_markers.size()) << name;
    std::vector<std::string> of_facets, expected;
    for (const int marker : copy.facet_markers)
      of_facets.push_back(copy.names.facets.contains(marker) ? copy.names.facets.at(marker) : "");
    std::sort(of_facets.begin(), of_facets.end());
    for (const char c : std::string("aaaabbbbcccc"))
      expected.push_back(c == 'a' ? "" : c == 'b' ? original.names.facets[3] : original.names.facets[12]);
    if (std::string(name) == "a.obj")
      std::replace(expected.begin(), expected.end(), original.names.facets[3], std::string("in__let_"));
    if (std::string(name) == "a.msh")
      std::replace(expected.begin(), expected.end(), original.names.facets[3], std::string("in _let_"));
    if (std::string(name) == "a.stl")  // solids are numbered anew, and each has a name
      std::replace(expected.begin(), expected.end(), std::string(), std::string("surface_0"));
    std::sort(expected.begin(), expected.end());
    EXPECT_EQ(of_facets, expected) << name;
  }
}

TEST(Patches, OfABox) {
  Surface box = small::box();
  EXPECT_EQ(markers_by_angle(box, 30), 6u);
  EXPECT_EQ(std::count(box.facet_markers.begin(), box.facet_markers.end(), 6), 2);
  EXPECT_EQ(box.facet_markers[0], 1);
  EXPECT_EQ(markers_by_angle(box, 30), 0u);
  Surface smooth = small::box();
  EXPECT_EQ(markers_by_angle(smooth, 91), 1u);
  EXPECT_THROW(markers_by_angle(smooth, 181), std::invalid_argument);
}

TEST(Patches, GoRoundMarkersThatAreThere) {
  Surface box = small::box();
  box.facet_markers.assign(box.facets.size(), 0);
  box.facet_markers[0] = 2;
  // A facet of opposite orientation does not end a patch, nor do vertices that occur twice.
  std::swap(box.facets[5][0], box.facets[5][1]);
  const Index copy = box.facets[7][0];
  box.vertices.push_back(box.vertices[copy]);
  box.facets[7][0] = static_cast<Index>(box.vertices.size() - 1);
  EXPECT_EQ(markers_by_angle(box, 30), 6u);
  EXPECT_EQ(box.facet_markers[0], 2);
  EXPECT_EQ(std::count(box.facet_markers.begin(), box.facet_markers.end(), 2), 1);
}

TEST_F(NamesOfFiles, OfIdsWithoutEntitiesAreNotGivenToOthers) {
  Volume volume;
  volume.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  volume.tetrahedra = {{0, 1, 2, 3}};
  volume.regions = {0};
  volume.facets = {{0, 2, 1}, {0, 1, 3}};
  volume.facet_markers = {0, 2};
  volume.names.facets = {{1, "gone"}, {2, "there"}};
  volume.names.regions = {{1, "gone, too"}};
  for (const std::string name : {"a.msh", "a.bdf", "a.unv", "a.exo", "a.k", "a.cdb", "a.vol", "a.med"}) {
    write_volume(folder_ / name, volume);
    Volume read = read_volume(folder_ / name);
    std::sort(read.facet_markers.begin(), read.facet_markers.end());  // formats sort facets by their markers
    EXPECT_EQ(read.facet_markers, (std::vector<int>{0, 2})) << name;
    EXPECT_EQ(read.names.facets, (ByMarker{{2, "there"}})) << name;
    EXPECT_TRUE(read.names.regions.empty()) << name;
  }
}

// As Gmsh writes them with Mesh.SaveAll: an entity without a group has its own number, which may equal a
// group's.
TEST_F(NamesOfFiles, OfGroupsAreNotThoseOfEntitiesWithTheirNumber) {
  const std::string nodes = "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n";
  const std::string head =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n2 3 \"inlet\"\n$EndPhysicalNames\n";
  const auto read = [&](const std::string& groups) {
    put(folder_ / "a.msh", head + nodes + "$Elements\n4\n1 2 2 " + groups + " 1 1 3 2\n2 2 2 0 3 1 2 4\n" +
                               "3 2 2 0 2 2 3 4\n4 2 2 0 3 1 4 3\n$EndElements\n");
    return read_surface(folder_ / "a.msh");
  };
  const Surface one = read("3");
  EXPECT_EQ(one.facet_markers, (std::vector<int>{3, 1, 2, 1}));
  EXPECT_EQ(one.names.facets, (std::map<int, std::string>{{3, "inlet"}}));
  ASSERT_EQ(one.remarks.size(), 1u);
  EXPECT_EQ(one.remarks[0].kind, RemarkKind::renumbered);
  EXPECT_EQ(one.remarks[0].message,
            "the triangles of the entity 3, which is in no group, get the id 1, since a group is 3");
  const Surface none = read("0");
  EXPECT_EQ(none.facet_markers, (std::vector<int>{1, 3, 2, 3}));
  EXPECT_TRUE(none.names.facets.empty());
  ASSERT_EQ(none.remarks.size(), 1u);
  EXPECT_EQ(none.remarks[0].message, "the name of the group 3, which has no triangles, is left out");
}

TEST_F(NamesOfFiles, OfTheGroupsOfAnEntityTheFirstCountsAndTheOthersAreTold) {
  put(folder_ / "a.msh",
      "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n2 7 \"skin\"\n2 9 \"inlet\"\n"
      "$EndPhysicalNames\n$Entities\n0 0 2 0\n1 0 0 0 1 1 0 2 7 9 0\n2 0 0 0 1 1 0 2 7 9 0\n$EndEntities\n"
      "$Nodes\n1 4 1 4\n2 1 0 4\n1\n2\n3\n4\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n$EndNodes\n"
      "$Elements\n2 2 1 2\n2 1 2 1\n1 1 3 2\n2 2 2 1\n2 1 2 4\n$EndElements\n");
  const Surface s = read_surface(folder_ / "a.msh");
  EXPECT_EQ(s.facet_markers, (std::vector<int>{7, 7}));
  ASSERT_EQ(s.remarks.size(), 1u);
  EXPECT_EQ(s.remarks[0].message, "1 physical group of entities that are in one before is left out");
}

/// Gmsh writes these once for each group, one after the other, with the tag of their entity.
TEST_F(NamesOfFiles, OfTheGroupsOfAnElementTheFirstCountsAndTheOthersAreTold) {
  const std::string nodes = "4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n";
  for (const bool is_version_2 : {true, false}) {
    // Groups 7 and 9 have the first triangle, 7, 8 and 9 the second. The last one is of another entity.
    std::string elements = "6\n";
    for (const char* const element :
         {"7 1 1 3 2", "9 1 1 3 2", "7 1 1 2 4", "8 1 1 2 4", "9 1 1 2 4", "9 2 2 3 4"}) {
      const std::string of(element);
      elements += is_version_2 ? "1 2 2 " + of + "\n" : "1 2 " + of.substr(0, 4) + "3 " + of.substr(4) + "\n";
    }
    put(folder_ / "a.msh", is_version_2 ? "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n" + nodes +
                                              "$EndNodes\n$Elements\n" + elements + "$EndElements\n"
                                        : "$NOD\n" + nodes + "$ENDNOD\n$ELM\n" + elements + "$ENDELM\n");
    const Surface s = read_surface(folder_ / "a.msh");
    EXPECT_EQ(s.facet_markers, (std::vector<int>{7, 7, 9}));
    ASSERT_EQ(s.remarks.size(), 1u);
    EXPECT_EQ(s.remarks[0].message, "2 physical groups of entities that are in one before are left out");
  }
}

}  // namespace
}  // namespace holdfast::io_names_test
