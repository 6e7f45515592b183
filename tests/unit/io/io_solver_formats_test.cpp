// Formats of solvers: volumes of first and second order read back with their regions, markers and names;
// names that a format does not allow never break it; errors in files name their lines.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "holdfast/second_order.h"
#include "io_samples.h"

namespace holdfast::io_solver_formats_test {
namespace {

using namespace samples;

/// Two tetrahedra of regions 10 and 20 with an interface, in a common face.
Volume assembly() {
  Volume volume;
  volume.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.1, 0.2, -1.0 / 3}};
  volume.tetrahedra = {{0, 1, 2, 3}, {0, 2, 1, 4}};
  volume.regions = {10, 20};
  volume.facets = {{0, 1, 3}, {1, 2, 3}, {0, 3, 2}, {0, 2, 1}, {0, 4, 1}, {2, 1, 4}, {0, 2, 4}};
  volume.facet_markers = {1, 2, 2, 7, 3, 3, 3};
  volume.names.facets = {{1, "inlet"}, {2, "wall"}, {7, "between"}};
  volume.names.regions = {{10, "core"}, {20, "shell"}};
  return volume;
}

struct Held {
  std::string name;
  bool exact = true;       ///< coordinates keep their bits
  bool interfaces = true;  ///< facets inside
  bool regions = true;
  bool second = true;  ///< second order
  WriteOptions options = {};
  bool corners = true;  ///< tetrahedra keep the order of their corners
};

std::vector<Held> formats() {
  WriteOptions legacy, binary, legacy_binary, one_file;
  legacy.legacy_msh = legacy_binary.legacy_msh = true;
  binary.binary = legacy_binary.binary = true;
  one_file.one_file = true;
  return {{"a.vtu"},
          {"a.vtu", true, true, true, true, one_file},
          {"a.vtm"},
          {"a.vtk"},
          {"a.msh"},
          {"a.msh", true, true, true, true, legacy},
          {"a.msh", true, true, true, true, binary},
          {"a.msh", true, true, true, true, legacy_binary},
          {"a.inp"},
          {"a.unv"},
          {"a.vol"},
          {"a.exo"},
          {"a.cgns"},
          {"a.k"},
          {"a.cdb"},
          {"a.feb"},
          {"a.fluent", true, true, true, false, {}, false},
          {"a.bdf"},
          {"a.mfem", true, true, true, false},
          {"a.su2", true, false, false, false}};
}

/// The even permutation with the least corner first, then the least of the others.
template <std::size_t N>
void turn_to_least(std::array<Index, N>& corners) {
  const auto least = std::min_element(corners.begin(), corners.end());
  if (least != corners.begin()) {
    std::iter_swap(corners.begin(), least);
    std::swap(corners[N - 2], corners[N - 1]);
  }
  std::rotate(corners.begin() + 1, std::min_element(corners.begin() + 1, corners.end()), corners.end());
}

template <std::size_t N>
std::vector<std::pair<std::array<Index, N>, int>> tagged(const std::vector<std::array<Index, N>>& entities,
                                                         const std::vector<int>& tags, bool corners = true) {
  std::vector<std::pair<std::array<Index, N>, int>> result;
  for (std::size_t i = 0; i < entities.size(); ++i) {
    auto entity = entities[i];
    // A facet may begin with another corner.
    if (N == 3) std::rotate(entity.begin(), std::min_element(entity.begin(), entity.end()), entity.end());
    if (N == 4 && !corners) turn_to_least(entity);
    result.emplace_back(entity, tags.empty() ? 0 : tags[i]);
  }
  std::sort(result.begin(), result.end());
  return result;
}

void drop_interface(Volume& volume) {
  volume.facets.erase(volume.facets.begin() + 3);
  volume.facet_markers.erase(volume.facet_markers.begin() + 3);
  volume.names.facets.erase(7);
}

