// Elimination: one point at a time off segments and facets; fictitious cuts.
#include <gtest/gtest.h>

#include <map>
#include <numeric>

#include "enforce/collapse_within.h"
#include "enforce/cut_and_cone.h"
#include "enforce/fictitious_cut.h"
#include "mesh/assembly.h"
#include "mesh/validate.h"
#include "mesh_fixtures.h"
#include "unit/enforced.h"

namespace holdfast::eliminate_test {
namespace {

using namespace testing;

// --- elimination, one point at a time

// The neighbours of a point on its segment's chain, if it is on a segment.
std::optional<Ends> ends_of(const Task& t, Vertex p) {
  for (const auto& [a, b] : t.table.segments) {
    const std::vector<Vertex> chain = vertices_on(t.mesh, a, b);
    const auto at = std::find(chain.begin(), chain.end(), p);
    if (at != chain.end()) return Ends{*(at - 1), *(at + 1)};
  }
  return std::nullopt;
}

// A laid complex and its partition points in random order.
std::pair<Task, std::vector<Vertex>> laid(const Surface& surface, std::uint64_t seed) {
  Task t = task(surface);
  run(t, {.seed = seed, .eliminate = false});
  std::vector<Vertex> points(t.mesh.vertex_count() - t.first_free);
  std::iota(points.begin(), points.end(), t.first_free);
  Random random(seed);
  std::shuffle(points.begin(), points.end(), random);
  return {t, points};
}

TEST(CutAndCone, TakesEveryPointOffAnyNumberOfFacets) {
  for (int k = 0; k <= 5; ++k)
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      auto [t, points] = laid(pages(k, seed), seed);
      EXPECT_GT(points.size(), 0u);
      for (const Vertex p : points) {
        const auto before = static_cast<Vertex>(t.mesh.vertex_count());
        const std::vector<Vertex> created = cut_and_cone(t.mesh, p, ends_of(t, p));
        ASSERT_FALSE(t.mesh.in_mesh(p));
        for (Vertex v = before; v < t.mesh.vertex_count(); ++v) {
          EXPECT_EQ(std::count(created.begin(), created.end(), v), t.mesh.in_mesh(v) ? 1 : 0);
          expect_off_constraints(t, v);
        }
        ASSERT_EQ(find_fault(t.mesh), "");
        if (t.mesh.vertex_count() % 8 == 0) expect_laid(t);
      }
      expect_enforced(t);
    }
}

TEST(CollapseWithin, TakesAPointAlongItsConstraintWhereOneSeesAll) {
  int gone = 0, stay = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    auto [t, points] = laid(pages(static_cast<int>(seed % 5), seed), seed);
    for (const Vertex p : points) {
      const std::optional<Ends> ends = ends_of(t, p);
      const auto candidates =
          ends ? std::vector<Vertex>(ends->begin(), ends->end()) : facet_neighbours(t.mesh, p);
      const std::vector<FaceKey> faces = outer_faces(t.mesh, ball_of(t.mesh, p));
      const bool possible = std::any_of(candidates.begin(), candidates.end(),
                                        [&](Vertex v) { return all_positive(t.mesh, cone(faces, v)); });
      const TetMesh before = t.mesh;
      const std::vector<Ends> edge = ends ? std::vector<Ends>{*ends} : std::vector<Ends>{};
      ASSERT_EQ(collapse_within(t.mesh, p, candidates, edge), possible);
      ASSERT_EQ(t.mesh.in_mesh(p), !possible);
      EXPECT_TRUE(possible || difference(t.mesh, before).empty());
      expect_laid(t);
      if (HasFailure()) return;
      ++(possible ? gone : stay);
    }
  }
  EXPECT_GT(gone, 50);
  EXPECT_GT(stay, 50);
}

void expect_fictitious(Task& t, Vertex p, const Ends& ends, const std::vector<CutPath>& cuts) {
  std::set<EdgeEnds> taken;
  for (const CutPath& path : cuts) {
    ASSERT_GE(path.size(), 3u);
    EXPECT_EQ((Ends{path.front(), path.back()}), ends);
    for (std::size_t j = 1; j < path.size(); ++j) {
      EXPECT_EQ(t.mesh.orient(ends[0], ends[1], path[1], path[j]), 0);
      const Face f = find_face(t.mesh, p, path[j - 1], path[j]);
      ASSERT_NE(f, kNone);
      EXPECT_FALSE(t.mesh.is_facet(f));
      EXPECT_TRUE(taken.insert(sorted(EdgeEnds{path[j - 1], path[j]})).second);
    }
  }
}

