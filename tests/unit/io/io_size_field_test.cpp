// Size fields with numbers that are not finite, or too large to subtract: refused with their place, or used.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "io_samples.h"

namespace holdfast::io_size_field_test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// One tetrahedron with the sizes 1, 2, 3, 4 at its corners.
SizeField one_tetrahedron(const std::vector<Point>& corners) {
  return {corners, {{0, 1, 2, 3}}, {1, 2, 3, 4}, {}};
}

const std::vector<Point> kUnit{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

TEST(SizeFunction, RefusesNumbersThatAreNotFinite) {
  for (const double x : {kInfinity, -kInfinity, kNan}) {
    SizeField field = one_tetrahedron(kUnit);
    field.vertices[2][1] = x;
    EXPECT_THROW(static_cast<void>(size_function(field)), std::invalid_argument);
    field.metrics.assign(4, Metric{1, 0, 1, 0, 0, 1});
    EXPECT_THROW(static_cast<void>(metric_function(field)), std::invalid_argument);
    field = one_tetrahedron(kUnit);
    field.sizes[3] = x;
    EXPECT_THROW(static_cast<void>(size_function(field)), std::invalid_argument);
    field.metrics.assign(4, Metric{1, 0, 1, 0, x, 1});
    EXPECT_THROW(static_cast<void>(metric_function(field)), std::invalid_argument);
  }
}

TEST(SizeFunction, RefusesAFlatMesh) {
  const SizeField flat{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2, 3}}, {1, 1, 1, 1}, {}};
  EXPECT_THROW(static_cast<void>(size_function(flat)), std::invalid_argument);
}

TEST(SizeFunction, TakesExtentsBeyondTheLargestDouble) {
  const auto size = size_function(one_tetrahedron({{-1e308, 0, 0}, {1e308, 0, 0}, {0, 1e3, 0}, {0, 0, 1e3}}));
  EXPECT_NEAR(size({0, 0, 0}), 1.5, 1e-12);
  EXPECT_NEAR(size({0.5e308, 0, 0}), 1.75, 1e-12);
  EXPECT_NEAR(size({0, 500, 500}), 3.5, 1e-12);
  EXPECT_EQ(size({0, -1, 0}), 0);
}

TEST(SizeFunction, IsTheSameAtEveryScale) {
  const auto unit = size_function(one_tetrahedron(kUnit));
  for (const int x : {-1070, -400, 0, 400, 1023})
    for (const int y : {-1070, 0, 1023}) {
      const auto at = [&](const Point& p) {
        return Point{std::ldexp(p[0], x), std::ldexp(p[1], y), std::ldexp(p[2], -x / 2)};
      };
      std::vector<Point> corners;
      for (const Point& p : kUnit) corners.push_back(at(p));
      const auto size = size_function(one_tetrahedron(corners));
      for (const Point& p :
           {Point{0.25, 0.125, 0.5}, Point{1, 0, 0}, Point{0.75, 0.75, 0}, Point{0, 0, -0.5}})
        EXPECT_EQ(size(at(p)), unit(p)) << x << ' ' << y;
    }
}

TEST(SizeFunction, StaysBetweenThatOfTheCorners) {
  SizeField field = one_tetrahedron(kUnit);
  field.sizes = {1, 1, 1, 1e20};
  const auto size = size_function(field);
  for (const double z : {-1e-10, 0.0, 1e-10}) {
    const double h = size({0.25, 0.25, z});
    EXPECT_GE(h, 1) << z;
    EXPECT_LE(h, 1e20) << z;
  }
}

TEST(SizeFunction, AnswersForPointsThatAreNotFinite) {
  const auto size = size_function(one_tetrahedron(kUnit));
  for (const double x : {kInfinity, -kInfinity, kNan, std::numeric_limits<double>::max()})
    for (std::size_t axis = 0; axis < 3; ++axis) {
      Point p{0.1, 0.1, 0.1};
      p[axis] = x;
      EXPECT_EQ(size(p), 0);
    }
}

class SizeFiles : public ::testing::Test {
 protected:
  /// Writes files; the first is read and must be refused at this place for this reason.
  void expect_refused(const std::vector<std::pair<std::string, std::string>>& files, const std::string& where,
                      const std::string& reason) {
    for (const auto& [name, bytes] : files) samples::put(folder_ / name, bytes);
    try {
      static_cast<void>(read_size_field(folder_ / files[0].first));
      ADD_FAILURE() << files[0].first << " was read";
    } catch (const FileError& error) {
      EXPECT_EQ(error.where(), where) << error.what();
      EXPECT_NE(std::string(error.what()).find(reason), std::string::npos) << error.what();
    }
  }
  samples::TemporaryFolder folder_;
};

