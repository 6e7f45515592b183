// Files of ParaView that name other files, and volumes whose tetrahedra are all the other way round.
#include <gtest/gtest.h>

#include "io_samples.h"

namespace holdfast::io_vtk_lists_test {
namespace {

using namespace samples;

class VtkLists : public ::testing::Test {
 protected:
  static std::string vtp(const std::string& points, const std::string& corners) {
    return R"(<VTKFile type="PolyData"><PolyData><Piece NumberOfPoints="3" NumberOfPolys="1"><Points>
<DataArray type="Float64" NumberOfComponents="3" format="ascii">)" +
           points + R"(</DataArray></Points><Polys>
<DataArray type="Int32" Name="connectivity" format="ascii">)" +
           corners + R"(</DataArray><DataArray type="Int32" Name="offsets" format="ascii">3</DataArray>
</Polys></Piece></PolyData></VTKFile>)";
  }
  std::string pvd(const std::string& data_sets) {
    return "<VTKFile type=\"Collection\"><Collection>\n" + data_sets + "</Collection></VTKFile>";
  }
  std::string refusal(const std::string& name, const std::string& bytes) {
    put(folder_ / name, bytes);
    return replaced(refusal_of([&] { return read_surface(folder_ / name); }), (folder_ / "").string(), "");
  }
  TemporaryFolder folder_;
};

TEST_F(VtkLists, PiecesOfASurfaceAreJoined) {
  put(folder_ / "a_0.vtp", vtp("0 0 0 1 0 0 0 1 0", "0 1 2"));
  put(folder_ / "a_1.vtp", vtp("1 0 0 1 1 0 0 1 0", "0 1 2"));
  put(folder_ / "a.pvtp",
      "<VTKFile type=\"PPolyData\"><PPolyData><Piece Source=\"a_0.vtp\"/><Piece Source=\"a_1.vtp\"/>"
      "</PPolyData></VTKFile>");
  const Surface s = read_surface(folder_ / "a.pvtp");
  EXPECT_EQ(s.vertices.size(), 4U);
  EXPECT_EQ(s.facets, (std::vector<Triangle>{{0, 1, 2}, {1, 3, 2}}));
  EXPECT_EQ(files_of_surface(folder_ / "a.pvtp").size(), 5U);  // with files that may be beside the pieces
  EXPECT_EQ(refusal("b.pvtp", "<VTKFile type=\"PPolyData\"><Piece Source=\"a.vtu\"/></VTKFile>"),
            "line 1: a piece in the format '.vtu' is not read; only .vtp is");
}

TEST_F(VtkLists, APvdIsItsFirstTimeStep) {
  put(folder_ / "a.vtp", vtp("0 0 0 1 0 0 0 1 0", "0 1 2"));
  put(folder_ / "b.vtp", vtp("5 0 0 6 0 0 5 1 0", "2 1 0"));
  const std::string first = "<DataSet timestep=\"0\" part=\"0\" file=\"a.vtp\"/>\n",
                    second = "<DataSet timestep=\"0\" part=\"1\" file=\"b.vtp\"/>\n",
                    later = "<DataSet timestep=\"1\" part=\"0\" file=\"c.vtp\"/>\n";
  put(folder_ / "a.pvd", pvd(first + second + later));
  const Surface s = read_surface(folder_ / "a.pvd");
  EXPECT_EQ(s.facets, (std::vector<Triangle>{{0, 1, 2}, {5, 4, 3}}));
  ASSERT_EQ(s.remarks.size(), 1U);
  EXPECT_EQ(s.remarks[0].message, "1 file of a later time step is left out");
  EXPECT_EQ(files_of_surface(folder_ / "a.pvd"),
            (std::vector<std::filesystem::path>{folder_ / "a.pvd", folder_ / "a.vtp", folder_ / "b.vtp"}));

  EXPECT_EQ(refusal("b.pvd", pvd("")), "the file names no parts");
  EXPECT_EQ(refusal("b.pvd", "<VTKFile type=\"Else\"/>"),
            "not a ParaView collection: it has no VTKFile of this type");
  EXPECT_EQ(refusal("b.pvd", pvd(later)), "line 2: the part 'c.vtp': there is no such file");
  EXPECT_EQ(refusal("b.pvd", pvd(first + first)), "line 3: the file 'a.vtp' is named twice");
  EXPECT_EQ(refusal("b.pvd", pvd("<DataSet file=\"a.vti\"/>")),
            "line 2: a part in the format '.vti' is not read; .vtu, .vtp, .pvtu, .pvtp, .vtm and .vtk are");
}

