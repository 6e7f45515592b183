// Exodus II, and the netCDF in which it is.
#include <gtest/gtest.h>

#include <functional>

#include "io/atomic_writer.h"
#include "io/byte_reader.h"
#include "io/netcdf_write.h"
#include "io_volumes.h"

namespace holdfast::io_exodus_test {
namespace {

using namespace samples;
using io::NetcdfKind;
using io::NetcdfValues;

/// A file with arrays of integers, of reals, and of texts.
class Exodus {
 public:
  Exodus() { content_.dimensions = {{"len_name", 33}}; }

  Exodus& nodes(std::vector<Point> points) {
    dimension("num_nodes", points.size());
    dimension("num_dim", 3);
    content_.arrays.push_back(
        {"coord", NetcdfKind::real, {"num_dim", "num_nodes"}, {}, [points](NetcdfValues& out) {
           for (std::size_t k = 0; k < 3; ++k)
             for (const Point& p : points) out.add(p[k]);
         }});
    return *this;
  }
  Exodus& block(const std::string& type, const std::vector<std::vector<int>>& elements) {
    const std::string i = std::to_string(++blocks_);
    dimension("count" + i, elements.size());
    dimension("each" + i, elements.front().size());
    content_.arrays.push_back({"connect" + i,
                               NetcdfKind::integer,
                               {"count" + i, "each" + i},
                               {{"elem_type", type}},
                               [elements](NetcdfValues& out) {
                                 for (const auto& nodes : elements)
                                   for (const int node : nodes) out.add(node);
                               }});
    return *this;
  }
  Exodus& integers(const std::string& name, const std::vector<int>& values) {
    dimension("of_" + name, values.size());
    content_.arrays.push_back({name, NetcdfKind::integer, {"of_" + name}, {}, [values](NetcdfValues& out) {
                                 for (const int value : values) out.add(value);
                               }});
    return *this;
  }
  Exodus& texts(const std::string& name, const std::vector<std::string>& rows) {
    dimension("of_" + name, rows.size());
    content_.arrays.push_back(
        {name, NetcdfKind::text, {"of_" + name, "len_name"}, {}, [rows](NetcdfValues& out) {
           for (const std::string& row : rows) out.add(row, 33);
         }});
    return *this;
  }
  [[nodiscard]] std::string bytes() const {
    const TemporaryFolder folder;
    {
      io::AtomicWriter out(folder / "a.exo");
      content_.write(out);
      out.commit();
    }
    return get(folder / "a.exo");
  }