std::string mesh(const std::string& x) {
  return "MeshVersionFormatted 2\nDimension 3\nVertices 4\n0 0 0 0\n" + x +
         " 0 0 0\n0 1 0 0\n0 0 1 0\nTetrahedra 1\n1 2 3 4 0\nEnd\n";
}
std::string sol(const std::string& type, const std::string& last) {
  return "MeshVersionFormatted 2\nDimension 3\nSolAtVertices\n4\n1 " + type + "\n" +
         (type == "1" ? "1\n1\n1\n" : "1 0 1 0 0 1\n1 0 1 0 0 1\n1 0 1 0 0 1\n") + last + "\nEnd\n";
}

TEST_F(SizeFiles, OfAMeshAloneAreRefused) {
  expect_refused({{"alone.mesh", mesh("1")}}, "", "neither alone.sol nor alone.solb");
}

TEST_F(SizeFiles, OfAFlatMeshAreRefused) {
  expect_refused({{"a.mesh", mesh("0")}, {"a.sol", sol("1", "1")}}, "", "has no sizes anywhere");
}

TEST_F(SizeFiles, InTextAreRefusedWithTheLine) {
  for (const std::string x : {"inf", "-inf", "nan"}) {
    expect_refused({{"a.mesh", mesh(x)}, {"a.sol", sol("1", "1")}}, "line 5", "a coordinate is not finite");
    expect_refused({{"a.mesh", mesh("1")}, {"a.sol", sol("1", x)}}, "line 9", "a size is not finite");
    expect_refused({{"a.sol", sol("3", "1 0 1 0 " + x + " 1")}}, "line 9",
                   "a number of a tensor is not finite");
    expect_refused({{"b.pos", "View \"m\" {\nSS(0,0,0," + x + ",0,0,0,1,0,0,0,1){1,1,1,1};\n};\n"}}, "line 2",
                   "a coordinate is not finite");
    expect_refused({{"b.pos", "View \"m\" {\nSS(0,0,0,1,0,0,0,1,0,0,0,1)\n{1,1," + x + ",1};\n};\n"}},
                   "line 3", "a size is not finite");
    expect_refused({{"c.mtr", "4 1\n1\n1\n" + x + "\n1\n"}}, "line 4", "a size is not finite");
    expect_refused({{"d.mtr", "4 1\n1\n1\n1\n1\n"},
                    {"d.node", "4 3 0 0\n0 0 0 0\n1 " + x + " 0 0\n2 0 1 0\n3 0 0 1\n"},
                    {"d.ele", "1 4 0\n0 0 1 2 3\n"}},
                   "line 3", "a coordinate is not finite");
  }
  expect_refused({{"c.mtr", "4 1\n1\n1\n0\n1\n"}}, "line 4", "the size is not positive");
  expect_refused({{"c.mtr", "4 1\n1\n1\n1\n1\n\n1 # a fifth\n"}}, "line 7", "more follows");
}

TEST_F(SizeFiles, InBinaryAreRefusedWithTheirPlace) {
  for (const double x : {kInfinity, kNan}) {
    expect_refused({{"a.solb", samples::binary_sol(2, false, 4, 1, {1, 2, x, 4})}, {"a.mesh", mesh("1")}},
                   "byte 56", "not finite");
    Volume volume;
    volume.vertices = kUnit;
    volume.vertices[3][0] = x;
    volume.tetrahedra = {{0, 1, 2, 3}};
    write_volume(folder_ / "e.meshb", volume);
    samples::put(folder_ / "e.sol", sol("1", "1"));
    try {
      static_cast<void>(read_size_field(folder_ / "e.meshb"));
      ADD_FAILURE();
    } catch (const FileError& error) {
      EXPECT_TRUE(error.where().starts_with("byte ")) << error.what();
    }
  }
}

TEST_F(SizeFiles, InVtuAreRefusedWithTheVertex) {
  const auto vtu = [](const std::string& coordinate, const std::string& size) {
    return "<VTKFile type=\"UnstructuredGrid\">\n<UnstructuredGrid>\n"
           "<Piece NumberOfPoints=\"4\" NumberOfCells=\"1\"><PointData>"
           "<DataArray type=\"Float64\" Name=\"size\" format=\"ascii\">1 1 " +
           size +
           " 1</DataArray></PointData><Points>\n"
           "<DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">0 0 0 1 0 0 0 1 0 0 0 " +
           coordinate +
           "</DataArray></Points><Cells>"
           "<DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">0 1 2 3</DataArray>"
           "<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">4</DataArray>"
           "<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">10</DataArray></Cells>"
           "</Piece></UnstructuredGrid></VTKFile>";
  };
  expect_refused({{"f.vtu", vtu("inf", "1")}}, "line 4", "not finite");
  expect_refused({{"f.vtu", vtu("1", "nan")}}, "line 3", "not finite");
  expect_refused({{"f.vtu", vtu("1", "0")}}, "vertex 2", "not a positive number");
}

}  // namespace
}  // namespace holdfast::io_size_field_test