void expect_held(const Held& held, Volume original, const Volume& copy) {
  if (!held.interfaces) drop_interface(original);
  if (!held.regions) {
    original.regions.assign(original.regions.size(), 0);
    original.names.regions.clear();
  }
  ASSERT_EQ(copy.vertices.size(), original.vertices.size()) << held.name;
  for (std::size_t i = 0; i < original.vertices.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_NEAR(copy.vertices[i][k], original.vertices[i][k], held.exact ? 0 : 1e-13) << held.name;
  EXPECT_EQ(copy.tetrahedra.size(), original.tetrahedra.size()) << held.name;
  EXPECT_EQ(tagged(copy.tetrahedra, copy.regions, held.corners),
            tagged(original.tetrahedra, original.regions, held.corners))
      << held.name;
  EXPECT_EQ(tagged(copy.facets, copy.facet_markers), tagged(original.facets, original.facet_markers))
      << held.name;
  EXPECT_EQ(copy.names.facets, original.names.facets) << held.name;
  EXPECT_EQ(copy.names.regions, original.names.regions) << held.name;
}

TEST(SolverFormats, KeepRegionsMarkersAndNames) {
  for (const Held& held : formats()) {
    const TemporaryFolder folder;
    write_volume(folder / held.name, assembly(), held.options);
    expect_held(held, assembly(), read_volume(folder / held.name));
  }
}

TEST(SolverFormats, KeepIdsWithoutNames) {
  Volume volume = assembly();
  volume.names = {};
  volume.facet_markers = {0, 0, 0, 7, 3, 3, -4};
  volume.regions = {0, 10};
  for (const Held& held : formats()) {
    const TemporaryFolder folder;
    write_volume(folder / held.name, volume, held.options);
    expect_held(held, volume, read_volume(folder / held.name));
  }
}

TEST(SolverFormats, UnmarkedFacetsGetTheNextFreeNumber) {
  const TemporaryFolder folder;
  Volume volume = assembly();
  volume.facet_markers = {0, 1, 1, 0, 2, 2, 2};
  volume.names = {};
  WriteOptions legacy;
  legacy.legacy_msh = true;
  write_volume(folder / "a.msh", volume, legacy);
  const std::string text = get(folder / "a.msh");
  EXPECT_NE(text.find("2 3 \"surface_0\""), std::string::npos) << text;
  EXPECT_NE(text.find("1 2 2 3 3 1 2 4"), std::string::npos)
      << text;  // triangle, two tags, the physical one 3
  bool told = false;
  for (const Remark& remark : not_held(folder / "a.msh", volume, legacy))
    told = told || (remark.kind == RemarkKind::renumbered && remark.message.find("marker 0 is 3") == 0);
  EXPECT_TRUE(told);
}

TEST(SolverFormats, KeepSecondOrder) {
  Volume volume = assembly();
  add_mid_nodes(volume);
  volume.mid_nodes.points[2][0] += 0.0625;  // so that no two orders of nodes are equivalent
  for (const Held& held : formats()) {
    const TemporaryFolder folder;
    write_volume(folder / held.name, volume, held.options);
    const Volume copy = read_volume(folder / held.name);
    expect_held(held, volume, copy);
    if (!held.second) {
      EXPECT_TRUE(copy.mid_nodes.empty()) << held.name;
      EXPECT_FALSE(not_held(folder / held.name, volume, held.options).empty()) << held.name;
      continue;
    }
    ASSERT_EQ(copy.mid_nodes.tetrahedra.size(), volume.tetrahedra.size()) << held.name;
    ASSERT_EQ(copy.mid_nodes.facets.size(), volume.facets.size()) << held.name;
    const auto near_middles = [&](const auto& corners, const auto& mids, const auto& edges) {
      for (std::size_t i = 0; i < corners.size(); ++i)
        for (std::size_t e = 0; e < edges.size(); ++e) {
          const Point& a = copy.vertices[corners[i][edges[e][0]]];
          const Point& b = copy.vertices[corners[i][edges[e][1]]];
          const Point& m = copy.mid_nodes.points[mids[i][e] - copy.vertices.size()];
          for (std::size_t k = 0; k < 3; ++k)
            EXPECT_NEAR(m[k], (a[k] + b[k]) / 2, k == 0 ? 0.07 : 1e-13) << held.name << " edge " << e;
        }
    };
    using Edge = std::array<std::size_t, 2>;
    near_middles(copy.tetrahedra, copy.mid_nodes.tetrahedra,
                 std::array<Edge, 6>{Edge{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}});
    near_middles(copy.facets, copy.mid_nodes.facets, std::array<Edge, 3>{Edge{0, 1}, {1, 2}, {0, 2}});
    // By their corners alone, as a surface.
    EXPECT_EQ(read_surface(folder / held.name).facets.size(), copy.facets.size()) << held.name;
    EXPECT_EQ(read_surface(folder / held.name).vertices.size(), volume.vertices.size()) << held.name;
  }
}

TEST(SolverFormats, NamesNeverBreakAFile) {
  Volume volume = assembly();
  volume.names.facets = {{1, std::string(300, 'x')},
                         {2, "a \"quoted\" name, with 'all' of it; {and} more"},
                         {3,
                          "\xC3\x9C"
                          "bergang \xE2\x86\x92 \xE5\x85\xA5\xE5\x8F\xA3"},
                         {7, std::string(300, 'x')}};  // the same again
  volume.names.regions = {{10, "core \"1\""}, {20, "core '1'"}};
  for (const Held& held : formats()) {
    const TemporaryFolder folder;
    write_volume(folder / held.name, volume, held.options);
    const Volume copy = read_volume(folder / held.name);
    Volume plain = volume;
    plain.names = copy.names;
    if (!held.interfaces) plain.names.facets[7] = "";
    expect_held(held, plain, copy);
    EXPECT_EQ(copy.names.facets.size(), held.interfaces ? 4u : 3u) << held.name;
    EXPECT_EQ(copy.names.regions.size(), held.regions ? 2u : 0u) << held.name;
    std::set<std::string> names;
    for (const auto& [id, name] : copy.names.facets) names.insert(name);
    if (held.name.starts_with("a.vt")) {
      EXPECT_EQ(copy.names, volume.names);  // which hold every name
    } else {
      EXPECT_EQ(names.size(), copy.names.facets.size()) << held.name;  // sets are told apart by their names
    }
  }
}

TEST(SolverFormats, AVtuAndItsSurfaceBelongTogether) {
  const TemporaryFolder folder;
  write_volume(folder / "a.vtu", assembly());
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"a.vtu", "a_surface.vtu"}));
  const std::string grid = get(folder / "a.vtu");
  EXPECT_NE(grid.find("NumberOfCells=\"2\""), std::string::npos);
  EXPECT_NE(grid.find("Name=\"mat_id\""), std::string::npos);
  // Another volume's surface is refused, and a missing one is reported.
  Volume other = assembly();
  other.vertices[4][2] = -0.5;
  write_volume(folder / "b.vtu", other);
  std::filesystem::copy_file(folder / "b_surface.vtu", folder / "a_surface.vtu",
                             std::filesystem::copy_options::overwrite_existing);
  EXPECT_THROW(static_cast<void>(read_volume(folder / "a.vtu")), FileError);
  std::filesystem::remove(folder / "a_surface.vtu");
  std::vector<Remark> remarks;
  EXPECT_TRUE(read_volume(folder / "a.vtu", {}, &remarks).facets.empty());
  ASSERT_EQ(remarks.size(), 1u);
  EXPECT_NE(remarks[0].message.find("a_surface.vtu"), std::string::npos);
}

