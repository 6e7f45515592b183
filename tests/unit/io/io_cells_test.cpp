// Hexahedra, prisms and pyramids of every format become tetrahedra that fit together.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <random>
#include <sstream>

#include "holdfast/holdfast.h"
#include "io_samples.h"

namespace holdfast::io_cells_test {
namespace {

using namespace samples;

struct Cell {
  std::vector<int> corners;
  int region;
};

/// A cube of side 2 at (0, 0, 0) of region 3, a prism beside it at x = 2 and a pyramid on top, of region 4.
/// All share quadrangles; the volumes are 8, 4 and 8/3.
struct Block {
  std::vector<Point> points{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {0, 0, 2}, {2, 0, 2},
                            {2, 2, 2}, {0, 2, 2}, {4, 0, 0}, {4, 2, 0}, {1, 1, 4}};
  Cell cube{{0, 1, 2, 3, 4, 5, 6, 7}, 3};
  Cell prism{{1, 8, 5, 2, 9, 6}, 4};
  Cell pyramid{{4, 5, 6, 7, 10}, 4};
  std::vector<std::array<int, 4>> quadrangles{{0, 3, 2, 1}, {0, 1, 5, 4}, {1, 8, 9, 2}};  ///< of the boundary

  /// Renumbers the points.
  void shuffle(std::mt19937_64& random) {
    std::vector<int> number(points.size());
    std::iota(number.begin(), number.end(), 0);
    for (std::size_t i = number.size(); i > 1; --i) std::swap(number[i - 1], number[random() % i]);
    std::vector<Point> moved(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) moved[static_cast<std::size_t>(number[i])] = points[i];
    points = moved;
    const auto renumber = [&](auto& corners) {
      for (int& v : corners) v = number[static_cast<std::size_t>(v)];
    };
    for (Cell* cell : {&cube, &prism, &pyramid}) renumber(cell->corners);
    for (auto& quadrangle : quadrangles) renumber(quadrangle);
  }
};

template <typename Numbers>
std::string row(const Numbers& numbers, const char* between = " ", int first = 0) {
  std::ostringstream out;
  const char* before = "";
  for (const auto& x : numbers) {
    out << before << x + first;
    before = between;
  }
  return out.str();
}
std::string rows(const std::vector<Point>& points, const char* between = " ") {
  std::string all;
  for (const Point& p : points) all += row(p, between) + "\n";
  return all;
}

std::string medit(const Block& b) {
  std::string text = "MeshVersionFormatted 2\nDimension 3\nVertices\n11\n";
  for (const Point& p : b.points) text += row(p) + " 0\n";
  const auto section = [&](const char* name, const Cell& cell) {
    text +=
        std::string(name) + "\n1\n" + row(cell.corners, " ", 1) + " " + std::to_string(cell.region) + "\n";
  };
  section("Hexahedra", b.cube);
  section("Prisms", b.prism);
  section("Pyramids", b.pyramid);
  text += "Quadrilaterals\n3\n";
  for (const auto& q : b.quadrangles) text += row(q, " ", 1) + " 7\n";
  return text + "End\n";
}

std::string msh(const Block& b) {
  std::string text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n11\n";
  for (std::size_t i = 0; i < b.points.size(); ++i)
    text += std::to_string(i + 1) + " " + row(b.points[i]) + "\n";
  text += "$EndNodes\n$Elements\n6\n";
  int number = 0;
  const auto element = [&](int type, int tag, const auto& corners) {
    text += std::to_string(++number) + " " + std::to_string(type) + " 2 " + std::to_string(tag) + " 1 " +
            row(corners, " ", 1) + "\n";
  };
  for (const auto& q : b.quadrangles) element(3, 7, q);
  element(5, b.cube.region, b.cube.corners);
  element(6, b.prism.region, b.prism.corners);
  element(7, b.pyramid.region, b.pyramid.corners);
  return text + "$EndElements\n";
}

std::string vtk(const Block& b) {
  std::string text =
      "# vtk DataFile Version 3.0\nblock\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 11 double\n" +
      rows(b.points) + "CELLS 6 37\n";
  for (const auto& q : b.quadrangles) text += "4 " + row(q) + "\n";
  for (const Cell* cell : {&b.cube, &b.prism, &b.pyramid})
    text += std::to_string(cell->corners.size()) + " " + row(cell->corners) + "\n";
  return text +
         "CELL_TYPES 6\n9 9 9 12 13 14\nCELL_DATA 6\nSCALARS region int 1\nLOOKUP_TABLE default\n0 0 0 3 4 "
         "4\n";
}

std::string inp(const Block& b) {
  std::string text = "*NODE\n";
  for (std::size_t i = 0; i < b.points.size(); ++i)
    text += std::to_string(i + 1) + ", " + row(b.points[i], ", ") + "\n";
  const auto element = [&](const char* type, int number, const char* set, const auto& corners) {
    text += std::string("*ELEMENT, TYPE=") + type + ", ELSET=" + set + "\n" + std::to_string(number) + ", " +
            row(corners, ", ", 1) + "\n";
  };
  for (int k = 0; k < 3; ++k) element("S4", k + 1, "SKIN", b.quadrangles[static_cast<std::size_t>(k)]);
  element("C3D8R", 4, "CUBE", b.cube.corners);
  element("C3D6", 5, "REST", b.prism.corners);
  element("C3D5", 6, "REST", b.pyramid.corners);
  return text;
}

std::string bdf(const Block& b) {
  std::string text = "BEGIN BULK\n";
  for (std::size_t i = 0; i < b.points.size(); ++i)
    text += "GRID," + std::to_string(i + 1) + ",," + row(b.points[i], ".,") + ".\n";
  for (std::size_t k = 0; k < 3; ++k)
    text += "CQUAD4," + std::to_string(k + 1) + ",7," + row(b.quadrangles[k], ",", 1) + "\n";
  const std::vector<int>& c = b.cube.corners;
  text += "CHEXA,4,3," + row(std::vector<int>(c.begin(), c.begin() + 6), ",", 1) + "\n," +
          row(std::vector<int>(c.begin() + 6, c.end()), ",", 1) + "\n";
  text += "CPENTA,5,4," + row(b.prism.corners, ",", 1) + "\n";
  return text + "CPYRAM,6,4," + row(b.pyramid.corners, ",", 1) + "\nENDDATA\n";
}

std::string su2(const Block& b) {
  std::string text = "NDIME= 3\nNELEM= 3\n12 " + row(b.cube.corners) + " 0\n13 " + row(b.prism.corners) +
                     " 1\n14 " + row(b.pyramid.corners) + " 2\nNPOIN= 11\n" + rows(b.points) +
                     "NMARK= 1\nMARKER_TAG= skin\nMARKER_ELEMS= 3\n";
  for (const auto& q : b.quadrangles) text += "9 " + row(q) + "\n";
  return text;
}

std::string avs(const Block& b) {
  std::string text = "11 6 0 0 0\n";
  for (std::size_t i = 0; i < b.points.size(); ++i)
    text += std::to_string(i + 1) + " " + row(b.points[i]) + "\n";
  for (std::size_t k = 0; k < 3; ++k)
    text += std::to_string(k + 1) + " 7 quad " + row(b.quadrangles[k], " ", 1) + "\n";
  std::vector<int> pyramid = b.pyramid.corners;
  std::rotate(pyramid.begin(), pyramid.end() - 1, pyramid.end());
  return text + "4 3 hex " + row(b.cube.corners, " ", 1) + "\n5 4 prism " + row(b.prism.corners, " ", 1) +
         "\n6 4 pyr " + row(pyramid, " ", 1) + "\n";
}

std::string mfem(const Block& b) {
  std::string text = "MFEM mesh v1.0\ndimension\n3\nelements\n3\n3 5 " + row(b.cube.corners) + "\n4 6 " +
                     row(b.prism.corners) + "\n4 7 " + row(b.pyramid.corners) + "\nboundary\n3\n";
  for (const auto& q : b.quadrangles) text += "7 3 " + row(q) + "\n";
  return text + "vertices\n11\n3\n" + rows(b.points);
}

std::string xdmf(const Block& b) {
  std::string cells;
  for (const auto& q : b.quadrangles) cells += "5 " + row(q) + "\n";
  cells +=
      "9 " + row(b.cube.corners) + "\n8 " + row(b.prism.corners) + "\n7 " + row(b.pyramid.corners) + "\n";
  return "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\"><Domain><Grid Name=\"b\" GridType=\"Uniform\">\n"
         "<Geometry GeometryType=\"XYZ\"><DataItem Dimensions=\"11 3\" NumberType=\"Float\" Precision=\"8\" "
         "Format=\"XML\">\n" +
         rows(b.points) +
         "</DataItem></Geometry>\n<Topology TopologyType=\"Mixed\" NumberOfElements=\"6\"><DataItem "
         "Dimensions=\"37\" NumberType=\"Int\" Format=\"XML\">\n" +
         cells +
         "</DataItem></Topology>\n<Attribute Name=\"region\" AttributeType=\"Scalar\" "
         "Center=\"Cell\"><DataItem "
         "Dimensions=\"6\" NumberType=\"Int\" Format=\"XML\">0 0 0 3 4 4</DataItem></Attribute>\n"
         "</Grid></Domain></Xdmf>\n";
}

double six_volumes(const Volume& volume, const Tetrahedron& t) {
  std::array<Point, 3> e{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) e[i][k] = volume.vertices[t[i + 1]][k] - volume.vertices[t[0]][k];
  return e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) -
         e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
         e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
}

class Cells : public ::testing::Test {
 protected:
  Volume read(const std::string& text, const std::string& name) {
    put(folder_ / name, text);
    remarks_.clear();
    return read_volume(folder_ / name, {}, &remarks_);
  }

