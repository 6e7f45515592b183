// The plane on random valid inputs: every method gives positive triangles of the same area that keep every
// segment.
#include <gtest/gtest.h>

#include <numeric>
#include <optional>
#include <set>

#include "holdfast/names.h"
#include "plane/number_set.h"
#include "plane/order.h"
#include "plane/point_tree.h"
#include "plane/sequence.h"
#include "plane/vertex_set.h"
#include "plane_inputs.h"

namespace holdfast::plane_test {
namespace {

using testing::Coordinates;
using testing::double_area;
using testing::fault_of;
using testing::random_plane;
using testing::random_point;

class PlaneMethods : public ::testing::TestWithParam<int> {};

TEST_P(PlaneMethods, SolveRandomInputsAlike) {
  constexpr int kEach = 60;
  std::size_t solved = 0;
  for (int k = 0; k < kEach; ++k) {
    const auto seed = static_cast<std::uint64_t>(GetParam() * kEach + k + 1);
    SCOPED_TRACE(::testing::Message() << "seed " << seed);
    const Plane plane = random_plane(seed);
    std::optional<exact::Dyadic> area;
    for (const PlaneMethod method : values_of<PlaneMethod>())
      for (const bool delaunay : {false, true}) {
        PlaneOptions options;
        options.method = method;
        options.delaunay = delaunay;
        const PlaneResult result = triangulate(plane, options);
        SCOPED_TRACE(::testing::Message() << name(method) << (delaunay ? ", Delaunay" : ""));
        if (result.outcome != Outcome::done) {
          ASSERT_EQ(result.outcome, Outcome::invalid_input);
          ASSERT_EQ(result.defects.size(), 1u) << result.defects[1].message;
          ASSERT_EQ(result.defects[0].kind, DefectKind::encloses_nothing);
        }
        ASSERT_EQ(fault_of(plane, result.mesh, delaunay), "");
        const exact::Dyadic now = double_area(result.mesh);
        if (!area) area = now;
        ASSERT_EQ(*area, now);
        solved += result.outcome == Outcome::done;
      }
  }
  EXPECT_GT(solved, 0u);
}

INSTANTIATE_TEST_SUITE_P(Seeds, PlaneMethods, ::testing::Range(0, 5));

// One defect in a valid input: it is reported, with the entities that cause it.
TEST(PlaneDefects, AreNamed) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE(::testing::Message() << "seed " << seed);
    Plane plane = random_plane(seed);
    if (plane.segments.size() < 2) continue;
    ASSERT_TRUE(diagnose(plane).empty());
    numbers::Random random(seed);
    const auto pick = [&](std::size_t n) { return static_cast<Index>(numbers::below(n, random)); };
    const Index s = pick(plane.segments.size());
    const auto [a, b] = plane.segments[s];
    const auto expect = [&](DefectKind kind, const std::vector<Index>& points,
                            const std::vector<Index>& segments) {
      for (const PlaneMethod method : values_of<PlaneMethod>()) {
        PlaneOptions options;
        options.method = method;
        const PlaneResult result = triangulate(plane, options);
        ASSERT_EQ(result.outcome, Outcome::invalid_input);
        const bool named = std::any_of(result.defects.begin(), result.defects.end(), [&](const Defect& d) {
          return d.kind == kind && d.vertices == points && d.segments == segments;
        });
        EXPECT_TRUE(named) << name(method) << ": " << result.defects.size()
                           << " defects, the first: " << result.defects[0].message;
      }
    };
    const auto last_point = static_cast<Index>(plane.points.size());
    const auto last_segment = static_cast<Index>(plane.segments.size());
    switch (seed % 4) {
      case 0:
        plane.points.push_back(plane.points[a]);
        expect(DefectKind::repeated_vertex, {a, last_point}, {});
        break;
      case 1:
        plane.segments.push_back({b, a});
        expect(DefectKind::segments_overlap, {}, {s, last_segment});
        break;
      case 2: {
        const PlanePoint &p = plane.points[a], &q = plane.points[b];
        const PlanePoint middle{p[0] / 2 + q[0] / 2, p[1] / 2 + q[1] / 2};
        if (!testing::lies_between(p, q, middle)) break;
        plane.points.push_back(middle);
        expect(DefectKind::vertex_in_segment, {last_point}, {s});
        break;
      }
      default: {
        const auto at = [&](Index v) { return plane.points[v].data(); };
        const auto side = [&](Index p, Index q, Index v) { return exact::orient2d(at(p), at(q), at(v)); };
        bool found = false;
        for (Index p = 0; p < last_point && !found; ++p)
          for (Index q = p + 1; q < last_point && !found; ++q) {
            found = side(a, b, p) * side(a, b, q) < 0 && side(p, q, a) * side(p, q, b) < 0;
            if (found) plane.segments.push_back({p, q});
          }
        if (found) expect(DefectKind::segments_cross, {}, {s, last_segment});
      }
    }
  }
}

TEST(PointTree, FindsEveryPointInATriangle) {
  for (const Coordinates kind : {Coordinates::grid, Coordinates::random, Coordinates::tiny, Coordinates::huge,
                                 Coordinates::at_2_52, Coordinates::clustered}) {
    numbers::Random random(7);
    plane::Points points;
    std::vector<plane::Vertex> vertices;
    // Corners of triangles may lie outside all points of the tree.
    constexpr plane::Vertex kPlanted = 500;
    for (plane::Vertex v = 0; v < 700; ++v) {
      points.add(random_point(kind, 40, random));
      if (v < kPlanted) vertices.push_back(v);
    }
    plane::PointTree tree(points, vertices);
    std::vector<bool> erased(vertices.size(), false);
    for (int round = 0; round < 300; ++round) {
      const auto any = [&] { return static_cast<plane::Vertex>(numbers::below(points.size(), random)); };
      const plane::Vertex a = any(), b = any(), c = any();
      if (points.orient(a, b, c) <= 0) continue;
      std::set<std::uint32_t> found;
      tree.each_near(a, b, c, [&](std::uint32_t item) { return found.insert(item).second; });
      for (const plane::Vertex v : vertices) {
        const bool inside =
            points.orient(a, b, v) >= 0 && points.orient(b, c, v) >= 0 && points.orient(c, a, v) >= 0;
        EXPECT_TRUE(found.contains(v) ? !erased[v] : !inside || erased[v]) << v;
      }
      const plane::Vertex gone = any() % kPlanted;
      tree.erase(gone);
      erased[gone] = true;
    }
  }
}