TEST(FictitiousCuts, StandInForTheFacetsThatAreMissing) {
  std::size_t with_points = 0, without = 0;
  for (const int k : {0, 1, 2})
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
      auto [t, points] = laid(pages(k, seed), seed);
      for (const Vertex p : points) {
        const std::optional<Ends> ends = ends_of(t, p);
        if (!ends) continue;
        const bool on_fold = on_line(t.mesh, 0, 1, p);
        std::vector<Vertex> created;
        const auto cuts = fictitious_cuts(t.mesh, p, *ends, created);
        ASSERT_EQ(cuts.size(), on_fold ? 2 - static_cast<std::size_t>(k) : 1u);
        expect_fictitious(t, p, *ends, cuts);
        for (const Vertex v : created) expect_off_constraints(t, v);
        ++(created.empty() ? without : with_points);
        expect_laid(t);
        cut_and_cone(t.mesh, p, ends);
      }
    }
  EXPECT_GT(without, 50u);
  EXPECT_GT(with_points, 5u);
}

// Directions to the points of a grid around the origin, each once, in angular order.
std::vector<std::array<int, 2>> directions_of_grid(int reach) {
  std::vector<std::array<int, 2>> out;
  for (int x = -reach; x <= reach; ++x)
    for (int y = -reach; y <= reach; ++y)
      if (std::gcd(x, y) == 1) out.push_back({x, y});
  const auto upper = [](const std::array<int, 2>& d) { return d[1] > 0 || (d[1] == 0 && d[0] > 0); };
  std::sort(out.begin(), out.end(), [&](const auto& d, const auto& e) {
    return upper(d) != upper(e) ? upper(d) : d[0] * e[1] - d[1] * e[0] > 0;
  });
  return out;
}

// The ball of vertex 0, whose link has these triangles, each positive with it, closed by ghosts.
TetMesh mesh_of_ball(const std::vector<Point>& points, const std::vector<Triangle>& link) {
  TetMesh mesh;
  for (const Point& p : points) MeshEditor(mesh).add_vertex(p);
  std::map<FaceKey, Face> open;
  const auto add = [&](const TetMesh::Corners& corners) {
    const Tet t = MeshAssembly(mesh).add_tet(corners);
    for (int i = 0; i < 4; ++i) {
      FaceKey key{};
      std::size_t n = 0;
      for (int k = 0; k < 4; ++k)
        if (k != i) key[n++] = mesh.corner(t, k);
      const auto [at, is_first] = open.try_emplace(sorted(key), face_code(t, i));
      if (!is_first) MeshAssembly(mesh).link(face_code(t, i), at->second);
    }
    for (const Vertex v : corners)
      if (v != kGhost) MeshAssembly(mesh).set_incident(v, t);
  };
  for (const auto& [a, b, c] : link) add({a, c, b, kGhost});
  for (const auto& [a, b, c] : link) add({a, b, c, 0});
  return mesh;
}

// A point of a dangling segment where doubles are the integers. Its link has a vertex in the direction of
// every integer point nearby; those joined to one end of the segment are not joined to the other.
TEST(FictitiousCuts, ArePossibleWhereEveryDoubleLiesInTheDirectionOfALinkVertex) {
  constexpr double kFar = 0x1.8p52;
  const auto at = [](int x, int y, int z) { return Point{kFar + x, kFar + y, kFar + z}; };
  const auto ring = directions_of_grid(14);
  const auto n = static_cast<Index>(ring.size());
  std::vector<Point> points{at(0, 0, 0), at(0, 0, -1), at(0, 0, 1)};
  for (const auto& [x, y] : ring) points.push_back(at(x, y, -1));
  for (Index k = 0; k < n; ++k)
    points.push_back(at(ring[k][0] + ring[(k + 1) % n][0], ring[k][1] + ring[(k + 1) % n][1], 1));
  std::vector<Triangle> link;
  for (Index k = 0; k < n; ++k) {
    const Index low = 3 + k, next_low = 3 + (k + 1) % n, high = 3 + n + k, next_high = 3 + n + (k + 1) % n;
    link.insert(
        link.end(),
        {{1, low, next_low}, {low, high, next_low}, {next_low, high, next_high}, {2, next_high, high}});
  }
  Task t;
  t.mesh = mesh_of_ball(points, link);
  for (Triangle& f : link)
    if (t.mesh.orient(f[0], f[1], f[2], 0) < 0) std::swap(f[1], f[2]);
  t.mesh = mesh_of_ball(points, link);
  for (const Tet s : ball_of(t.mesh, 0)) {
    const auto& c = t.mesh.corners(s);
    ASSERT_GT(t.mesh.orient(c[0], c[1], c[2], c[3]), 0);
  }
  std::vector<Vertex> created;
  const auto cuts = fictitious_cuts(t.mesh, 0, {1, 2}, created);
  ASSERT_EQ(cuts.size(), 2u);
  EXPECT_FALSE(created.empty());
  expect_fictitious(t, 0, {1, 2}, cuts);
  cut_and_cone(t.mesh, 0, Ends{1, 2});
  EXPECT_NE(find_edge(t.mesh, 1, 2), kNone);
  for (const Tet s : living(t.mesh)) {
    if (t.mesh.is_ghost(s)) continue;
    const auto& c = t.mesh.corners(s);
    EXPECT_GT(t.mesh.orient(c[0], c[1], c[2], c[3]), 0);
  }
}

}  // namespace
}  // namespace holdfast::eliminate_test