 private:
  void dimension(const std::string& name, std::uint64_t extent) {
    content_.dimensions.emplace_back(name, extent);
  }
  io::NetcdfContent content_;
  int blocks_ = 0;
};

const std::vector<Point> kCube{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                               {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
const std::vector<Point> kTetrahedron{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

Exodus tetrahedron() { return Exodus().nodes(kTetrahedron).block("TETRA", {{1, 2, 3, 4}}); }

/// The markers of the facets, ascending, with the mean of the corners of each.
std::vector<std::pair<int, Point>> sides(const Volume& volume) {
  std::vector<std::pair<int, Point>> result;
  for (std::size_t f = 0; f < volume.facets.size(); ++f) {
    Point mean{0, 0, 0};
    for (const Index v : volume.facets[f])
      for (std::size_t k = 0; k < 3; ++k) mean[k] += volume.vertices[v][k];
    result.emplace_back(volume.facet_markers[f], mean);
  }
  return result;
}

TEST(ExodusFile, SidesOfATetrahedron) {
  const Volume read = volume(tetrahedron()
                                 .integers("ss_prop1", {1, 2, 3, 4})
                                 .integers("elem_ss1", {1})
                                 .integers("side_ss1", {1})
                                 .integers("elem_ss2", {1})
                                 .integers("side_ss2", {2})
                                 .integers("elem_ss3", {1})
                                 .integers("side_ss3", {3})
                                 .integers("elem_ss4", {1})
                                 .integers("side_ss4", {4})
                                 .bytes(),
                             "a.exo");
  // The sides opposite the corners 3, 1, 2 and 4, all outwards.
  ASSERT_EQ(read.facets.size(), 4U);
  EXPECT_EQ(sides(read), (std::vector<std::pair<int, Point>>{
                             {1, {1, 0, 1}}, {2, {1, 1, 1}}, {3, {0, 1, 1}}, {4, {1, 1, 0}}}));
}

TEST(ExodusFile, SidesOfOtherCellsCoverThem) {
  struct Case {
    const char* type;
    std::vector<int> nodes;
    std::vector<std::vector<double>> of_side;  ///< the coordinate that is constant on it, and its value
  };
  const std::vector<std::vector<double>> of_hex{{1, 0}, {0, 1}, {1, 1}, {0, 0}, {2, 0}, {2, 1}};
  std::vector<int> elements(6, 1), numbers{1, 2, 3, 4, 5, 6};
  Exodus file;
  file.nodes(kCube).block("HEX8", {{1, 2, 3, 4, 5, 6, 7, 8}}).integers("ss_prop1", numbers);
  for (int side = 1; side <= 6; ++side)
    file.integers("elem_ss" + std::to_string(side), {1}).integers("side_ss" + std::to_string(side), {side});
  const Volume read = volume(file.bytes(), "a.exo");
  EXPECT_EQ(read.facets.size(), 12U);
  for (std::size_t f = 0; f < read.facets.size(); ++f) {
    const auto& of = of_hex[static_cast<std::size_t>(read.facet_markers[f] - 1)];
    for (const Index v : read.facets[f])
      EXPECT_EQ(read.vertices[v][static_cast<std::size_t>(of[0])], of[1]) << read.facet_markers[f];
  }
}

/// The nodes of a side of a prism and a pyramid, from 1.
TEST(ExodusFile, SidesOfPrismsAndPyramids) {
  const std::vector<Point> places{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1},    {0, 1, 1},
                                  {5, 0, 0}, {6, 0, 0}, {6, 1, 0}, {5, 1, 0}, {5.5, 0.5, 1}};
  const std::vector<std::vector<Index>> prism{{0, 1, 3, 4}, {1, 2, 4, 5}, {0, 2, 3, 5}, {0, 1, 2}, {3, 4, 5}};
  const std::vector<std::vector<Index>> pyramid{{6, 7, 10}, {7, 8, 10}, {8, 9, 10}, {6, 9, 10}, {6, 7, 8, 9}};
  for (int side = 1; side <= 5; ++side) {
    const Volume read = volume(Exodus()
                                   .nodes(places)
                                   .block("WEDGE", {{1, 2, 3, 4, 5, 6}})
                                   .block("PYRAMID5", {{7, 8, 9, 10, 11}})
                                   .integers("ss_prop1", {1, 2})
                                   .integers("elem_ss1", {1})
                                   .integers("side_ss1", {side})
                                   .integers("elem_ss2", {2})
                                   .integers("side_ss2", {side})
                                   .bytes(),
                               "a.exo");
    for (const int marker : {1, 2}) {
      std::vector<Index> corners;
      for (std::size_t f = 0; f < read.facets.size(); ++f)
        if (read.facet_markers[f] == marker)
          corners.insert(corners.end(), read.facets[f].begin(), read.facets[f].end());
      std::sort(corners.begin(), corners.end());
      corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
      EXPECT_EQ(corners, (marker == 1 ? prism : pyramid)[static_cast<std::size_t>(side - 1)]) << side;
    }
  }
}

TEST(ExodusFile, BlocksAndSetsHaveIdsAndNames) {
  const Volume read = volume(Exodus()
                                 .nodes(kTetrahedron)
                                 .block("TETRA4", {{1, 2, 3, 4}})
                                 .block("SHELL3", {{1, 3, 2}})
                                 .block("BAR2", {{1, 4}})
                                 .integers("eb_prop1", {10, 4, 5})
                                 .texts("eb_names", {"core", "lid", "wire"})
                                 .integers("ss_prop1", {4})
                                 .texts("ss_names", {"inlet"})
                                 .integers("elem_ss1", {1})
                                 .integers("side_ss1", {1})
                                 .integers("ns_prop1", {7, 8})
                                 .texts("ns_names", {"all", ""})
                                 .integers("node_ns1", {1, 2, 3, 4})
                                 .integers("node_ns2", {2})
                                 .bytes(),
                             "a.exo");
  EXPECT_EQ(read.regions, (std::vector<int>{10}));
  EXPECT_EQ(read.names.regions, (std::map<int, std::string>{{10, "core"}}));
  // The side set keeps its number; the shell, whose block has the same, gets a free one.
  EXPECT_EQ(read.facet_markers, (std::vector<int>{1, 4}));
  EXPECT_EQ(read.names.facets, (std::map<int, std::string>{{1, "lid"}, {4, "inlet"}}));
  EXPECT_EQ(read.segment_markers, (std::vector<int>{5}));
  EXPECT_EQ(read.vertex_markers, (std::vector<int>{7, 8, 7, 7}));
  EXPECT_EQ(read.names.vertices, (std::map<int, std::string>{{7, "all"}}));
}

TEST(ExodusFile, ASideInSeveralSetsIsOneFacetOfTheSmallest) {
  const Volume read = volume(tetrahedron()
                                 .integers("ss_prop1", {1, 2})
                                 .integers("elem_ss1", {1, 1})
                                 .integers("side_ss1", {1, 2})
                                 .integers("elem_ss2", {1})
                                 .integers("side_ss2", {2})
                                 .bytes(),
                             "a.exo");
  EXPECT_EQ(read.facet_markers, (std::vector<int>{1, 2}));
}

TEST(ExodusFile, FacetsWithoutTetrahedraAndMarkedVerticesReturn) {
  const TemporaryFolder folder;
  Volume volume;
  volume.vertices = kTetrahedron;
  volume.vertices.push_back({0, 0, 9});
  volume.tetrahedra = {{0, 1, 2, 3}};
  volume.regions = {3};
  volume.facets = {{0, 2, 1}, {0, 1, 4}};
  volume.facet_markers = {3, 3};
  volume.vertex_markers = {0, 0, 0, 0, 6};
  volume.names.facets = {{3, "a b"}};
  volume.names.vertices = {{6, "tip"}};
  write_volume(folder / "a.exo", volume);
  const Volume read = read_volume(folder / "a.exo");
  EXPECT_EQ(read.facet_markers, volume.facet_markers);
  EXPECT_EQ(read.names, volume.names);
  EXPECT_EQ(read.vertex_markers, volume.vertex_markers);
  EXPECT_EQ(read.regions, volume.regions);
}

TEST(ExodusFile, ErrorsNameTheArray) {
  EXPECT_EQ(error("CDF\x03", "a.exo"), "byte 4: netCDF of version 3 is not read; 1, 2, 5 and netCDF-4 are");
  EXPECT_EQ(error("something", "a.exo"),
            "byte 0: not a netCDF file: it begins neither with CDF nor as HDF5 does");
  EXPECT_EQ(error(Exodus().integers("a", {1}).bytes(), "a.exo"),
            "coord: the file has no coordinates: it is no Exodus file");
  EXPECT_EQ(error(Exodus().nodes(kTetrahedron).block("TETRA", {{1, 2, 3, 5}}).bytes(), "a.exo"),
            "connect1: names node 5, but there are 4");
  EXPECT_EQ(error(Exodus().nodes(kTetrahedron).block("nfaced", {{1, 2, 3, 4}}).bytes(), "a.exo"),
            "connect1: elements of type 'nfaced' are not read; split them into triangles or tetrahedra");
  EXPECT_EQ(error(tetrahedron().integers("elem_ss1", {2}).integers("side_ss1", {1}).bytes(), "a.exo"),
            "elem_ss1: names element 2, but there are 1");
  EXPECT_EQ(error(tetrahedron().integers("elem_ss1", {1}).integers("side_ss1", {5}).bytes(), "a.exo"),
            "elem_ss1: names side 5 of element 1, which has 4");
  EXPECT_EQ(error(tetrahedron().integers("node_ns1", {0}).bytes(), "a.exo"),
            "node_ns1: names node 0, but there are 4");
}

/// The header of a classic file with one array "coord" of 3 x 2 floats, whose numbers have the width of the
/// version.
std::string small_netcdf(int version) {
  std::string bytes = "CDF";
  bytes += static_cast<char>(version);
  const auto tag = [&](std::uint32_t value) { io::store(bytes, value, std::endian::big); };
  const auto count = [&](std::uint64_t value) {
    if (version == 5) return io::store(bytes, value, std::endian::big);
    io::store(bytes, static_cast<std::uint32_t>(value), std::endian::big);
  };
  const auto name = [&](const std::string& text) {
    count(text.size());
    bytes += text;
    bytes.resize((bytes.size() + 3) / 4 * 4, '\0');
  };
  count(0);
  tag(10);
  count(2);
  name("num_dim");
  count(3);
  name("num_nodes");
  count(2);
  tag(0);
  count(0);
  tag(11);
  count(1);
  name("coord");
  count(2);
  count(0);
  count(1);
  tag(0);
  count(0);
  tag(5);
  count(24);
  const std::size_t begin = bytes.size() + (version == 1 ? 4 : 8);
  if (version == 1)
    tag(static_cast<std::uint32_t>(begin));
  else
    io::store(bytes, std::uint64_t{begin}, std::endian::big);
  for (const float x : {1.F, 2.F, 3.F, 4.F, 5.F, 6.F}) io::store(bytes, x, std::endian::big);
  return bytes;
}

TEST(Netcdf, EveryVersionOfTheClassicFormat) {
  for (const int version : {1, 2, 5})
    EXPECT_EQ(volume(small_netcdf(version), "a.exo").vertices, (std::vector<Point>{{1, 3, 5}, {2, 4, 6}}))
        << version;
}

TEST(Netcdf, TruncatedAnywhere) {
  const std::string whole = small_netcdf(5);
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_NE(error(whole.substr(0, size), "a.exo"), "read") << size;
}

}  // namespace
}  // namespace holdfast::io_exodus_test
