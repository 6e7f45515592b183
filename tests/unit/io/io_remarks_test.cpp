// Nothing is dropped silently: what readers leave out, what writers cannot hold, markers of vertices, and
// limits on volumes.
#include <gtest/gtest.h>

#include <cmath>

#include "holdfast/surface_io.h"
#include "io_samples.h"

namespace holdfast::io_remarks_test {
namespace {

using namespace samples;

class Remarks : public ::testing::Test {
 protected:
  Surface surface(const std::string& bytes, const std::string& name) {
    put(folder_ / name, bytes);
    return read_surface(folder_ / name);
  }
  /// The messages, one per line.
  static std::string messages(const std::vector<Remark>& remarks) {
    std::string all;
    for (const Remark& remark : remarks) all += remark.message + "\n";
    return all;
  }
  std::string said(const std::string& bytes, const std::string& name) {
    return messages(surface(bytes, name).remarks);
  }
  TemporaryFolder folder_;
};

TEST_F(Remarks, SayWhatASurfaceHasNoPlaceFor) {
  const std::string triangle = "0 0 0\n1 0 0\n0 1 0\n";
  EXPECT_EQ(said("OFF 3 1 0\n" + triangle + "3 0 1 2\n", "a.off"), "");
  EXPECT_EQ(said("OFF 3 1 0\n0 0 0 9\n1 0 0\n0 1 0\n3 0 1 2 255 0 0\n", "a.off"),
            "2 vertices' and faces' normals, colours or texture coordinates are left out\n");
  EXPECT_EQ(said(binary_off(true), "a.off"),
            "6 vertices' and faces' normals, colours or texture coordinates are left out\n"
            "1 polygon of more than three corners is cut into triangles\n");
  EXPECT_EQ(said(kObj, "a.obj"),
            "1 colour or weight of a vertex is left out\n"
            "4 lines of looks, groups or names (vt, vn, s, mtllib) are left out\n"
            "1 polygon of more than three corners is cut into triangles\n");
  EXPECT_EQ(said(kPly, "a.ply"), "of every vertex is left out: red\nof every face is left out: flags\n");
  EXPECT_EQ(said(kMesh, "a.mesh"), "the section 'ridges' is left out\n1 tetrahedron is left out\n");
  EXPECT_EQ(said(binary_gmf(2, false), "a.meshb"),
            "the section of keyword 99 is left out\n1 tetrahedron is left out\n");
  EXPECT_EQ(said(kMsh2, "a.msh"), "1 tetrahedron is left out\n");
  EXPECT_EQ(said(kVtk, "a.vtk"), "2 arrays ('other', 'v') are left out\n1 tetrahedron is left out\n");
  EXPECT_EQ(said(kVtu, "a.vtu"), "1 tetrahedron is left out\n");
  EXPECT_EQ(said(kStrips, "a.vtk"), "1 array ('heat') is left out\n");
  EXPECT_EQ(said("3 3 2 0\n1 0 0 0 7.5 1\n2 1 0 0 7.5 1\n3 0 1 0 7.5 1\n1 0\n1\n3 1 2 3\n", "a.poly"),
            "6 attributes of vertices are left out\n");
  std::string stl = binary_stl("", {{0, 0, 0, 1, 0, 0, 0, 1, 0}, {1, 0, 0, 0, 1, 0, 0, 0, 1}});
  EXPECT_EQ(said(stl, "a.stl"), "");
  stl[84 + 48] = 1;
  EXPECT_EQ(said(stl, "a.stl"), "1 attribute of a triangle (its colour, perhaps) is left out\n");
}

TEST_F(Remarks, OfAppearance) {
  EXPECT_EQ(said("appearance { +edge }\nOFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "a.off"),
            "1 appearance is left out\n");
}

TEST_F(Remarks, HaveKindsAndCounts) {
  const Surface s = surface(kObj, "a.obj");
  ASSERT_EQ(s.remarks.size(), 3u);
  EXPECT_EQ(s.remarks[1].kind, RemarkKind::left_out);
  EXPECT_EQ(s.remarks[1].count, 4u);
  EXPECT_EQ(s.remarks[2].kind, RemarkKind::polygons_cut);
  EXPECT_EQ(s.remarks[2].count, 1u);
}

TEST_F(Remarks, OfVolumes) {
  put(folder_ / "a.msh", kMsh2);
  std::vector<Remark> remarks;
  static_cast<void>(read_volume(folder_ / "a.msh", {}, &remarks));
  EXPECT_EQ(messages(remarks), "");
}

TEST_F(Remarks, RegionsLimitsOnVolumesBecomeSizes) {
  // 12 digits: the cube root is computed differently here.
  std::string text = kPoly;
  text.replace(text.find("0.1 0.1 0.1 3 -1"), 16, "0.1 0.1 0.1 3 0.004");
  const Surface s = surface(text, "a.poly");
  ASSERT_EQ(s.regions.size(), 2u);
  EXPECT_NEAR(s.regions[0].size, std::cbrt(6 * std::sqrt(2.0) * 0.004), 1e-12);
  EXPECT_EQ(s.regions[1].size, 0);
  EXPECT_EQ(messages(s.remarks),
            "1 region's limit V on the volume of tetrahedra is taken as a size H = (6 sqrt(2) V)^(1/3)\n"
            "1 polygon of more than three corners is cut into triangles\n");
  EXPECT_EQ(s.remarks[0].kind, RemarkKind::size_limits);
  for (const auto& [volume, size] : {std::pair("1e-300", 2.0396489026555056e-100),
                                     {"1e300", 2.0396489026555056e100},
                                     {"0", 0.0},
                                     {"-1", 0.0},
                                     {"1", 2.0396489026555056}}) {
    text = kPoly;
    text.replace(text.find("0.1 0.1 0.1 3 -1"), 16, std::string("0.1 0.1 0.1 3 ") + volume);
    EXPECT_NEAR(surface(text, "a.poly").regions[0].size, size, 1e-14 * size) << volume;
  }
  text = kPoly;
  text.replace(text.find("0.1 0.1 0.1 3 -1"), 16, "0.1 0.1 0.1 3 nan");
  EXPECT_THROW(static_cast<void>(surface(text, "a.poly")), FileError);
}

TEST_F(Remarks, MarkersOfVerticesAreRead) {
  EXPECT_EQ(surface(kPoly, "a.poly").vertex_markers, (std::vector<int>(5, 1)));
  EXPECT_EQ(surface(kMesh, "a.mesh").vertex_markers, (std::vector<int>(4, 1)));
  EXPECT_TRUE(surface(kSmesh, "a.smesh").vertex_markers.empty());
  EXPECT_EQ(surface("3 3 1 1\n0 0 0 0 0.5 7\n1 1 0 0 0.5 -8\n2 0 1 0 0.5\n", "a.node").vertex_markers,
            (std::vector<int>{7, -8, 0}));
}

TEST_F(Remarks, SayWhatAFormatDoesNotHold) {
  const Volume volume = sample_volume();
  for (const char* name : {"a.vtu", "a.vtk", "a.mesh", "a.meshb", "a.node"})
    EXPECT_TRUE(not_held(folder_ / name, volume).empty()) << name;
  EXPECT_EQ(messages(not_held(folder_ / "a.msh", volume, legacy_msh())),
            "vertex marker -3 is 1 in the file, since .msh takes positive numbers alone\n"
            "segment marker 0 is 1 in the file, since .msh takes 0 for none\n"
            "marker -2147483647 is 1 in the file, since .msh takes positive numbers alone\n"
            "region -3 is 2 in the file, since .msh takes positive numbers alone\n");
  // The remark on the order is true.
  Volume turned = volume;
  std::swap(turned.tetrahedra[1], turned.tetrahedra[2]);
  turned.regions = {1, 3, 2};
  turned.facet_markers.assign(turned.facets.size(), 7);
  turned.segment_markers.assign(turned.segments.size(), 9);
  turned.vertex_markers.clear();
  EXPECT_EQ(not_held(folder_ / "b.msh", turned).size(), 1u);
  write_volume(folder_ / "b.msh", turned);
  EXPECT_NE(read_volume(folder_ / "b.msh").tetrahedra, turned.tetrahedra);
  EXPECT_TRUE(not_held(folder_ / "b.msh", turned, legacy_msh()).empty());
  write_volume(folder_ / "b.msh", turned, legacy_msh());
  EXPECT_EQ(read_volume(folder_ / "b.msh").tetrahedra, turned.tetrahedra);
}

TEST_F(Remarks, SayWhichMarkersAreLostWithASurface) {
  Surface surface;
  surface.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  surface.vertex_markers = {5, 0, 6, 7};
  surface.facets = {{0, 1, 2}};
  surface.segments = {{0, 3}, {1, 3}};
  surface.segment_markers = {0, 9};
  const auto lost = [&](const char* name) { return messages(not_held(folder_ / name, surface)); };
  for (const char* name : {"a.off", "a.obj"})
    EXPECT_EQ(lost(name), "3 vertices' markers have no place in " + std::string(name + 1) +
                              "\n1 segment's marker has no place in " + std::string(name + 1) + "\n");
  EXPECT_EQ(lost("a.stl"), "2 segments have no place in .stl\n3 vertices' markers have no place in .stl\n");
  EXPECT_EQ(lost("a.ply"), "2 segments have no place in .ply\n");
  for (const char* name : {"a.poly", "a.mesh", "a.vtu"}) EXPECT_EQ(lost(name), "") << name;
}

TEST_F(Remarks, SayWhichNamesAreLostOrChanged) {
  Surface surface;
  surface.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  surface.facets = {{0, 1, 2}, {0, 1, 3}};
  surface.facet_markers = {1, 2};
  surface.names.facets = {{0, "all"}, {1, "in let"}, {2, "wall"}};
  const auto lost = [&](const char* name) { return messages(not_held(folder_ / name, surface)); };
  EXPECT_EQ(lost("a.off"), "2 markers have no place in .off\n3 names have no place in .off\n");
  for (const char* name : {"a.poly", "a.mesh"})
    EXPECT_EQ(lost(name), "3 names have no place in " + std::string(name + 1) + "\n");
  EXPECT_EQ(lost("a.obj"), "1 name of a marker is changed to what .obj allows\n");
  for (const char* name : {"a.stl", "a.ply", "a.vtu"}) EXPECT_EQ(lost(name), "") << name;

  Volume volume = sample_volume();
  volume.names = {{{0, "skin"}}, {}, {}, {}};  // the name of all triangles of a file of one solid
  for (const char* name : {"a.mesh", "a.node", "a.xml"})
    EXPECT_NE(messages(not_held(folder_ / name, volume)).find("1 name has no place"), std::string::npos)
        << name;
  volume.names = {{}, {{1, "core"}}, {}, {}};
  for (const char* name : {"a.mesh", "a.meshb", "a.node"})
    EXPECT_EQ(messages(not_held(folder_ / name, volume)),
              "1 name has no place in " + std::string(name + 1) + "\n");
}

TEST_F(Remarks, AVolumeWithAnotherNumberOfVertexMarkersIsRefused) {
  Volume volume = sample_volume();
  volume.vertex_markers.pop_back();
  EXPECT_THROW(write_volume(folder_ / "a.vtu", volume), std::invalid_argument);
}

}  // namespace
}  // namespace holdfast::io_remarks_test
