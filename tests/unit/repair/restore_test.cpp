// Merged vertices return to a valid surface.
#include "repair/restore.h"

#include <gtest/gtest.h>

#include "repair/settle.h"

namespace holdfast::repairing::restore_test {
namespace {

const Step kNoStep = [](double) {};

/// An octahedron, and a vertex that was at some place and was merged with its apex, vertex 0.
struct Octahedron {
  std::vector<Point> before{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
  State state;

  explicit Octahedron(const Point& lost) {
    before.push_back(lost);
    const std::vector<Triangle> facets{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1},
                                       {5, 2, 1}, {5, 3, 2}, {5, 4, 3}, {5, 1, 4}};
    state = state_of({before, facets, {}, {}, {}});
    state.vertices[6] = state.vertices[0];
  }

  /// Restores it. Returns the number of facets.
  std::size_t restored(double most) {
    const double bent = restore(state, before, kNoStep, 1);
    EXPECT_LE(bent, most);
    EXPECT_EQ(state.vertices, before);
    EXPECT_TRUE(trouble_of(state, kNoStep, 1).none());
    EXPECT_EQ(state.facet_parents.size(), state.facets.size());
    for (Index v = 0; v < before.size(); ++v)
      EXPECT_TRUE(std::any_of(state.facets.begin(), state.facets.end(),
                              [&](const Triangle& t) { return std::count(t.begin(), t.end(), v) == 1; }));
    return state.facets.size();
  }
};

TEST(Restore, BesideAFacet) {
  const double e = 0x1p-50;
  EXPECT_EQ(Octahedron({e, 2 * e, 1 - 2 * e}).restored(8 * e), 10u);
  EXPECT_EQ(Octahedron({e, 2 * e, 1 - 4 * e}).restored(8 * e), 10u);
}

TEST(Restore, BesideASide) {
  const double e = 0x1p-50;
  EXPECT_EQ(Octahedron({e, 0, 1 - e}).restored(8 * e), 10u);
  EXPECT_EQ(Octahedron({2 * e, 0, 1 - e}).restored(8 * e), 10u);
}

/// A vertex further out has no facet and no side below it, and becomes the apex.
TEST(Restore, BeyondAnApex) {
  const double e = 0x1p-50;
  EXPECT_EQ(Octahedron({0, 0, 1 + e}).restored(8 * e), 10u);
  EXPECT_EQ(Octahedron({e / 4, 0, 1 + e}).restored(8 * e), 10u);
}

/// The surface is routed through one of several at one place; at the place of a used vertex nothing is
/// needed.
TEST(Restore, AtOnePlace) {
  const double e = 0x1p-50;
  Octahedron several({e, 2 * e, 1 - 4 * e});
  several.before.push_back(several.before[6]);
  several.before.push_back(several.before[1]);
  several.state.vertices.insert(several.state.vertices.end(), 2, several.before[0]);
  several.state.input_vertices = several.before.size();
  EXPECT_LE(restore(several.state, several.before, kNoStep, 1), 4 * e);
  EXPECT_EQ(several.state.vertices, several.before);
  EXPECT_EQ(several.state.facets.size(), 10u);
  EXPECT_TRUE(trouble_of(several.state, kNoStep, 1).none());
}

/// A side that is also a segment is routed through the vertex as a segment.
TEST(Restore, SegmentsFollowTheirSides) {
  const double e = 0x1p-50;
  Octahedron octahedron({2 * e, 0, 1 - 3 * e});
  octahedron.state.segments.push_back({1, 0});
  octahedron.state.segment_parents.add(std::array<Index, 1>{0});
  octahedron.state.facets.clear();
  octahedron.state.facet_parents = {};
  restore(octahedron.state, octahedron.before, kNoStep, 1);
  EXPECT_EQ(octahedron.state.vertices[6],
            octahedron.state.vertices[0]);  // a segment alone includes no vertex
  Octahedron with_facets({2 * e, 0, 1 - e});
  with_facets.state.segments.push_back({1, 0});
  with_facets.state.segment_parents.add(std::array<Index, 1>{0});
  EXPECT_EQ(with_facets.restored(8 * e), 10u);
  EXPECT_EQ(with_facets.state.segments, (std::vector<Segment>{{1, 6}, {6, 0}}));
}

/// Where nothing moved, nothing changes.
TEST(Restore, NothingIsLost) {
  Octahedron octahedron({0, 0, 1});
  const std::vector<Triangle> facets = octahedron.state.facets;
  EXPECT_EQ(restore(octahedron.state, octahedron.before, kNoStep, 1), 0);
  EXPECT_EQ(octahedron.state.facets, facets);
}

}  // namespace
}  // namespace holdfast::repairing::restore_test