TEST(SolverFormats, MeshbIsOfVersion2) {
  const TemporaryFolder folder;
  write_volume(folder / "a.meshb", assembly());
  EXPECT_EQ(get(folder / "a.meshb")[4], 2);
}

std::string error(const std::string& name, const std::string& bytes) {
  const TemporaryFolder folder;
  put(folder / name, bytes);
  try {
    static_cast<void>(read_volume(folder / name));
  } catch (const FileError& e) {
    return std::string(e.what()).substr((folder / name).string().size() + 2);
  }
  return "read";
}

/// As I-DEAS Test writes them.
TEST(SolverFormats, UniversalNodesOfOneLine) {
  TemporaryFolder folder;
  put(folder / "a.unv",
      "    -1\n    15\n"
      "         1         0         0        11  0.00000E+00  0.00000E+00  0.00000E+00\n"
      "         2         0         0        11  1.50000E+00  0.00000E+00  0.00000E+00\n"
      "         7         0         0        11  0.00000E+00  1.00000E+00  0.00000E+00\n"
      "         4         0         0        11  0.00000E+00  0.00000E+00 -1.00000E+00\n"
      "    -1\n    -1\n  2412\n         1       111         3         1         7         4\n"
      "         1         7         2         4\n    -1\n");
  const Volume v = read_volume(folder / "a.unv");
  ASSERT_EQ(v.vertices.size(), 4u);
  EXPECT_EQ(v.vertices[1], (Point{1.5, 0, 0}));
  EXPECT_EQ(v.vertices[3], (Point{0, 0, -1}));
  EXPECT_EQ(v.tetrahedra, (std::vector<Tetrahedron>{{0, 2, 1, 3}}));
  EXPECT_EQ(v.regions, (std::vector<int>{3}));
  EXPECT_EQ(error("a.unv", "-1\n15\n1 1 1 1 0. 0.\n-1\n"), "line 3: a node of dataset 15 has seven numbers");
}

