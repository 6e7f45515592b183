// Names of markers and regions, from a complex to the volume, and of several surfaces together.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "holdfast/holdfast.h"
#include "holdfast/io.h"
#include "small_surfaces.h"

namespace holdfast::names_test {
namespace {

Surface marked_tetrahedron(std::vector<int> markers, std::map<int, std::string> names) {
  Surface surface;
  surface.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  surface.facets = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  surface.facet_markers = std::move(markers);
  surface.names.facets = std::move(names);
  return surface;
}

TEST(Names, AreThoseOfTheVolume) {
  Surface surface = marked_tetrahedron({1, 1, 2, 2}, {{1, "inlet"}, {2, "wall"}});
  surface.names.regions[5] = "core";
  Options options;
  options.regions = {{{0.1, 0.1, 0.1}, 5}};
  const Result result = mesh(surface, options);
  ASSERT_EQ(result.outcome, Outcome::done);
  EXPECT_EQ(result.volume.names, surface.names);
  const Surface again = surface_of(result.volume);
  EXPECT_EQ(again.names.facets, surface.names.facets);
  EXPECT_TRUE(again.names.regions.empty());
}

TEST(Names, NoVolumeHasNone) {
  Surface surface = marked_tetrahedron({1, 1, 2, 2}, {{1, "inlet"}});
  surface.facets.pop_back();
  surface.facet_markers.pop_back();
  const Result result = mesh(surface);
  EXPECT_EQ(result.outcome, Outcome::invalid_input);
  EXPECT_TRUE(result.volume.names.empty());
}

TEST(Names, VertexMarkersStayOnTheSurfaceOfAVolume) {
  Surface surface = marked_tetrahedron({}, {});
  surface.vertices.insert(surface.vertices.begin(), Point{0.2, 0.2, 0.2});
  for (Triangle& t : surface.facets)
    for (Index& v : t) ++v;
  surface.vertex_markers = {7, 1, 2, 3, 4};
  surface.names.vertices = {{4, "tip"}};
  const Result result = mesh(surface);
  ASSERT_EQ(result.outcome, Outcome::done);
  const Surface again = surface_of(result.volume);
  EXPECT_EQ(again.vertex_markers, (std::vector<int>{1, 2, 3, 4}));
  EXPECT_EQ(again.names.vertices, surface.names.vertices);
}

TEST(Join, UnmarkedFilesGetTheNextNumberAndTheirName) {
  const std::vector<Surface> parts{marked_tetrahedron({}, {}), marked_tetrahedron({}, {})};
  const std::vector<std::string> names{"hull", "bolt"};
  const Surface whole = join(parts, names);
  EXPECT_EQ(whole.facet_markers, (std::vector<int>{1, 1, 1, 1, 2, 2, 2, 2}));
  EXPECT_EQ(whole.names.facets, (std::map<int, std::string>{{1, "hull"}, {2, "bolt"}}));
  EXPECT_EQ(whole.facets[4], (Triangle{4, 6, 5}));
  EXPECT_TRUE(whole.remarks.empty());
}

TEST(Join, AMarkerOfAnotherNameGetsAnotherNumber) {
  const std::vector<Surface> parts{marked_tetrahedron({1, 1, 2, 2}, {{1, "inlet"}, {2, "wall"}}),
                                   marked_tetrahedron({1, 1, 2, 3}, {{1, "outlet"}, {2, "wall"}}),
                                   marked_tetrahedron({}, {{0, "lid"}})};
  const Surface whole = join(parts);
  EXPECT_EQ(whole.facet_markers, (std::vector<int>{1, 1, 2, 2, 4, 4, 2, 3, 5, 5, 5, 5}));
  EXPECT_EQ(whole.names.facets,
            (std::map<int, std::string>{{1, "inlet"}, {2, "wall"}, {4, "outlet"}, {5, "lid"}}));
  ASSERT_EQ(whole.remarks.size(), 1u);
  EXPECT_EQ(whole.remarks[0].kind, RemarkKind::renumbered);
}

TEST(Join, MarkersWithoutNamesAreTheSameInAllParts) {
  const std::vector<Surface> parts{marked_tetrahedron({0, 1, 2, 2}, {}),
                                   marked_tetrahedron({0, 0, 2, 1}, {})};
  const Surface whole = join(parts);
  EXPECT_EQ(whole.facet_markers, (std::vector<int>{0, 1, 2, 2, 0, 0, 2, 1}));
  EXPECT_TRUE(whole.names.empty());
}

TEST(Join, TheLargestNumberOfAllHasNoSuccessor) {
  const std::vector<Surface> parts{marked_tetrahedron({2147483647, 1, 1, 1}, {}), marked_tetrahedron({}, {})};
  const Surface whole = join(parts);
  EXPECT_EQ(whole.facet_markers[4], 2);
}

}  // namespace
}  // namespace holdfast::names_test
