// Each kind of defect by name: entities, places and words; limits, cancelling, hostile input.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "holdfast/holdfast.h"
#include "small_surfaces.h"
#include "surface/diagnose.h"

namespace holdfast::surface_defects_test {
namespace {

using Indices = std::vector<Index>;

std::vector<Defect> diagnose(const Surface& s) { return holdfast::diagnose(s.view()); }

// The only defect.
Defect only(const Surface& s) {
  const std::vector<Defect> defects = diagnose(s);
  EXPECT_EQ(defects.size(), 1u);
  return defects.empty() ? Defect{} : defects[0];
}

TEST(Defects, ValidInputHasNone) {
  EXPECT_TRUE(holdfast::diagnose(Complex{}).empty());
  const Surface s =
      small::surface_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {5, 5, 5}, {6, 5, 5}},
                        {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}, {{4, 5}, {4, 5}, {5, 4}, {0, 1}});
  EXPECT_TRUE(diagnose(s).empty()) << "repeated segments and segments along sides are merged";
}

TEST(Defects, NonFiniteCoordinate) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  const Surface s =
      small::surface_of({{0, 0, 0}, {nan, 0, 0}, {0, 1, 0}, {0, 0, -inf}}, {{0, 1, 2}, {0, 2, 3}}, {{1, 3}});
  const std::vector<Defect> defects = diagnose(s);
  ASSERT_EQ(defects.size(), 2u);
  EXPECT_EQ(defects[0].kind, DefectKind::non_finite_coordinate);
  EXPECT_EQ(defects[0].vertices, Indices{1});
  EXPECT_EQ(defects[1].vertices, Indices{3});
  EXPECT_EQ(defects[1].message,
            "vertex 3 (0, 0, -inf) has a coordinate that is not finite: correct it, or remove the vertex");
}

TEST(Defects, IndexOutOfRange) {
  const Surface s = small::surface_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                                      {{0, 1, 3}, {0, 1, 2}, {4000000000u, 1, 2}}, {{0, 3}});
  const std::vector<Defect> defects = diagnose(s);
  ASSERT_EQ(defects.size(), 3u);
  for (const Defect& d : defects) EXPECT_EQ(d.kind, DefectKind::index_out_of_range);
  EXPECT_EQ(defects[0].facets, Indices{0});
  EXPECT_EQ(defects[1].facets, Indices{2});
  EXPECT_EQ(defects[2].segments, Indices{0});
  EXPECT_EQ(defects[0].message,
            "triangle 0 names vertex 3, but there are 3 vertices (counted from 0): correct its indices");
}

TEST(Defects, VerticesAtOnePlaceAreOne) {
  // A square whose triangles do not share vertices; +0 and -0 are one.
  const Surface s = small::surface_of(
      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, -0.0, 0}, {1, 1, 0}, {-0.0, 1, 0}}, {{0, 1, 2}, {3, 4, 5}});
  EXPECT_TRUE(diagnose(s).empty());
  // In a volume they are a defect, reported once and not for every neighbour.
  const std::vector<Defect> defects = find_defects(
      s.view(), SIZE_MAX, [](double) {}, 1, SamePlace::defect);
  ASSERT_EQ(defects.size(), 2u);
  EXPECT_EQ(defects[0].kind, DefectKind::repeated_vertex);
  EXPECT_EQ(defects[0].vertices, (Indices{1, 3}));
  EXPECT_EQ(defects[1].vertices, (Indices{2, 5}));
  EXPECT_EQ(defects[0].message, "vertices 1 and 3 are the same point (1, 0, 0): merge them");
}

TEST(Defects, DegenerateFacets) {
  const Surface s = small::surface_of({{0, 0, 0}, {0.1, 0.1, 0.1}, {0.3, 0.3, 0.3}}, {{0, 1, 1}, {0, 2, 1}});
  const std::vector<Defect> defects = diagnose(s);
  ASSERT_EQ(defects.size(), 2u);
  EXPECT_EQ(defects[0].kind, DefectKind::degenerate_facet);
  EXPECT_EQ(defects[0].message, "triangle 0 names vertex 1 twice: remove it");
  EXPECT_EQ(defects[1].kind, DefectKind::degenerate_facet);
  EXPECT_EQ(defects[1].where, (std::vector<Point>{{0, 0, 0}, {0.3, 0.3, 0.3}}));
  EXPECT_EQ(
      defects[1].message,
      "triangle 1 (0, 2, 1) has zero area: its vertices are collinear along (0, 0, 0) - (0.3, 0.3, 0.3); "
      "remove it, or move a vertex");
}

TEST(Defects, DegenerateSegments) {
  const Surface s = small::surface_of({{0, 0, 0}, {1, 0, 0}, {1, 0, 0}}, {}, {{1, 1}, {1, 2}});
  const std::vector<Defect> defects = diagnose(s);
  ASSERT_EQ(defects.size(), 2u);
  EXPECT_EQ(defects[0].message, "segment 0 names vertex 1 twice: remove it");
  EXPECT_EQ(defects[1].message, "segment 1 has zero length at (1, 0, 0): remove it");
}