TEST(SolverFormats, BadFilesAreToldByTheirLines) {
  EXPECT_EQ(error("a.inp", "*NODE\n1, 0, 0, 0\n2, 1, x, 0\n"), "line 3: expected a coordinate, found 'x'");
  EXPECT_EQ(error("a.inp", "*NODE\n1, 0, 0, 0\n*ELEMENT, TYPE=C3D4\n1, 1, 1, 1, 9\n"),
            "line 4: the node 9 does not exist");
  EXPECT_EQ(error("a.inp", "*NODE\n1, 0, 0, 0\n*ELEMENT, TYPE=C3D9\n").substr(0, 32),
            "line 3: elements of type 'C3D9' ");
  EXPECT_EQ(error("a.inp", "*NODE\n1, 0, 0, 0\n1, 0, 0, 0\n"), "the node 1 occurs twice");
  EXPECT_EQ(error("a.inp", "*NODE\n1, 0, 0, 0\n*SURFACE, NAME=s\n5, S1\n"),
            "line 4: the element 5 does not exist");
  EXPECT_EQ(
      error("a.inp", "*SYSTEM\n1, 0, 0\n*NODE\n1, 0, 0, 0\n"),
      "line 1: nodes in coordinates of their own (*SYSTEM) are not read; save them in global coordinates");
  EXPECT_EQ(
      error("a.inp", "*NODE, SYSTEM=C\n1, 1, 90, 0\n"),
      "line 1: nodes in cylindrical coordinates (SYSTEM=C) are not read; save them in global coordinates");
  EXPECT_EQ(error("a.unv", "    -1\n  2411\n         1\n"),
            "line 4: the file ends where -1, which ends a dataset, is expected; it is truncated");
  EXPECT_EQ(error("a.unv", "-1\n2411\n1 1 1 1\n0 0 0\n-1\n-1\n2412\n1 117 1 1 7 1\n1\n-1\n").substr(0, 32),
            "line 9: elements of type 117 are");
  EXPECT_EQ(error("a.bdf", "BEGIN BULK\nGRID,1,,0.,0.,0.\nCTETRA,1,1,1,1,1,2\n"),
            "line 3: the grid point 2 does not exist");
  EXPECT_EQ(error("a.bdf", "GRID           1      7      0.      0.      0.\n"),
            "line 1: a grid point in a coordinate system of its own is not read");
  for (const char* text :
       {"GRDSET,,7\nGRID,1,,0.,0.,0.\nGRID,2,0,0.,0.,0.\n", "GRDSET,,7,,,,6\nGRID,1\nENDDATA\n"})
    EXPECT_EQ(error("a.bdf", text), "line 1: grid points in a coordinate system of their own are not read");
  EXPECT_EQ(error("a.su2", "NDIME= 3\nNELEM= 1\n10 0 1 2 3\nNPOIN= 1\n0 0 0\n"),
            "line 3: the point 1 does not exist; there are 1");
  EXPECT_EQ(error("a.su2", "NDIME= 4\n"), "line 1: the dimension is neither 2 nor 3");
  EXPECT_EQ(error("a.mfem",
                  "MFEM mesh v1.0\ndimension\n3\nelements\n1\n1 4 0 1 2 9\nboundary\n0\nvertices\n1\n3\n"
                  "0 0 0\n"),
            "line 6: the vertex 1 does not exist; there are 1");
  EXPECT_EQ(error("a.mfem", "MFEM NC mesh v1.0\n").substr(0, 30), "line 1: not an MFEM mesh of ve");
  EXPECT_EQ(error("a.vol", "mesh3d\ndimension\n3\nvolumeelements\n1\n1 4 1 2 3 4\npoints\n1\n0 0 0\n"),
            "line 6: the point 2 does not exist; there are 1");
  EXPECT_EQ(error("a.vtm", "<VTKFile type=\"vtkMultiBlockDataSet\"></VTKFile>"), "the file names no blocks");
}