TEST_F(VtkLists, APvdOfAVolumeReadsTheFileBesideIt) {
  write_volume(folder_ / "a.vtu", sample_volume());
  put(folder_ / "a.pvd", pvd("<DataSet timestep=\"0\" file=\"a.vtu\"/>"));
  const Volume volume = read_volume(folder_ / "a.pvd");
  EXPECT_EQ(volume.tetrahedra, sample_volume().tetrahedra);
  EXPECT_EQ(volume.facets.size(), sample_volume().facets.size());
}

TEST_F(VtkLists, TetrahedraThatAreAllNegativeAreReversedAndTold) {
  for (const char* name : {"a.vtu", "a.vtk", "a.xdmf", "a.vtm"}) {
    Volume volume;
    volume.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
    volume.tetrahedra = {{0, 2, 1, 3}, {1, 3, 2, 4}};
    volume.regions = {0, 0};
    write_volume(folder_ / name, volume);
    std::vector<Remark> remarks;
    EXPECT_EQ(read_volume(folder_ / name, {}, &remarks).tetrahedra,
              (std::vector<Tetrahedron>{{0, 1, 2, 3}, {1, 2, 3, 4}}))
        << name;
    ASSERT_EQ(remarks.size(), 1U) << name;
    EXPECT_EQ(remarks[0].message, "all tetrahedra are oriented opposite to VTK's, and are reversed");
  }
}

TEST_F(VtkLists, FlatTetrahedraThatAreNegativeInPlainArithmeticAloneStay) {
  // Of 1e-30; a repaired race track has them.
  Volume volume;
  volume.vertices = {{415.898, 8.0384799782245, -6.00812673398422e-05},
                     {406.5230000266864, 8.03847998391196, -4.506004146969719e-05},
                     {406.52300001876296, 8.03847998391196, -4.506004145700172e-05},
                     {406.5230000266864, 8.03847998391196, -4.506004146968684e-05}};
  volume.tetrahedra = {{0, 1, 2, 3}};
  volume.regions = {0};
  for (const char* name : {"a.vtu", "a.vtk", "a.xdmf", "a.med"}) {
    write_volume(folder_ / name, volume);
    std::vector<Remark> remarks;
    EXPECT_EQ(read_volume(folder_ / name, {}, &remarks).tetrahedra, volume.tetrahedra) << name;
    EXPECT_TRUE(remarks.empty()) << name;
  }
}

TEST_F(VtkLists, TetrahedraWithoutAnOrientationGetOne) {
  // Corners by their numbers, as legacy DOLFIN lists them.
  Volume volume;
  volume.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  volume.tetrahedra = {{0, 1, 2, 3}, {1, 2, 3, 4}};
  volume.regions = {0, 0};
  std::swap(volume.vertices[0], volume.vertices[4]);
  std::vector<Remark> remarks;
  write_volume(folder_ / "a.vtk", volume);
  EXPECT_EQ(read_volume(folder_ / "a.vtk", {}, &remarks).tetrahedra,
            (std::vector<Tetrahedron>{{0, 2, 1, 3}, {1, 3, 2, 4}}));
  volume.vertices[0] = {0.1, 0.1, 0.1};
  volume.vertices[4] = {1, 1, 1};
  volume.tetrahedra = {{0, 1, 2, 3}, {1, 3, 2, 4}};
  write_volume(folder_ / "a.xdmf", volume);
  EXPECT_EQ(read_volume(folder_ / "a.xdmf", {}, &remarks).tetrahedra,
            (std::vector<Tetrahedron>{{0, 1, 2, 3}, {1, 2, 3, 4}}));
  ASSERT_EQ(remarks.size(), 1U);
  EXPECT_EQ(remarks[0].message, "1 tetrahedron is oriented opposite to the others, and reversed");
  // A vertex beyond the opposite face tangles a mesh: neighbours fit, and stay.
  volume.tetrahedra = {{0, 1, 2, 3}, {1, 2, 3, 4}};
  volume.vertices[4] = {0, 0, 0};
  write_volume(folder_ / "b.vtu", volume);
  EXPECT_EQ(read_volume(folder_ / "b.vtu", {}, &remarks).tetrahedra, volume.tetrahedra);
  EXPECT_TRUE(remarks.empty());
}

TEST_F(VtkLists, OtherEndingsOfXdmfAndVrml) {
  write_volume(folder_ / "a.xmf", sample_volume());
  EXPECT_EQ(read_volume(folder_ / "a.xmf").facets.size(), sample_volume().facets.size());
  EXPECT_EQ(files_of_volume(folder_ / "a.xmf").size(), 4U);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "a_surface.xmf"));
  put(folder_ / "a.vrml",
      "#VRML V2.0 utf8\nShape { geometry IndexedFaceSet { coord Coordinate { point [0 0 0, 1 0 0, 0 1 0] } "
      "coordIndex [0 1 2 -1] } }\n");
  EXPECT_EQ(read_surface(folder_ / "a.vrml").facets.size(), 1U);
}

}  // namespace
}  // namespace holdfast::io_vtk_lists_test