TEST(Defects, RepeatedFacet) {
  const Defect d = only(small::surface_of({{0, 0, 0}, {3, 0, 0}, {0, 3, 0}}, {{0, 1, 2}, {1, 0, 2}}));
  EXPECT_EQ(d.kind, DefectKind::repeated_facet);
  EXPECT_EQ(d.facets, (Indices{0, 1}));
  EXPECT_EQ(d.where, (std::vector<Point>{{1, 1, 0}}));
  EXPECT_EQ(d.message, "triangles 0 and 1 have the same vertices 0, 1, 2: remove one of them");
}

TEST(Defects, TJunctionIsReportedOnce) {
  // Vertex 4 lies inside side 0-1 of two facets and is itself a corner of three others.
  const Surface s = small::surface_of(
      {{0, 0, 0}, {4, 0, 0}, {0, 0, 4}, {0, 0, -4}, {1, 0, 0}, {1, 2, 0}, {2, 2, 0}, {3, 2, 1}, {3, 2, 2}},
      {{0, 1, 2}, {0, 1, 3}, {4, 5, 6}, {4, 6, 7}, {4, 7, 8}});
  const Defect d = only(s);
  EXPECT_EQ(d.kind, DefectKind::vertex_in_segment);
  EXPECT_EQ(d.vertices, (Indices{4, 0, 1}));
  EXPECT_EQ(d.facets, (Indices{0, 1, 2, 3, 4})) << "those at the side, then those at the vertex";
  EXPECT_EQ(d.where, (std::vector<Point>{{1, 0, 0}}));
  EXPECT_EQ(d.message,
            "vertex 4 (1, 0, 0) lies inside side 0-1 of triangles 0 and 1 (T-junction): split it at this "
            "vertex, or move the vertex");
  EXPECT_EQ(offending_pairs(s.view(), SIZE_MAX, [](double) {}).size(), 6u);
}

TEST(Defects, VertexInFacet) {
  const Defect d = only(small::surface_of({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 0}}, {{0, 1, 2}}));
  EXPECT_EQ(d.kind, DefectKind::vertex_in_facet);
  EXPECT_EQ(d.vertices, Indices{3});
  EXPECT_EQ(d.facets, Indices{0});
  EXPECT_EQ(d.message,
            "vertex 3 (1, 1, 0) lies inside triangle 0: split it at this vertex, or move the vertex");
}

TEST(Defects, SegmentsCross) {
  const Defect d =
      only(small::surface_of({{0, 0, 0}, {3, 3, 3}, {3, 0, 3}, {0, 3, 0}}, {}, {{0, 1}, {2, 3}}));
  EXPECT_EQ(d.kind, DefectKind::segments_cross);
  EXPECT_EQ(d.segments, (Indices{0, 1}));
  EXPECT_EQ(d.vertices, (Indices{0, 1, 2, 3}));
  EXPECT_EQ(d.where, (std::vector<Point>{{1.5, 1.5, 1.5}}));
  EXPECT_EQ(d.message,
            "segment 0 (0-1) and segment 1 (2-3) cross at (1.5, 1.5, 1.5): split both at a new vertex there");
}

TEST(Defects, SidesCross) {
  // Two facets in different planes that touch in one point inside a side of each.
  const Defect d = only(small::surface_of(
      {{-1, 0, 0}, {1, 0, 0}, {0, 0, 1}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}}, {{0, 1, 2}, {3, 4, 5}}));
  EXPECT_EQ(d.kind, DefectKind::segments_cross);
  EXPECT_EQ(d.facets, (Indices{1, 0}));
  EXPECT_EQ(d.where, (std::vector<Point>{{0, 0, 0}}));
}

TEST(Defects, SegmentsOverlap) {
  const std::vector<Defect> defects =
      diagnose(small::surface_of({{0, 0, 0}, {3, 0, 0}, {1, 0, 0}, {5, 0, 0}}, {}, {{0, 1}, {2, 3}}));
  ASSERT_EQ(defects.size(), 3u) << "and each has an end inside the other";
  EXPECT_EQ(defects[2].kind, DefectKind::segments_overlap);
  EXPECT_EQ(defects[2].segments, (Indices{0, 1}));
  EXPECT_EQ(defects[2].where, (std::vector<Point>{{1, 0, 0}, {3, 0, 0}}));
}

TEST(Defects, SegmentPiercesFacet) {
  const Defect d = only(
      small::surface_of({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 3}, {1, 1, -1}}, {{0, 1, 2}}, {{3, 4}}));
  EXPECT_EQ(d.kind, DefectKind::segment_pierces_facet);
  EXPECT_EQ(d.facets, Indices{0});
  EXPECT_EQ(d.segments, Indices{0});
  EXPECT_EQ(d.where, (std::vector<Point>{{1, 1, 0}}));
  EXPECT_EQ(
      d.message,
      "segment 0 (3-4) passes through triangle 0 at (1, 1, 0): split both where they meet, or move one");
}