TEST(SolverFormats, BulkDataOfOtherPrograms) {
  const TemporaryFolder folder;
  put(folder / "a.nas",
      "SOL 101\nCEND\nBEGIN BULK\n$ANSA_NAME_COMMENT;5;PSOLID;steel;NO\n"
      "GRID           1              0.      0.      0.\n"
      "GRID*                  2                           1.0-0           0.0+0\n*                      0.\n"
      "GRID,3,,0.,1.,0.\nGRID,4,,0.,0.,1.D0\n"
      "CTETRA         9       5       1       2       3       4\n"
      "CTRIA3,10,6,1,2,3\nPSOLID,5,1\nENDDATA\nrubbish\n");
  std::vector<Remark> remarks;
  const Volume named = read_volume(folder / "a.nas", {}, &remarks);
  EXPECT_EQ(named.vertices, (std::vector<Point>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}));
  EXPECT_EQ(named.names.regions, (std::map<int, std::string>{{5, "steel"}}));
  EXPECT_EQ(named.facet_markers, (std::vector<int>{6}));
  ASSERT_EQ(remarks.size(), 1u);
  EXPECT_EQ(remarks[0].message, "1 card ('psolid') is left out");
  put(folder / "b.nas",
      "GRID           1              0.      0.      0.\nGRID           2              1.      0.      0.\n"
      "GRID           3              0.      1.      0.\nGRID,4,,0.,0.,1.D0\nCTETRA,9,5,1,2,3,4\n");
  const Volume volume = read_volume(folder / "b.nas");
  EXPECT_EQ(volume.tetrahedra.size(), 1u);
  EXPECT_EQ(volume.regions, (std::vector<int>{5}));
  EXPECT_EQ(volume.vertices[3], (Point{0, 0, 1}));
}

TEST(SolverFormats, FieldsOfBulkData) {
  const std::string tetrahedron = "CTETRA         9       5       1       2       3       4\n";
  const std::vector<std::string> variants = {
      // Four wide fields a line, also between commas, with and without what joins the lines.
      "GRID*,1,,0.,0.\n*,0.\nGRID*,2,,1.,0.,*\n*,0.\nGRID*,3,,0.,1.,*N\n*N,0.\nGRID*,4,,0.,0.\n*,1.\n" +
          tetrahedron,
      // Tabs go to columns of eight.
      "GRID\t1\t\t0.\t0.\t0.\nGRID\t2\t0\t1.\t0.\t0.\nGRID\t       3\t0.\t1.\t0.\n"
      "GRID*\t4\t\t\t\t0.\t\t0.\n*\t1.\nCTETRA\t9\t5\t1\t2\t3\t4\n",
      // Between blanks, and in no columns.
      "GRID 1 0 0. 0. 0.\nGRID    2   0  1. 0. 0.\nGRID 3 0 0. 1. 0.\nGRID* 4 0 0. 0. *\n* 1.\n"
      "CTETRA 9 5 1 2 3 4\n",
      "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,0.,1.,0.\nGRID   *               4                "
      "              0.              0.\n*                     1.\n" +
          tetrahedron};
  const TemporaryFolder folder;
  for (const std::string& text : variants) {
    put(folder / "a.fem", text);
    const Volume volume = read_volume(folder / "a.fem");
    EXPECT_EQ(volume.vertices, (std::vector<Point>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}})) << text;
    EXPECT_EQ(volume.tetrahedra, (std::vector<Tetrahedron>{{0, 1, 2, 3}})) << text;
    EXPECT_EQ(volume.regions, (std::vector<int>{5})) << text;
  }
}

TEST(SolverFormats, ALongLineOfBulkDataKeepsItsNodes) {
  const TemporaryFolder folder;
  put(folder / "a.bdf",
      "GRID,1,,0.,0.,0.\nGRID,2,,2.,0.,0.\nGRID,3,,0.,2.,0.\nGRID,4,,0.,0.,2.\nGRID,5,,1.,0.,0.\n"
      "GRID,6,,1.,1.,0.\nGRID,7,,0.,1.,0.\nGRID,8,,0.,0.,1.\nGRID,9,,1.,0.,1.\nGRID,10,,0.,1.,1.\n"
      "CTETRA,9,5,1,2,3,4,5,6,7,8,9,10\n");
  EXPECT_EQ(read_volume(folder / "a.bdf").mid_nodes.points.size(), 6u);
}