TEST(PlaneOrder, GoesFromLeftToRight) {
  for (const Coordinates kind : {Coordinates::grid, Coordinates::random, Coordinates::tiny, Coordinates::huge,
                                 Coordinates::at_2_52, Coordinates::clustered}) {
    numbers::Random random(11);
    for (const std::size_t count : {0u, 1u, 2u, 30u, 5000u}) {
      std::vector<plane::Position> points;
      for (std::size_t i = 0; i < count; ++i) points.push_back(random_point(kind, 40, random));
      std::vector<plane::Vertex> expected(count);
      std::iota(expected.begin(), expected.end(), plane::Vertex{0});
      std::stable_sort(expected.begin(), expected.end(),
                       [&](plane::Vertex v, plane::Vertex w) { return points[v] < points[w]; });
      EXPECT_EQ(plane::order_from_left(points), expected) << count;
    }
  }
}

TEST(NumberSet, FindsTheNextNumber) {
  for (const std::size_t bound : {1u, 64u, 65u, 5000u}) {
    numbers::Random random(bound);
    plane::NumberSet set(bound);
    std::set<std::size_t> expected;
    for (int step = 0; step < 3000; ++step) {
      const std::size_t i = numbers::below(bound, random), from = numbers::below(bound + 2, random);
      if (numbers::below(3, random) == 0) {
        set.insert(i);
        expected.insert(i);
      } else {
        set.erase(i);
        expected.erase(i);
      }
      EXPECT_EQ(set.contains(i), expected.contains(i));
      const auto next = expected.lower_bound(from);
      EXPECT_EQ(set.from(from), next == expected.end() ? plane::NumberSet::none : *next);
    }
  }
}

// Before the rows are computed, and afterwards.
TEST(VertexSet, FindsThoseBetweenTwoHeights) {
  for (const Coordinates kind : {Coordinates::grid, Coordinates::random, Coordinates::tiny, Coordinates::huge,
                                 Coordinates::at_2_52, Coordinates::clustered}) {
    numbers::Random random(5);
    plane::Points points;
    for (int i = 0; i < 300; ++i) points.add(random_point(kind, 40, random));
    plane::VertexSet set(points);
    std::set<plane::Vertex> expected;
    const auto any = [&] { return static_cast<plane::Vertex>(numbers::below(points.size(), random)); };
    for (int round = 0; round < 600; ++round) {
      const plane::Vertex v = any();
      if (expected.insert(v).second) {
        set.insert(v);
      } else {
        set.erase(v);
        expected.erase(v);
      }
      EXPECT_EQ(set.contains(v), expected.contains(v));
      if (round < 100) continue;
      const plane::Vertex first = any(), last = any();
      const auto [low, high] = std::minmax({points[any()][1], points[any()][1]});
      std::vector<plane::Vertex> found;
      set.each_between(first, last, low, high, [&](plane::Vertex w) {
        found.push_back(w);
        return true;
      });
      EXPECT_TRUE(std::is_sorted(found.begin(), found.end()));
      for (const plane::Vertex w : found) EXPECT_TRUE(w >= first && w < last && expected.contains(w)) << w;
      for (const plane::Vertex w : expected)
        if (w >= first && w < last && points[w][1] >= low && points[w][1] <= high) {
          EXPECT_TRUE(std::binary_search(found.begin(), found.end(), w)) << w;
        }
      if (found.size() < 2) continue;
      set.each_between(first, last, low, high, [&](plane::Vertex w) {
        EXPECT_EQ(w, found[0]);
        return false;
      });
    }
  }
}

TEST(Sequence, KeepsAnOrder) {
  constexpr std::size_t kBound = 700;
  numbers::Random random(3);
  // The order of numbers is that of their heights.
  std::vector<std::uint64_t> height(kBound);
  for (std::uint64_t& h : height) h = random();
  plane::Sequence sequence(kBound);
  std::set<std::pair<std::uint64_t, std::uint32_t>> expected;
  for (int step = 0; step < 6000; ++step) {
    const auto i = static_cast<std::uint32_t>(numbers::below(kBound, random));
    const std::uint32_t at = sequence.find([&](std::uint32_t j) { return height[j] < height[i]; });
    const auto place = expected.lower_bound({height[i], 0});
    ASSERT_EQ(at, place == expected.end() ? sequence.end() : place->second);
    // It grows to several blocks in the first half, and shrinks to none in the second.
    if (at == i && step > 3000) {
      sequence.erase(i);
      expected.erase(place);
    } else if (at != i && step < 3000) {
      sequence.insert(at, i);
      expected.insert({height[i], i});
    }
    if (step % 100 != 0) continue;
    std::uint32_t next = sequence.end();
    for (const auto& [h, number] : expected) {
      EXPECT_EQ(sequence.previous(number), next);
      next = sequence.next(next);
      ASSERT_EQ(next, number);
    }
    EXPECT_EQ(sequence.next(next), sequence.end());
  }
}

}  // namespace
}  // namespace holdfast::plane_test