  /// All tetrahedra positive, the volume whole, every face once or twice, and the facets among them.
  static void expect_block(const Volume& volume, bool regions) {
    EXPECT_EQ(volume.tetrahedra.size(), 6u + 3 + 2);
    double sum = 0, of_cube = 0;
    std::map<Triangle, int> faces;
    for (std::size_t i = 0; i < volume.tetrahedra.size(); ++i) {
      const Tetrahedron& t = volume.tetrahedra[i];
      const double v = six_volumes(volume, t);
      EXPECT_GT(v, 0);
      sum += v;
      if (volume.regions[i] == volume.regions[0]) of_cube += v;
      for (std::size_t k = 0; k < 4; ++k) {
        Triangle face{t[(k + 1) % 4], t[(k + 2) % 4], t[(k + 3) % 4]};
        std::sort(face.begin(), face.end());
        ++faces[face];
      }
    }
    EXPECT_EQ(sum, 6 * 8 + 6 * 4 + 16);
    if (regions) {
      EXPECT_EQ(of_cube, 48);
    }
    // The cube has 4 quadrangles outside, the prism 2 and 2 triangles, the pyramid 4 triangles.
    EXPECT_EQ(std::count_if(faces.begin(), faces.end(), [](const auto& f) { return f.second == 1; }), 18);
    for (const auto& [face, count] : faces) EXPECT_LE(count, 2);
    EXPECT_EQ(volume.facets.size(), 6u);
    for (Triangle facet : volume.facets) {
      std::sort(facet.begin(), facet.end());
      EXPECT_EQ(faces[facet], 1);
    }
  }

