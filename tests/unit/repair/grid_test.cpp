// Vertices of elements in trouble move to points of a grid, and those near them move along.
#include "repair/grid.h"

#include <gtest/gtest.h>

#include "small_surfaces.h"

namespace holdfast::repairing::grid_test {
namespace {

/// Two adjacent triangles whose vertices are near points of a grid of 1/4; only the first is in trouble.
State two_triangles() {
  Surface surface;
  small::add_triangle(surface, {0.01, 0, 0}, {1, 0.02, 0}, {0, 1, -0.03});
  small::add_triangle(surface, {0.02, 0, 0}, {1, 0.01, 0}, {0.01, -1.01, 0});
  return state_of(surface.view());
}

TEST(Grid, OneVertexIsLeftAtEachPointOfIt) {
  State state = two_triangles();
  const double moved = snap_to_grid(state, {{0}, {}}, 0.25);
  EXPECT_EQ(state.facets[0], (Triangle{0, 1, 2}));
  EXPECT_EQ(state.facets[1], (Triangle{0, 1, 5})) << "what is at the same points became the same vertices";
  EXPECT_EQ(state.vertices[0], (Point{0, 0, 0}));
  EXPECT_EQ(state.vertices[1], (Point{1, 0, 0}));
  EXPECT_EQ(state.vertices[2], (Point{0, 1, 0}));
  EXPECT_GE(moved, 0.03);
  EXPECT_LT(moved, 0.03 * (1 + 1e-12));
}

TEST(Grid, SlotsOfWhatBecameAnotherGoWithIt) {
  State state = two_triangles();
  (void)snap_to_grid(state, {{0}, {}}, 0.25);
  ASSERT_EQ(state.input_vertices, 6U);
  EXPECT_EQ(state.vertices[3], state.vertices[0]);
  EXPECT_EQ(state.vertices[4], state.vertices[1]);
  state.vertices[0] = state.vertices[3] = {0.3, 0, 0};
  (void)snap_to_grid(state, {{0}, {}}, 1);
  EXPECT_EQ(state.vertices[3], (Point{0, 0, 0})) << "no facet has it any longer";
}

TEST(Grid, WhatIsFarFromTroubleStays) {
  State state = two_triangles();
  state.known = {1, 1};
  (void)snap_to_grid(state, {{0}, {}}, 0.25);
  EXPECT_EQ(state.vertices[5], (Point{0.01, -1.01, 0}));
  EXPECT_EQ(state.known, (std::vector<std::uint8_t>{0, 0})) << "both have vertices that moved";
}

}  // namespace
}  // namespace holdfast::repairing::grid_test