TEST(SolverFormats, BulkDataWithSomeNodesOnEdges) {
  const TemporaryFolder folder;
  put(folder / "a.bdf",
      "GRID,1,,0.,0.,0.\nGRID,2,,2.,0.,0.\nGRID,3,,0.,2.,0.\nGRID,4,,0.,0.,2.\nGRID,5,,1.,0.,0.\n"
      "GRID,6,,2.,2.,0.\nGRID,7,,2.,1.,0.\nCTETRA,9,5,1,2,3,4,5\nCTRIA6,10,6,1,2,3,5\n"
      "CQUAD8,11,7,1,2,6,3,5,7\n");
  std::vector<Remark> remarks;
  const Volume volume = read_volume(folder / "a.bdf", {}, &remarks);
  EXPECT_EQ(volume.tetrahedra, (std::vector<Tetrahedron>{{0, 1, 2, 3}}));
  EXPECT_EQ(volume.facets, (std::vector<Triangle>{{0, 1, 2}, {0, 1, 4}, {0, 4, 2}}));
  EXPECT_EQ(volume.facet_markers, (std::vector<int>{6, 7, 7}));
  EXPECT_EQ(volume.vertices.size(), 5u);  // without those on edges
  EXPECT_FALSE(remarks.empty());
}

TEST(SolverFormats, OverlappingSetsOfAbaqus) {
  const TemporaryFolder folder;
  put(folder / "a.inp",
      "*Heading\n** a comment\n*Node\n1, 0., 0., 0.\n2, 1., 0., 0.\n3, 0., 1., 0.\n4, 0., 0., 1.\n5, 0., 0., "
      "-1.\n"
      "*Element, type=C3D4\n11, 1, 2, 3, 4\n12, 1, 3, 2,\n 5\n*Elset, elset=\"All of it\", generate\n11, 12, "
      "1\n"
      "*Elset, elset=Upper\n11,\n*Surface, type=ELEMENT, name=top\nUpper, S3\n12, S1\n*Material, name=x\n"
      "*Density\n1.\n");
  std::vector<Remark> remarks;
  const Volume volume = read_volume(folder / "a.inp", {}, &remarks);
  EXPECT_EQ(volume.regions, (std::vector<int>{2, 1}));
  EXPECT_EQ(volume.names.regions, (std::map<int, std::string>{{1, "All of it"}, {2, "Upper"}}));
  EXPECT_EQ(volume.names.facets, (std::map<int, std::string>{{1, "top"}}));
  ASSERT_EQ(volume.facets.size(), 2u);
  EXPECT_EQ(volume.facets[0], (Triangle{1, 2, 3}));  // S3 is of nodes 2 4 3: opposite node 1
  ASSERT_EQ(remarks.size(), 1u);
  EXPECT_NE(remarks[0].message.find("*density"), std::string::npos);
}

TEST(SolverFormats, ElementsOfAbaqusWithoutAShape) {
  const TemporaryFolder folder;
  put(folder / "a.inp",
      "*NODE\n1\n2, 1.\n3, 0., 1.\n4, 0., 0., 1.\n*ELEMENT, TYPE=C3D4, ELSET=solid\n1, 1, 2, 3, 4\n"
      "*ELEMENT, TYPE=SPRINGA, ELSET=springs\n2, 1, 4\n3, 2, 4\n*ELEMENT, TYPE=MASS\n4, 1\n"
      "*ELEMENT, TYPE=D\n5, 0, 2, 3\n*ELSET, ELSET=all\n1, 2, 3, 4, 5\n");
  std::vector<Remark> remarks;
  const Volume volume = read_volume(folder / "a.inp", {}, &remarks);
  // Missing coordinates are zero.
  EXPECT_EQ(volume.vertices, (std::vector<Point>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}));
  EXPECT_EQ(volume.tetrahedra, (std::vector<Tetrahedron>{{0, 1, 2, 3}}));
  EXPECT_TRUE(volume.segments.empty());
  EXPECT_EQ(volume.names.regions.size(), 2u);
  EXPECT_TRUE(volume.names.facets.empty());
  ASSERT_EQ(remarks.size(), 1u);
  EXPECT_EQ(remarks[0].count, 4u);
  EXPECT_NE(remarks[0].message.find("4 elements (D, MASS, SPRINGA) are left out"), std::string::npos);
  put(folder / "ds.inp",
      "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 1, 1, 0\n4, 0, 1, 0\n*ELEMENT, TYPE=DS4\n1, 1, 2, 3, 4\n");
  EXPECT_EQ(read_surface(folder / "ds.inp").facets.size(), 2u);
  put(folder / "b.inp", "*NODE\n1, 0, 0, 0\n*ELEMENT, TYPE=MASS\n1, 1\n*ELEMENT, TYPE=SPRINGA\n1, 1, 1\n");
  EXPECT_THROW((void)read_volume(folder / "b.inp"), FileError);  // the element 1 occurs twice
}

}  // namespace
}  // namespace holdfast::io_solver_formats_test