  const TemporaryFolder folder_;
  std::vector<Remark> remarks_;
};

TEST_F(Cells, OfEveryFormatFitTogether) {
  std::mt19937_64 random(1);
  for (int k = 0; k < 50; ++k) {
    Block block;
    if (k > 0) block.shuffle(random);
    const struct {
      const char* name;
      std::string text;
      bool regions;
    } files[] = {
        {"a.mesh", medit(block), true}, {"a.msh", msh(block), true},   {"a.vtk", vtk(block), true},
        {"a.inp", inp(block), true},    {"a.bdf", bdf(block), true},   {"a.su2", su2(block), false},
        {"a.avs", avs(block), true},    {"a.mfem", mfem(block), true}, {"a.xdmf", xdmf(block), true}};
    for (const auto& file : files) {
      SCOPED_TRACE(std::string(file.name) + " " + std::to_string(k));
      expect_block(read(file.text, file.name), file.regions);
      const auto told = std::find_if(remarks_.begin(), remarks_.end(),
                                     [](const Remark& r) { return r.kind == RemarkKind::cells_split; });
      ASSERT_NE(told, remarks_.end());
      EXPECT_EQ(told->count, 3u);
      EXPECT_EQ(told->message, "1 hexahedron, 1 prism and 1 pyramid are split into tetrahedra");
    }
  }
}

/// Without the quadrangles, which surfaces of an .inp define instead.
std::string inp_of_sides(const Block& b, const std::string& sides) {
  std::string text = inp(b);
  const std::size_t skin = text.find("*ELEMENT"), cells = text.find("*ELEMENT, TYPE=C3D8R");
  return text.erase(skin, cells - skin) + "*SURFACE, NAME=SKIN\n" + sides;
}

TEST_F(Cells, SidesOfThemInSurfacesOfInpAreFacets) {
  std::mt19937_64 random(1);
  for (int k = 0; k < 20; ++k) {
    SCOPED_TRACE(k);
    Block block;
    if (k > 0) block.shuffle(random);
    expect_block(read(inp_of_sides(block, "4, S1\n4, S3\n5, S3\n"), "a.inp"), true);
  }
  const Volume block = read(inp_of_sides(Block(), "CUBE, S1\n6, S2\n"), "a.inp");
  EXPECT_EQ(block.facets, (std::vector<Triangle>{{0, 3, 2}, {0, 2, 1}, {4, 5, 10}}));
  EXPECT_EQ(block.facet_markers, (std::vector<int>{1, 1, 1}));
  // The side of a hexahedron that is a prism is missing, or a triangle.
  Block prism;
  prism.cube = {{1, 8, 8, 5, 2, 9, 9, 6}, 3};
  EXPECT_EQ(read(inp_of_sides(prism, "4, S1\n4, S4\n"), "a.inp").facets, (std::vector<Triangle>{{1, 5, 8}}));
}

TEST_F(Cells, SidesThatAreNotThereAreTold) {
  const auto error = [&](const std::string& sides) {
    try {
      static_cast<void>(read(inp_of_sides(Block(), sides), "a.inp"));
    } catch (const FileError& e) {
      return std::string(e.what()).substr((folder_ / "a.inp").string().size() + 2);
    }
    return std::string("read");
  };
  EXPECT_EQ(error("4, S7\n"), "line 20: expected a side S1 to S6 of a hexahedron, found 'S7'");
  EXPECT_EQ(error("5, S6\n"), "line 20: expected a side S1 to S5 of a prism, found 'S6'");
  EXPECT_EQ(error("6, S0\n"), "line 20: expected a side S1 to S5 of a pyramid, found 'S0'");
  EXPECT_EQ(error("4\n"), "line 20: expected a side S1 to S6 of a hexahedron, found ''");
}

TEST_F(Cells, SidesOfBeamsAreLeftOut) {
  const Volume volume = read(inp_of_sides(Block(), "4, S1\n7, S3\n*ELEMENT, TYPE=B31\n7, 1, 2\n"), "a.inp");
  EXPECT_EQ(volume.facets.size(), 2u);
  EXPECT_TRUE(std::any_of(remarks_.begin(), remarks_.end(), [](const Remark& r) {
    return r.message == "1 side of an element that is a line or has no shape is left out";
  }));
}

TEST_F(Cells, TheirSurfaceIsMeshed) {
  const Surface surface = surface_of(read(msh(Block()), "a.msh"));
  EXPECT_EQ(surface.facets.size(), 18u + 4);  // two quadrangles lie between the regions
  EXPECT_EQ(mesh(surface, {}).outcome, Outcome::done);
}

TEST_F(Cells, ReadAsASurfaceAreLeftOut) {
  put(folder_ / "a.msh", msh(Block()));
  const Surface surface = read_surface(folder_ / "a.msh");
  EXPECT_EQ(surface.facets.size(), 6u);
  EXPECT_EQ(surface.remarks.back().message, "1 hexahedron, 1 prism and 1 pyramid are left out");
}

/// A prism written as a hexahedron, as programs without prisms do.
TEST_F(Cells, CornersMayBeThereTwice) {
  Block block;
  block.cube = {{1, 8, 8, 5, 2, 9, 9, 6}, 3};
  std::string text = vtk(block);
  text.replace(text.find("CELLS 6 37"), 10, "CELLS 1 9");
  text.erase(text.find("4 0 3 2 1"), text.find("8 1 8 8 5") - text.find("4 0 3 2 1"));
  text.erase(text.find("6 1 8 5 2"));
  const Volume volume = read(text + "CELL_TYPES 1\n12\n", "a.vtk");
  ASSERT_EQ(volume.tetrahedra.size(), 3u);
  double sum = 0;
  for (const Tetrahedron& t : volume.tetrahedra) sum += six_volumes(volume, t);
  EXPECT_EQ(sum, 24);
}

TEST_F(Cells, OfSecondOrderLoseTheirNodesOnEdges) {
  std::string text = "*NODE\n";
  int number = 0;
  const auto node = [&](double x, double y, double z) {
    text += std::to_string(++number) + ", " + row(Point{x, y, z}, ", ") + "\n";
  };
  for (const int z : {0, 2})
    for (const auto& [x, y] : {std::pair{0, 0}, std::pair{2, 0}, std::pair{2, 2}, std::pair{0, 2}})
      node(x, y, z);
  for (const int z : {0, 2})
    for (const auto& [x, y] : {std::pair{1, 0}, std::pair{2, 1}, std::pair{1, 2}, std::pair{0, 1}})
      node(x, y, z);
  for (const auto& [x, y] : {std::pair{0, 0}, std::pair{2, 0}, std::pair{2, 2}, std::pair{0, 2}})
    node(x, y, 1);
  text +=
      "*ELEMENT, TYPE=C3D20R, ELSET=A\n1, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10,\n11, 12, 13, 14, 15, 16, 17, 18, "
      "19, 20\n";
  const Volume volume = read(text, "a.inp");
  EXPECT_EQ(volume.vertices.size(), 8u);
  EXPECT_EQ(volume.tetrahedra.size(), 6u);
}

/// Rings with the nodes on edges between the corners.
TEST_F(Cells, OfUnvAreReadByTheirRings) {
  std::string text = "    -1\n  2411\n";
  const std::vector<std::pair<int, int>> ring{{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}};
  int number = 0;
  const auto node = [&](int x, int y, int z) {
    text += std::to_string(++number) + " 1 1 1\n" + row(Point{double(x), double(y), double(z)}) + "\n";
  };
  for (const auto& [x, y] : ring) node(x, y, 0);
  for (std::size_t k = 0; k < 8; k += 2) node(ring[k].first, ring[k].second, 1);
  for (const auto& [x, y] : ring) node(x, y, 2);
  text +=
      "    -1\n    -1\n  2412\n1 116 1 1 7 20\n1 2 3 4 5 6 7 8\n9 10 11 12 13 14 15 16\n17 18 19 20\n    "
      "-1\n";
  const Volume volume = read(text, "a.unv");
  EXPECT_EQ(volume.vertices.size(), 8u);
  double sum = 0;
  for (const Tetrahedron& t : volume.tetrahedra) sum += six_volumes(volume, t);
  EXPECT_EQ(sum, 48);
}

}  // namespace
}  // namespace holdfast::io_cells_test
