// CGNS in HDF5.
#include <gtest/gtest.h>

#include <list>

#include "io/hdf5_write.h"
#include "io_volumes.h"

namespace holdfast::io_cgns_test {
namespace {

using namespace samples;
using io::Hdf5Array;
using io::Hdf5Group;
using io::Hdf5Type;

/// The nodes of a file; their values live as long as this.
class Cgns {
 public:
  static Hdf5Group node(const std::string& name, const std::string& label) {
    return {name, {{"name", name}, {"label", label}, {"type", std::string("MT")}, {"flags", 1}}};
  }
  Hdf5Group numbers(const std::string& name, const std::string& label, std::vector<std::int64_t> values) {
    Hdf5Group group = node(name, label);
    numbers_.push_back(std::move(values));
    group.arrays.push_back({" data", Hdf5Type::int64, numbers_.back().size(), 1, numbers_.back().data()});
    return group;
  }
  Hdf5Group text(const std::string& name, const std::string& label, const std::string& value) {
    Hdf5Group group = node(name, label);
    texts_.push_back(value);
    group.arrays.push_back({" data", Hdf5Type::int8, value.size(), 1, texts_.back().data()});
    return group;
  }
  Hdf5Group section(const std::string& name, int type, std::vector<std::int64_t> range,
                    std::vector<std::int64_t> nodes) {
    Hdf5Group group = numbers(name, "Elements_t", {type, 0});
    group.groups = {numbers("ElementRange", "IndexRange_t", std::move(range)),
                    numbers("ElementConnectivity", "DataArray_t", std::move(nodes))};
    return group;
  }
  Hdf5Group condition(const std::string& name, const std::string& list, std::vector<std::int64_t> numbers_of,
                      const std::string& location = "FaceCenter") {
    Hdf5Group group = text(name, "BC_t", "Null");
    group.groups.push_back(numbers(list, "IndexArray_t", std::move(numbers_of)));
    if (!location.empty()) group.groups.push_back(text("GridLocation", "GridLocation_t", location));
    return group;
  }
  Hdf5Group zone(const std::string& name, const std::vector<Point>& points, std::vector<Hdf5Group> sections,
                 std::vector<Hdf5Group> conditions = {}, const std::string& kind = "Unstructured") {
    Hdf5Group group = numbers(name, "Zone_t", {static_cast<std::int64_t>(points.size()), 1, 0});
    group.groups.push_back(text("ZoneType", "ZoneType_t", kind));
    Hdf5Group grid = node("GridCoordinates", "GridCoordinates_t");
    constexpr const char* kNames[] = {"CoordinateX", "CoordinateY", "CoordinateZ"};
    for (std::size_t k = 0; k < 3; ++k) {
      std::vector<double>& x = reals_.emplace_back();
      for (const Point& p : points) x.push_back(p[k]);
      Hdf5Group array = node(kNames[k], "DataArray_t");
      array.arrays.push_back({" data", Hdf5Type::float64, x.size(), 1, x.data()});
      grid.groups.push_back(std::move(array));
    }
    group.groups.push_back(std::move(grid));
    for (Hdf5Group& section : sections) group.groups.push_back(std::move(section));
    Hdf5Group all = node("ZoneBC", "ZoneBC_t");
    all.groups = std::move(conditions);
    group.groups.push_back(std::move(all));
    return group;
  }
  static std::string bytes(std::vector<Hdf5Group> zones) {
    Hdf5Group base = node("Base", "CGNSBase_t");
    base.groups = std::move(zones);
    const TemporaryFolder folder;
    io::AtomicWriter out(folder / "a.cgns");
    write_hdf5(out, {"", {}, {}, {base}});
    out.commit();
    return get(folder / "a.cgns");
  }

