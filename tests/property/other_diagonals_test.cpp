// What with_other_diagonals declares fitting does fit: random triangles on small grids, where much is
// coplanar and cospherical and little fits, against the exact test of all pairs.
#include "recover/other_diagonals.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "mesh_fixtures.h"
#include "small_surfaces.h"
#include "surface/elements.h"
#include "surface/search.h"

namespace holdfast::other_diagonals_test {
namespace {

using Random = std::mt19937_64;

// Around the edge 0 1 of their Delaunay mesh.
const std::vector<Point> kSpindle{{0, 0, -0.5}, {0, 0, 0.5}, {-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}};

struct Told {
  Standing standing, fitting;
  bool all_fit;  // those with a flag in `fitting`
};

// The facets must have areas.
Told told_of(const Surface& surface) {
  const Complex complex = surface.view();
  const SegmentTable table = segment_table(complex);
  TetMesh mesh = testing::delaunay_in_box(surface.vertices, 100);
  Told told{mark_present(mesh, table), {}, false};
  told.fitting = with_other_diagonals(mesh, complex, table, told.standing);
  Surface flagged = small::surface_of(surface.vertices, {});
  for (Index f = 0; f < surface.facets.size(); ++f)
    if (told.fitting.facets[f] != 0) flagged.facets.push_back(surface.facets[f]);
  for (Index s = 0; s < table.segments.size(); ++s)
    if (told.fitting.segments[s] != 0) flagged.segments.push_back(table.segments[s]);
  const Complex fitting = flagged.view();
  told.all_fit = all_fit(fitting, elements_of(fitting), {}, [](double) {});
  return told;
}

std::size_t added(const std::vector<std::uint8_t>& before, const std::vector<std::uint8_t>& after) {
  std::size_t count = 0;
  for (std::size_t k = 0; k < before.size(); ++k) {
    EXPECT_LE(before[k], after[k]);
    count += after[k] - before[k];
  }
  return count;
}

std::vector<Point> grid_points(int size) {
  std::vector<Point> points;
  for (int k = 0; k < size * size * size; ++k)
    points.push_back({double(k % size), double(k / size % size), double(k / size / size)});
  return points;
}

// The squares of a grid of cells, each omitted or divided along a diagonal at random.
Surface divided_squares(int size, Random& random, unsigned percent) {
  Surface surface = small::surface_of(grid_points(size), {});
  const auto at = [&](int x, int y, int z) { return static_cast<Index>(x + size * (y + size * z)); };
  const auto add = [&](Index a, Index b, Index c, Index d) {
    if (random() % 100 >= percent) return;
    if (random() % 2 == 0)
      surface.facets.insert(surface.facets.end(), {{a, b, c}, {a, c, d}});
    else
      surface.facets.insert(surface.facets.end(), {{a, b, d}, {b, c, d}});
  };
  for (int i = 0; i < size; ++i)
    for (int j = 0; j + 1 < size; ++j)
      for (int k = 0; k + 1 < size; ++k) {
        add(at(i, j, k), at(i, j + 1, k), at(i, j + 1, k + 1), at(i, j, k + 1));
        add(at(j, i, k), at(j + 1, i, k), at(j + 1, i, k + 1), at(j, i, k + 1));
        add(at(j, k, i), at(j + 1, k, i), at(j + 1, k + 1, i), at(j, k + 1, i));
      }
  return surface;
}

bool has_area(const Surface& surface, const Triangle& t) {
  Simplex facet{3, {t[0], t[1], t[2]}, {}, 0, 0};
  for (std::size_t k = 0; k < 3; ++k) facet.point[k] = surface.vertices[t[k]].data();
  return set_projection(facet);
}

TEST(OtherDiagonals, OfGridsLeaveNothingToTest) {
  Random random(1);
  for (const unsigned percent : {100u, 60u, 20u}) {
    const Told told = told_of(divided_squares(6, random, percent));
    EXPECT_GT(told.standing.missing_facets(), told.fitting.facets.size() / 4);
    EXPECT_EQ(told.fitting.missing_facets(), 0u);
    EXPECT_EQ(told.fitting.missing_segments(), 0u);
    EXPECT_TRUE(told.all_fit);
  }
}

TEST(OtherDiagonals, FitWhateverElseIsThere) {
  std::size_t added_facets = 0, left_out = 0;
  for (unsigned seed = 0; seed < 300; ++seed) {
    Random random(seed);
    Surface surface = divided_squares(3, random, 30 + seed % 60);
    std::set<std::set<Index>> facets;
    for (const Triangle& t : surface.facets) facets.insert({t[0], t[1], t[2]});
    const auto vertex = [&] { return static_cast<Index>(random() % surface.vertices.size()); };
    for (unsigned k = 0; k < 2 + seed % 30; ++k) {
      const Triangle t{vertex(), vertex(), vertex()};
      if (has_area(surface, t) && facets.insert({t[0], t[1], t[2]}).second) surface.facets.push_back(t);
    }
    const Told told = told_of(surface);
    EXPECT_TRUE(told.all_fit) << "seed " << seed;
    added_facets += added(told.standing.facets, told.fitting.facets);
    EXPECT_EQ(2 * added(told.standing.segments, told.fitting.segments),
              added(told.standing.facets, told.fitting.facets));
    left_out += told.fitting.missing_facets();
  }
  EXPECT_GT(added_facets, 1000u);
  EXPECT_GT(left_out, 1000u);
}

// Two squares with one common diagonal, which is in the mesh, so that either of them alone would fit.
TEST(OtherDiagonals, TwoOfOneDiagonalAreLeftOut) {
  const std::vector<Triangle> one{{2, 3, 0}, {2, 3, 1}}, other{{4, 5, 0}, {4, 5, 1}};
  Surface surface = small::surface_of(kSpindle, one);
  EXPECT_EQ(told_of(surface).standing.missing_facets(), 2u);
  EXPECT_EQ(told_of(surface).fitting.missing_facets(), 0u);
  surface.facets.insert(surface.facets.end(), other.begin(), other.end());
  EXPECT_EQ(told_of(surface).fitting.missing_facets(), 4u);
}

TEST(OtherDiagonals, ASegmentInThePlaceOfOneIsLeftOut) {
  const Told told = told_of(small::surface_of(kSpindle, {{2, 3, 0}, {2, 3, 1}}, {{0, 1}}));
  EXPECT_EQ(told.standing.missing_segments(), 1u);
  EXPECT_EQ(told.fitting.missing_segments(), 1u);
  EXPECT_EQ(told.fitting.missing_facets(), 2u);
}

TEST(OtherDiagonals, BentOnesAndOverlapsAreLeftOut) {
  // Slightly bent, and with a corner inside, where the facets overlap.
  for (const Point& corner : {Point{0, 0x1p-50, 0.5}, Point{0, 0, -0.25}}) {
    std::vector<Point> points = kSpindle;
    points[1] = corner;
    const Told told = told_of(small::surface_of(points, {{2, 3, 0}, {2, 3, 1}}));
    EXPECT_EQ(told.fitting.missing_facets(), told.standing.missing_facets());
  }
}

// The ring around the edge 4 5 has the quadrilateral's sides, but none of the mesh's faces.
TEST(OtherDiagonals, PiercedOnesAreLeftOut) {
  std::vector<Point> points = kSpindle;
  points[0] = {0, 0, -1};
  points[1] = {0, 0, 1};
  points[4] = {0, -0.5, 0};
  points[5] = {0, 0.5, 0};
  const Told told = told_of(small::surface_of(points, {{2, 3, 0}, {2, 3, 1}}, {{4, 5}}));
  EXPECT_EQ(told.standing.missing_segments(), 1u);
  EXPECT_EQ(told.fitting.missing_facets(), 2u);
}

}  // namespace
}  // namespace holdfast::other_diagonals_test
