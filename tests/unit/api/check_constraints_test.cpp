// check(): lost or changed facets, segments, regions and markers are reported, each by its rule.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "holdfast/check.h"
#include "unit/check_cases.h"

namespace holdfast::check_cases::check_constraints_test {
namespace {

// ---- Input facets and segments

TEST(Facets, SwappedDiagonalIsTold) {
  Case c = grid({1, 1, 1});
  // The bottom is cut from (0, 0) to (1, 1), but the input has the other diagonal.
  const Index a = vertex_at(c.volume, {0, 0, 0}), b = vertex_at(c.volume, {1, 0, 0});
  const Index d = vertex_at(c.volume, {1, 1, 0}), e = vertex_at(c.volume, {0, 1, 0});
  std::erase_if(c.surface.facets, [&](const Triangle& t) {
    return t == sorted({a, b, d}) || t == sorted({a, d, e});
  });
  ASSERT_EQ(c.surface.facets.size(), 10U);
  c.surface.facets.push_back({a, b, e});
  c.surface.facets.push_back({b, d, e});
  EXPECT_EQ(broken(c), (Names{"facets kept", "segments kept", "boundary is input"}));
  EXPECT_TRUE(contains(detail(c, "facets kept"), "2 input facets lost: input facet 10 ("));
  EXPECT_TRUE(contains(detail(c, "segments kept"), "1 input segments or facet sides lost: facet side ("));
}

TEST(Facets, SplitFacetAndSteinerPointOnItAreTold) {
  Case c = one_tetrahedron();  // three times as large, and split at the middle of its face 123
  c.surface.vertices = {{0, 0, 0}, {3, 0, 0}, {0, 3, 0}, {0, 0, 3}};
  c.volume.vertices = c.surface.vertices;
  c.volume.vertices.push_back({1, 1, 1});
  c.volume.tetrahedra = {{0, 1, 2, 4}, {0, 2, 3, 4}, {0, 3, 1, 4}};
  c.volume.regions.assign(3, 1);
  EXPECT_EQ(broken(c), (Names{"facets kept", "boundary is input", "Steiner points inside regions"}));
  EXPECT_TRUE(contains(detail(c, "Steiner points inside regions"), "lies on input facet"));
}

TEST(Facets, SplitSideIsTold) {
  Case c = one_tetrahedron();
  c.volume.vertices.push_back({0.5, 0, 0});
  c.volume.tetrahedra = {{0, 4, 2, 3}, {4, 1, 2, 3}};
  c.volume.regions.assign(2, 1);
  EXPECT_EQ(broken(c),
            (Names{"facets kept", "segments kept", "boundary is input", "Steiner points inside regions"}));
}

TEST(Facets, SteinerPointOnDanglingSegmentIsTold) {
  Case c = with_steiner();
  c.surface.segments.push_back({vertex_at(c.volume, {0, 0, 0}), vertex_at(c.volume, {2, 2, 2})});
  EXPECT_EQ(broken(c), (Names{"segments kept", "Steiner points inside regions"}));
}

TEST(Facets, DroppedRegionIsTold) {
  Case c = grid({3, 1, 1}, [](int x, int, int) { return x + 1; });
  c.volume.tetrahedra.resize(12);
  c.volume.regions.resize(12);
  EXPECT_EQ(broken(c), (Names{"no vertex unused", "nothing dropped"}));
  EXPECT_TRUE(
      contains(detail(c, "nothing dropped"), "10 input facets and segments lie outside all tetrahedra"));
  c.options.outside_dropped = true;
  EXPECT_EQ(broken(c), Names{});
}

TEST(Facets, DanglingOutsideIsDroppedNotLost) {
  Case c = grid({2, 2, 2});
  const auto add = [&](const Point& p) {
    c.volume.vertices.push_back(p);
    c.surface.vertices.push_back(p);
    return static_cast<Index>(c.volume.vertices.size() - 1);
  };
  const Index corner = vertex_at(c.volume, {2, 2, 2}), below = vertex_at(c.volume, {2, 2, 1});
  c.surface.facets.push_back({corner, below, add({3, 3, 2})});
  c.surface.segments.push_back({corner, add({2, 3, 4})});
  EXPECT_EQ(broken(c), (Names{"no vertex unused", "nothing dropped"}));
  c.options.outside_dropped = true;
  EXPECT_EQ(broken(c), Names{});
  EXPECT_EQ(detail(c, "no vertex unused"), "27 vertices used, 2 input vertices outside");
  // Those that extend into the mesh are lost, even with the option.
  c.surface.facets.back() = {corner, below, add({0.5, 0.75, 1.25})};
  c.surface.segments.back() = {vertex_at(c.volume, {0, 0, 0}), add({3, 2.5, 2.75})};
  EXPECT_EQ(broken(c), (Names{"no vertex unused", "facets kept", "segments kept"}));
}

TEST(Facets, OutsideCannotBeToldInABrokenMesh) {
  Case c = grid({2, 1, 1}, [](int x, int, int) { return x + 1; });
  c.volume.tetrahedra.resize(6);
  c.volume.regions.resize(6);
  c.options.outside_dropped = true;
  EXPECT_EQ(broken(c), Names{});
  std::swap(c.volume.tetrahedra[1][0], c.volume.tetrahedra[1][1]);
  EXPECT_TRUE(broken(c).contains("facets kept"));
  EXPECT_TRUE(contains(detail(c, "nothing dropped"), "not examined"));
}

// ---- Regions and markers

TEST(Regions, WrongIdsAreTold) {
  Case c = grid({2, 1, 1}, [](int x, int, int) { return x + 1; });
  c.volume.regions[2] = 2;
  EXPECT_EQ(broken(c), (Names{"regions numbered"}));
  c.volume.regions.pop_back();
  EXPECT_EQ(broken(c), (Names{"regions numbered"}));
  EXPECT_EQ(detail(c, "regions numbered"), "11 region ids for 12 tetrahedra");
}

TEST(Regions, DanglingFacetDoesNotSeparate) {
  Case c = grid({2, 1, 1}, [](int x, int, int) { return x + 1; });
  const auto interface = std::ranges::find_if(c.surface.facets, [&](const Triangle& facet) {
    return std::ranges::all_of(facet, [&](Index v) { return c.surface.vertices[v][0] == 1; });
  });
  ASSERT_NE(interface, c.surface.facets.end());
  c.surface.facets.erase(interface);  // the other half of the interface dangles now
  EXPECT_EQ(broken(c), (Names{"regions numbered"}));
  std::ranges::fill(c.volume.regions, 9);
  EXPECT_EQ(broken(c), Names{});
}

Case marked() {
  Case c = grid({1, 1, 1});
  for (std::size_t i = 0; i < c.surface.facets.size(); ++i)
    c.surface.facet_markers.push_back(10 + static_cast<int>(i / 2));
  c.surface.segments = {{0, 1}, {0, 2}, {1, 0}};  // the first is repeated, with another marker
  c.surface.segment_markers = {5, 6, 7};
  c.volume.facets = c.surface.facets;
  c.volume.facet_markers = c.surface.facet_markers;
  std::swap(c.volume.facets[0], c.volume.facets[7]);  // any order, any rotation
  std::swap(c.volume.facet_markers[0], c.volume.facet_markers[7]);
  std::rotate(c.volume.facets[3].begin(), c.volume.facets[3].begin() + 1, c.volume.facets[3].end());
  c.volume.segments = {{2, 0}, {0, 1}};
  c.volume.segment_markers = {6, 5};
  for (std::size_t v = 0; v < c.surface.vertices.size(); ++v)
    c.surface.vertex_markers.push_back(static_cast<int>(v) - 3);
  c.volume.vertex_markers = c.surface.vertex_markers;
  c.volume.vertex_markers.resize(c.volume.vertices.size(), 0);
  return c;
}

TEST(Markers, KeptOnesHold) {
  EXPECT_EQ(broken(marked()), Names{});
  Case unmarked = marked();  // an input without markers leaves the list free
  unmarked.surface.facet_markers.clear();
  unmarked.surface.segment_markers.clear();
  EXPECT_EQ(broken(unmarked), Names{});
}

TEST(Markers, EveryWrongListIsTold) {
  const std::vector<std::function<void(Case&)>> spoils{
      [](Case& c) { c.volume.facet_markers[5] += 1; },
      [](Case& c) { c.volume.vertex_markers[1] += 1; },
      [](Case& c) { c.volume.vertex_markers.clear(); },
      [](Case& c) { c.surface.vertex_markers.pop_back(); },
      [](Case& c) { c.volume.segment_markers[1] = 8; },
      [](Case& c) { c.volume.facets.pop_back(), c.volume.facet_markers.pop_back(); },
      [](Case& c) { c.volume.segments.pop_back(), c.volume.segment_markers.pop_back(); },
      [](Case& c) { c.volume.facets.clear(), c.volume.facet_markers.clear(); },
      [](Case& c) { c.volume.facet_markers.clear(); },
      [](Case& c) { c.volume.facet_markers.pop_back(); },
      [](Case& c) { c.surface.facet_markers.pop_back(); },
      [](Case& c) {
        c.volume.facets[4] = {0, 1, 99};
      },
      [](Case& c) { c.volume.facets[4] = c.volume.facets[5]; },
      [](Case& c) {
        c.volume.segments[0] = {3, 4};
      },
  };
  for (std::size_t i = 0; i < spoils.size(); ++i) {
    Case c = marked();
    spoils[i](c);
    EXPECT_EQ(broken(c), (Names{"markers kept"})) << i;
  }
}

TEST(Detail, NamesTheFirstAndCountsTheRest) {
  Case c = grid({3, 1, 1});
  for (Tetrahedron& t : c.volume.tetrahedra) std::swap(t[0], t[1]);
  const std::string text = detail(c, "volumes positive");
  EXPECT_TRUE(contains(text, "18 tetrahedra are not positive: tetrahedron 0 ("));
  EXPECT_TRUE(contains(text, "tetrahedron 2 ("));
  EXPECT_FALSE(contains(text, "tetrahedron 3 ("));
  EXPECT_TRUE(text.ends_with("; and 15 more"));
}

}  // namespace
}  // namespace holdfast::check_cases::check_constraints_test
