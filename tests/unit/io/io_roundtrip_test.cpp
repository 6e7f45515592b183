// Every format returns what was written: coordinates bit for bit, markers, regions, orientation.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "holdfast/surface_io.h"
#include "io_samples.h"

namespace holdfast::io_roundtrip_test {
namespace {

using namespace samples;

struct Case {
  const char* name;
  WriteOptions options = {};
};

void PrintTo(const Case& c, std::ostream* out) {
  *out << c.name << (c.options.compress ? "" : " raw") << (c.options.legacy_msh ? " 2.2" : "");
}

class RoundTrip : public ::testing::TestWithParam<Case> {
 protected:
  Volume again(const Volume& volume) {
    const std::filesystem::path path = folder_ / GetParam().name;
    write_volume(path, volume, GetParam().options);
    return read_volume(path);
  }
  TemporaryFolder folder_;
};

/// Entities with their tags; .msh 4.1 groups them by tag, so their order is not compared.
template <std::size_t N>
std::vector<std::pair<std::array<Index, N>, int>> tagged(const std::vector<std::array<Index, N>>& entities,
                                                         const std::vector<int>& tags) {
  std::vector<std::pair<std::array<Index, N>, int>> result;
  for (std::size_t i = 0; i < entities.size(); ++i)
    result.emplace_back(entities[i], tags.empty() ? 0 : tags[i]);
  std::sort(result.begin(), result.end());
  return result;
}

void expect_same(const Volume& a, const Volume& b) {
  EXPECT_EQ(bits(a.vertices), bits(b.vertices));
  EXPECT_EQ(tagged(a.tetrahedra, a.regions), tagged(b.tetrahedra, b.regions));
  EXPECT_EQ(tagged(a.facets, a.facet_markers), tagged(b.facets, b.facet_markers));
  EXPECT_EQ(tagged(a.segments, a.segment_markers), tagged(b.segments, b.segment_markers));
  EXPECT_EQ(a.vertex_markers, b.vertex_markers);
}

TEST_P(RoundTrip, KeepsEverything) {
  const Volume volume = sample_volume();
  expect_same(volume, again(volume));
}

TEST_P(RoundTrip, NoMarkersStayNoMarkers) {
  Volume volume = sample_volume();
  volume.facet_markers.clear();
  volume.segment_markers.clear();
  volume.regions.assign(volume.regions.size(), 0);
  const Volume result = again(volume);
  expect_same(volume, result);
  EXPECT_TRUE(result.facet_markers.empty());
  EXPECT_TRUE(result.segment_markers.empty());
  EXPECT_EQ(result.regions, volume.regions);
}

TEST_P(RoundTrip, VerticesAlone) {
  Volume volume;
  volume.vertices = awkward_points();
  expect_same(volume, again(volume));
}

TEST_P(RoundTrip, Empty) { expect_same(Volume{}, again(Volume{})); }

TEST_P(RoundTrip, ManyRandomDoubles) {
  std::mt19937_64 random(7);
  Volume volume;
  while (volume.vertices.size() < 40000) {
    Point point{};
    for (double& x : point) {
      do x = std::bit_cast<double>(random());
      while (!std::isfinite(x));
    }
    volume.vertices.push_back(point);
  }
  std::uniform_int_distribution<Index> vertex(0, 39999);
  std::uniform_int_distribution<int> tag(-2, 3);
  for (int i = 0; i < 50000; ++i) {
    volume.tetrahedra.push_back({vertex(random), vertex(random), vertex(random), vertex(random)});
    volume.regions.push_back(tag(random));
    volume.facets.push_back({vertex(random), vertex(random), vertex(random)});
    volume.facet_markers.push_back(tag(random));
  }
  expect_same(volume, again(volume));
}

INSTANTIATE_TEST_SUITE_P(Formats, RoundTrip,
                         ::testing::Values(Case{"a.vtu"}, Case{"a.vtu", uncompressed()}, Case{"a.vtk"},
                                           Case{"a.mesh"}, Case{"a.meshb"}, Case{"a.msh"},
                                           Case{"a.msh", legacy_msh()}, Case{"a.node"}, Case{"a.ele"},
                                           Case{"A.VTU"}));

TEST(RoundTrip, FormatOverridesTheExtension) {
  const TemporaryFolder folder;
  write_volume(folder / "mesh.out", sample_volume(), as_format("mesh"));
  EXPECT_EQ(read_volume(folder / "mesh.out", ".mesh").tetrahedra, sample_volume().tetrahedra);
  EXPECT_THROW(read_volume(folder / "mesh.out"), FileError);
}

TEST(RoundTrip, AVolumeIsASurfaceToo) {
  const TemporaryFolder folder;
  const Volume volume = sample_volume();
  for (const char* name : {"a.vtu", "a.vtk", "a.mesh", "a.meshb", "a.msh"}) {
    write_volume(folder / name, volume);
    const Surface surface = read_surface(folder / name);
    EXPECT_EQ(bits(surface.vertices), bits(volume.vertices)) << name;
    EXPECT_EQ(tagged(surface.facets, surface.facet_markers), tagged(volume.facets, volume.facet_markers))
        << name;
    EXPECT_EQ(tagged(surface.segments, surface.segment_markers),
              tagged(volume.segments, volume.segment_markers));
  }
}

TEST(RoundTrip, SurfaceInNode) {
  const TemporaryFolder folder;
  Volume written = sample_volume();
  written.tetrahedra.clear();
  written.regions.clear();
  write_volume(folder / "a.node", written);
  const Surface read = read_surface(folder / "a.node");
  EXPECT_EQ(read.vertices, written.vertices);
  EXPECT_EQ(read.facets, written.facets);
  EXPECT_EQ(read.facet_markers, written.facet_markers);
  EXPECT_EQ(read.segments, written.segments);
  write_volume(folder / "b.node", sample_volume());
  EXPECT_TRUE(read_surface(folder / "b.node").facets.empty());
}

TEST(RoundTrip, MismatchedTagsAreTheCallersMistake) {
  const TemporaryFolder folder;
  Volume volume = sample_volume();
  volume.regions.pop_back();
  EXPECT_THROW(write_volume(folder / "a.vtu", volume), std::invalid_argument);
  EXPECT_TRUE(folder.names().empty());
}

TEST(RoundTrip, IndicesWithoutAVertexAreTheCallersMistake) {
  const TemporaryFolder folder;
  const Index none = Index(1) << 28;
  for (const auto spoil : {+[](Volume&v, Index i) { v.tetrahedra.back()[3] = i; },
                           +[](Volume&v, Index i) { v.facets.back()[0] = i; },
                           +[](Volume&v, Index i) { v.segments.back()[1] = i; }}) {
    Volume volume = sample_volume();
    spoil(volume, none);
    EXPECT_THROW(static_cast<void>(surface_of(volume)), std::invalid_argument);
    for (const char* name : {"a.vtu", "a.msh", "a.inp", "a.med", "a.exo", "a.cgns", "a.fluent", "a.k",
                             "a.cdb", "a.feb", "a.xml"})
      EXPECT_THROW(write_volume(folder / name, volume), std::invalid_argument) << name;
  }
  Surface surface = surface_of(sample_volume());
  surface.facets[0][1] = none;
  for (const char* name : {"a.stl", "a.off", "a.vtu"})
    EXPECT_THROW(write_surface(folder / name, surface), std::invalid_argument) << name;
  EXPECT_TRUE(folder.names().empty());
}

}  // namespace
}  // namespace holdfast::io_roundtrip_test