TEST(Defects, FacetsCross) {
  const Defect d = only(small::surface_of(
      {{0, 0, 0}, {8, 0, 0}, {0, 8, 0}, {2, 2, -4}, {2, 2, 4}, {2, -8, 4}}, {{0, 1, 2}, {3, 4, 5}}));
  EXPECT_EQ(d.kind, DefectKind::facets_cross);
  EXPECT_EQ(d.facets, (Indices{0, 1}));
  EXPECT_EQ(d.where, (std::vector<Point>{{2, 0, 0}, {2, 2, 0}}));
  EXPECT_EQ(d.message,
            "triangles 0 and 1 cross along (2, 0, 0) - (2, 2, 0): split both along this line, or move one");
}

TEST(Defects, FacetsOverlap) {
  // A star of two triangles: no corner of one inside the other.
  const Defect d = only(small::surface_of(
      {{-3, -1, 0}, {3, -1, 0}, {0, 2, 0}, {-3, 1, 0}, {3, 1, 0}, {0, -2, 0}}, {{0, 1, 2}, {3, 4, 5}}));
  EXPECT_EQ(d.kind, DefectKind::facets_overlap);
  ASSERT_EQ(d.where.size(), 1u);
  EXPECT_NEAR(d.where[0][0], 0, 1e-15);
  EXPECT_NEAR(d.where[0][1], 0, 1e-15);
}

TEST(Defects, PlacesAreRightWhereFloatingPointFails) {
  // Two needles that cross at an angle of 1e-12, far from the origin: the crossing is at a third of each.
  const double far = 0x1p30;
  const Surface s =
      small::surface_of({{far, 0, 0}, {far + 3, 3 * 0x1p-40, 0}, {far, 0x1p-40, 0}, {far + 3, 0x1p-40, 0}},
                        {}, {{0, 1}, {2, 3}});
  const Defect d = only(s);
  ASSERT_EQ(d.where.size(), 1u);
  EXPECT_EQ(d.where[0], (Point{far + 1, 0x1p-40, 0}));
}

TEST(Defects, LimitsAreKept) {
  Surface s = small::surface_of({{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {5, 0, 0}, {0, 5, 0}, {1, 1, 0}, {2, 1, 0}},
                                {{0, 3, 4}, {0, 0, 3}, {3, 4, 3}});
  EXPECT_EQ(diagnose(s).size(), 4u);
  for (std::size_t most = 0; most <= 5; ++most) {
    EXPECT_EQ(holdfast::diagnose(s.view(), most).size(), std::min<std::size_t>(most, 4));
    EXPECT_EQ(offending_pairs(s.view(), most, [](double) {}).size(), std::min<std::size_t>(most, 2));
  }
}

TEST(Defects, StepIsCalledAndMayThrow) {
  Surface s;
  for (int i = 0; i < 100; ++i) {
    for (int j = 0; j < 100; ++j) s.vertices.push_back({double(i), double(j), 0});
  }
  for (Index i = 0; i < 99; ++i) {
    for (Index j = 0; j < 99; ++j) s.facets.push_back({100 * i + j, 100 * i + j + 1, 100 * i + j + 100});
  }
  int calls = 0;
  EXPECT_TRUE(find_defects(s.view(), SIZE_MAX, [&](double fraction) {
                ++calls;
                EXPECT_GE(fraction, 0);
                EXPECT_LE(fraction, 1);
              }).empty());
  EXPECT_GT(calls, 5);
  const auto stop = [](double) { throw std::runtime_error("stop"); };
  EXPECT_THROW(static_cast<void>(find_defects(s.view(), SIZE_MAX, stop)), std::runtime_error);
}

TEST(Defects, EndsOfTheRange) {
  const double big = std::numeric_limits<double>::max(), tiny = std::numeric_limits<double>::denorm_min();
  // Crossing at both ends of the exponent range, and far-apart magnitudes in one complex.
  EXPECT_EQ(
      only(small::surface_of({{-big, 0, 0}, {big, 0, 0}, {0, -big, 0}, {0, big, 0}}, {}, {{0, 1}, {2, 3}}))
          .kind,
      DefectKind::segments_cross);
  EXPECT_EQ(only(small::surface_of({{-tiny, 0, 0}, {tiny, 0, 0}, {0, -tiny, 0}, {0, tiny, 0}}, {},
                                   {{0, 1}, {2, 3}}))
                .kind,
            DefectKind::segments_cross);
  EXPECT_EQ(
      only(small::surface_of({{-big, 0, 0}, {big, 0, 0}, {0, -tiny, 0}, {0, tiny, 0}}, {}, {{0, 1}, {2, 3}}))
          .kind,
      DefectKind::segments_cross);
  EXPECT_TRUE(diagnose(small::surface_of({{-big, 0, 0}, {big, 0, 0}, {0, tiny, 0}, {0, big, 0}}, {},
                                         {{0, 1}, {2, 3}}))
                  .empty());
  EXPECT_TRUE(
      diagnose(
          small::surface_of(
              {{-big, -big, 0}, {big, -big, 0}, {0, big, 0}, {0, 0, tiny}, {big, 0, tiny}, {0, big, tiny}},
              {{0, 1, 2}, {3, 4, 5}}))
          .empty());
}

}  // namespace
}  // namespace holdfast::surface_defects_test