 private:
  std::list<std::string> texts_;
  std::list<std::vector<std::int64_t>> numbers_;
  std::list<std::vector<double>> reals_;
};

const std::vector<Point> kCube{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                               {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
const std::vector<Point> kTetrahedron{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

TEST(CgnsFile, SectionsAndBoundaryConditionsNameFaces) {
  Cgns file;
  const Volume read =
      volume(Cgns::bytes({file.zone("Zone", kTetrahedron,
                                    {file.section("body", 10, {4, 4}, {1, 2, 3, 4}),
                                     file.section("faces", 5, {1, 3}, {1, 3, 2, 1, 2, 4, 2, 3, 4}),
                                     file.section("wire", 3, {5, 5}, {1, 4})},
                                    {file.condition("inlet", "PointRange", {2, 2}),
                                     file.condition("outlet", "ElementList", {3}, "")})}),
             "a.cgns");
  EXPECT_EQ(read.tetrahedra, (std::vector<Tetrahedron>{{0, 1, 2, 3}}));
  EXPECT_EQ(read.facets, (std::vector<Triangle>{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}}));
  EXPECT_EQ(read.facet_markers, (std::vector<int>{1, 2, 3}));
  EXPECT_EQ(read.names.facets, (std::map<int, std::string>{{1, "faces"}, {2, "inlet"}, {3, "outlet"}}));
  EXPECT_EQ(read.names.regions, (std::map<int, std::string>{{1, "body"}}));
  EXPECT_EQ(read.names.segments, (std::map<int, std::string>{{1, "wire"}}));
}

TEST(CgnsFile, MixedElementsAndQuadrangles) {
  Cgns file;
  const Volume read = volume(
      Cgns::bytes({file.zone("Zone", kCube,
                             {file.section("all", 20, {1, 2}, {17, 1, 2, 3, 4, 5, 6, 7, 8, 7, 1, 4, 3, 2})},
                             {file.condition("floor", "PointList", {2})})}),
      "a.cgns");
  double sum = 0;
  for (const Tetrahedron& t : read.tetrahedra) {
    const auto d = [&](std::size_t i, std::size_t k) {
      return read.vertices[t[i]][k] - read.vertices[t[0]][k];
    };
    sum += d(1, 0) * (d(2, 1) * d(3, 2) - d(2, 2) * d(3, 1)) -
           d(1, 1) * (d(2, 0) * d(3, 2) - d(2, 2) * d(3, 0)) +
           d(1, 2) * (d(2, 0) * d(3, 1) - d(2, 1) * d(3, 0));
  }
  EXPECT_DOUBLE_EQ(sum, 6);
  EXPECT_EQ(read.facets.size(), 2U);
  EXPECT_EQ(read.names.facets.at(read.facet_markers[0]), "floor");
}

TEST(CgnsFile, SeveralZonesAreRegionsAndConditionsOnVerticesMarkThem) {
  Cgns file;
  std::vector<Point> moved = kTetrahedron;
  for (Point& p : moved) p[0] += 5;
  const Volume read =
      volume(Cgns::bytes({file.zone("left", kTetrahedron, {file.section("tets", 10, {1, 1}, {1, 2, 3, 4})}),
                          file.zone("right", moved, {file.section("tets", 10, {1, 1}, {1, 2, 3, 4})},
                                    {file.condition("tip", "PointList", {4}, "")})}),
             "a.cgns");
  EXPECT_EQ(read.tetrahedra, (std::vector<Tetrahedron>{{0, 1, 2, 3}, {4, 5, 6, 7}}));
  EXPECT_EQ(read.names.regions, (std::map<int, std::string>{{1, "left"}, {2, "right"}}));
  EXPECT_EQ(read.vertex_markers, (std::vector<int>{0, 0, 0, 0, 0, 0, 0, 1}));
  EXPECT_EQ(read.names.vertices, (std::map<int, std::string>{{1, "tip"}}));
}

TEST(CgnsFile, ErrorsNameTheNode) {
  Cgns file;
  const auto refused = [&](std::vector<Hdf5Group> sections, std::vector<Hdf5Group> conditions = {}) {
    return error(Cgns::bytes({file.zone("Zone", kTetrahedron, std::move(sections), std::move(conditions))}),
                 "a.cgns");
  };
  EXPECT_EQ(error("bytes", "a.cgns"),
            "byte 0: not CGNS in HDF5; `adf2hdf IN OUT` of the CGNS tools converts files of the older kind");
  EXPECT_EQ(error(Cgns::bytes({}), "a.cgns"), "Base: the base has no zones");
  EXPECT_EQ(error(Cgns::bytes({file.zone("Zone", kTetrahedron, {}, {}, "Structured")}), "a.cgns"),
            "Zone: zones of structured grids are not read; save the mesh as unstructured");
  EXPECT_EQ(refused({file.section("a", 10, {1, 1}, {1, 2, 3, 5})}), "a: names vertex 5, but there are 4");
  EXPECT_EQ(refused({file.section("a", 10, {1, 1}, {1, 2, 3})}), "a: the last element is not whole");
  EXPECT_EQ(refused({file.section("a", 10, {1, 2}, {1, 2, 3, 4})}),
            "a: has 1 elements, and a range of another number");
  EXPECT_EQ(
      refused({file.section("a", 23, {1, 1}, {1, 2, 3, 4})}),
      "a: elements of type 23 (polyhedra, or of higher order) are not read; split them into tetrahedra");
  EXPECT_EQ(refused({file.section("a", 10, {1, 1}, {1, 2, 3, 4})}, {file.condition("b", "PointList", {2})}),
            "b: names element 2, which is in no section");
  EXPECT_EQ(refused({file.section("a", 10, {1, 1}, {1, 2, 3, 4})},
                    {file.condition("b", "PointRange", {1, 1000000000})}),
            "b: its range is longer than the zone has elements");
}

TEST(CgnsFile, ARegionAndAMarkerOfOneName) {
  const TemporaryFolder folder;
  Volume original;
  original.vertices = kTetrahedron;
  original.tetrahedra = {{0, 1, 2, 3}};
  original.regions = {4};
  original.facets = {{0, 2, 1}};
  original.facet_markers = {9};
  original.segments = {{0, 1}};
  original.segment_markers = {-2};
  original.names.regions = {{4, "part"}};
  original.names.facets = {{9, "part"}};
  write_volume(folder / "a.cgns", original);
  const Volume read = read_volume(folder / "a.cgns");
  EXPECT_EQ(read.names, original.names);
  EXPECT_EQ(read.regions, original.regions);
  EXPECT_EQ(read.facet_markers, original.facet_markers);
  EXPECT_EQ(read.segment_markers, original.segment_markers);
}

}  // namespace
}  // namespace holdfast::io_cgns_test
