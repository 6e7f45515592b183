// Polyhedra of a mesh as separate surfaces: a filling replaces its polyhedron, and a failure changes nothing.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>
#include <tuple>
#include <utility>

#include "holdfast/holdfast.h"
#include "mesh/quality.h"
#include "mesh/validate.h"
#include "mesh_fixtures.h"
#include "optimise/badness.h"
#include "optimise/fill_anew.h"
#include "optimise/polyhedron.h"

namespace holdfast::optimise_fill_anew_test {
namespace {

using namespace testing;

constexpr BadFrom kFrom{100, 1000, 1e10};
constexpr double kTarget = 2;

// A mesh with slivers and a search for better ones, with which the test begins.
struct Searched {
  explicit Searched(std::uint64_t seed, Limits given = {}, int cubes = 3)
      : limits(std::move(given)),
        mesh(slivers(0.4, seed, cubes)),
        monitor(limits, progress),
        tets(solid(mesh)),
        search(mesh, tets, static_cast<Vertex>(mesh.vertex_count()), kTarget, seed, 1, monitor) {}

  const Limits limits;
  const std::function<bool(const Progress&)> progress;
  TetMesh mesh;
  Monitor monitor;
  std::vector<Tet> tets;
  Search search;
};

// By a separate call.
std::optional<Filling> filled(const Complex& complex, PointsOfFilling = {}) {
  const Result result = mesh(complex, Options{});
  if (result.outcome != Outcome::done) return std::nullopt;
  const auto first_added =
      result.volume.vertices.begin() + static_cast<std::ptrdiff_t>(complex.vertices.size());
  return Filling{{first_added, result.volume.vertices.end()}, result.volume.tetrahedra};
}

// Without any other condition.
Filler filler(std::function<std::optional<Filling>(const Complex&, PointsOfFilling)> fill) {
  return [fill = std::move(fill)](const ToFill& asked, const LikelyToFill&) {
    return fill(asked.polyhedron.view(), asked.points);
  };
}

// The existing tetrahedra in the numbers of the surface, whose vertices are in ascending order.
Filling as_it_is(const TetMesh& mesh, const Polyhedron& polyhedron) {
  std::vector<Vertex> vertices;
  for (const Tet t : polyhedron.tets())
    vertices.insert(vertices.end(), mesh.corners(t).begin(), mesh.corners(t).end());
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  Filling filling;
  for (const Tet t : polyhedron.tets()) {
    Tetrahedron& own = filling.tetrahedra.emplace_back();
    for (std::size_t i = 0; i < 4; ++i)
      own[i] = static_cast<Index>(std::lower_bound(vertices.begin(), vertices.end(), mesh.corners(t)[i]) -
                                  vertices.begin());
  }
  return filling;
}

TEST(Polyhedron, HasAClosedSurfaceThatFacesOutwards) {
  for (const std::size_t most : {1u, 2u, 5u, 20u, 1000u}) {
    Searched s(3);
    const Polyhedron polyhedron(s.search, {s.tets[s.tets.size() / 2]}, most);
    EXPECT_EQ(polyhedron.tets().size(), std::min(most, s.tets.size()));
    const Complex surface = polyhedron.surface();
    std::map<std::array<Index, 2>, int> sides;
    double six_volumes = 0;
    for (const Triangle& f : surface.facets) {
      for (std::size_t i = 0; i < 3; ++i) {
        const Index a = f[i], b = f[(i + 1) % 3];
        sides[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
      }
      const Point &a = surface.vertices[f[0]], &b = surface.vertices[f[1]], &c = surface.vertices[f[2]];
      six_volumes += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                     a[2] * (b[0] * c[1] - b[1] * c[0]);
    }
    for (const auto& [edge, sum] : sides) EXPECT_EQ(sum, 0);
    EXPECT_GT(six_volumes, 0);
    EXPECT_EQ(find_fault(s.mesh), "");  // no marks are left
  }
}

TEST(Polyhedron, IsFilledOnlyByItsOwnFacesAndVertices) {
  Searched s(5);
  const Polyhedron polyhedron(s.search, {s.tets.front()}, 30);
  const Filling whole = as_it_is(s.mesh, polyhedron);
  EXPECT_TRUE(polyhedron.is_filled_by(whole));
  EXPECT_EQ(polyhedron.worst(whole), polyhedron.worst());
  Filling less = whole;
  less.tetrahedra.pop_back();
  EXPECT_FALSE(polyhedron.is_filled_by(less));
  Filling more = whole;
  more.tetrahedra.push_back(more.tetrahedra.front());
  EXPECT_FALSE(polyhedron.is_filled_by(more));
  EXPECT_FALSE(polyhedron.is_filled_by(Filling{}));
}

// One of its faces may allow only worse tetrahedra.
TEST(Polyhedron, KnowsTheQualityThatItsFacesForce) {
  std::size_t yes = 0, no = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Searched s(seed);
    const Polyhedron polyhedron(s.search, {s.tets[s.tets.size() / 2]}, 12);
    const Complex surface = polyhedron.surface();
    double forced = 0;
    for (const auto& [a, b, c] : surface.facets) {
      double best = std::numeric_limits<double>::infinity();
      for (const Point& p : surface.vertices) {
        const Point &q = surface.vertices[a], &r = surface.vertices[b], &t = surface.vertices[c];
        if (exact::orient3d(q.data(), r.data(), t.data(), p.data()) < 0)
          best = std::min(best, quality(q, r, t, p));
      }
      forced = std::max(forced, best);
    }
    EXPECT_LE(forced, 1.001 * polyhedron.worst());
    EXPECT_TRUE(polyhedron.may_be_filled_below(1.001 * forced));
    EXPECT_FALSE(polyhedron.may_be_filled_below(0.999 * forced));
    ++(polyhedron.may_be_filled_below(polyhedron.worst() / 1.1) ? yes : no);
  }
  EXPECT_GT(yes, 0U);
  EXPECT_GT(no, 0U);
}

TEST(Polyhedron, RefusesInvertedTetrahedra) {
  Searched s(5);
  const Polyhedron polyhedron(s.search, {s.tets.front()}, 30);
  Filling filling = as_it_is(s.mesh, polyhedron);
  std::swap(filling.tetrahedra.back()[0], filling.tetrahedra.back()[1]);
  filling.added.push_back({0, 0, 0});
  const std::size_t vertices = s.mesh.vertex_count();
  EXPECT_FALSE(polyhedron.replace(filling));
  EXPECT_EQ(s.mesh.vertex_count(), vertices);
  EXPECT_EQ(find_fault(s.mesh), "");
}

TEST(Polyhedron, KeepsConstraintsInside) {
  Searched s(9);
  MeshEditor editor(s.mesh);
  // A facet with the polyhedron on both sides: one can walk round it.
  const Tet t = s.tets[s.tets.size() / 2];
  int side = 0;
  while (s.mesh.is_ghost(tet_of(s.mesh.neighbour(t, side)))) ++side;
  const std::array<Vertex, 3> facet = s.mesh.face_vertices(face_code(t, side));
  editor.set_facet(face_code(t, side));
  const Tet other = s.tets.front();
  const auto [a, b] = ends_of_edge(s.mesh.corners(other), 2);
  editor.set_segment(other, a, b);
  const Polyhedron polyhedron(s.search, {t}, 1000);
  const Complex surface = polyhedron.surface();
  const std::optional<Filling> filling = filled(surface);
  ASSERT_TRUE(filling);
  EXPECT_TRUE(polyhedron.is_filled_by(*filling));
  ASSERT_TRUE(polyhedron.replace(*filling));
  EXPECT_EQ(find_fault(s.mesh), "");
  const Face f = find_face(s.mesh, facet[0], facet[1], facet[2]);
  ASSERT_NE(f, kNone);
  EXPECT_TRUE(s.mesh.is_facet(f));
  const Tet holds = find_edge(s.mesh, a, b);
  ASSERT_NE(holds, kNone);
  EXPECT_TRUE(s.mesh.is_segment(holds, s.mesh.edge_of(holds, a, b)));
}

TEST(FillAnew, MakesNothingWorse) {
  int better = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Searched s(seed);
    const exact::Dyadic volume = volume_of(s.mesh);
    const std::size_t vertices = s.mesh.vertex_count();
    const Badness before = badness_of(s.mesh, s.tets, kFrom);
    fill_anew_round_the_worst(s.search, {filler(filled), 3});
    const Badness after = badness_of(s.mesh, solid(s.mesh), kFrom);
    EXPECT_LE(std::tuple(after.null, after.hopeless, after.worst),
              std::tuple(before.null, before.hopeless, before.worst))
        << seed;
    if (after.worst < before.worst) ++better;
    EXPECT_EQ(find_fault(s.mesh), "");
    EXPECT_EQ((volume_of(s.mesh) - volume).sign(), 0);
    for (Vertex v = 0; v < vertices; ++v) EXPECT_TRUE(s.mesh.in_mesh(v));
    EXPECT_EQ(s.search.stats().filled_anew > 0, after.worst < before.worst) << seed;
  }
  EXPECT_GT(better, 5);
}

// After the worst has failed, others pay only if the worst is removed with them.
TEST(FillAnew, EndsAfterOneOtherThanTheWorst) {
  std::size_t beside = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Searched s(seed);
    const auto worst = s.search.worst();
    ASSERT_TRUE(worst);
    const auto not_round_the_worst = [&](const Complex& complex, PointsOfFilling) {
      const auto has = [&](Vertex v) {
        return std::count(complex.vertices.begin(), complex.vertices.end(), s.mesh.position(v)) > 0;
      };
      const bool has_all = std::all_of(worst->corners.begin(), worst->corners.end(), has);
      return has_all ? std::nullopt : filled(complex);
    };
    fill_anew_round_the_worst(s.search, {filler(not_round_the_worst), 3});
    EXPECT_EQ(s.search.badness().worst, worst->quality);
    EXPECT_LE(s.search.stats().filled_anew, 1U) << seed;
    beside += s.search.stats().filled_anew;
  }
  EXPECT_GT(beside, 0U);
}

// A single tetrahedron cannot change.
TEST(FillAnew, LeavesForcedElements) {
  Searched s(2);
  const auto worst = s.search.worst();
  ASSERT_TRUE(worst && worst->quality > 10);
  Search search(s.mesh, {worst->tet}, static_cast<Vertex>(s.mesh.vertex_count()), kTarget, 1, 1, s.monitor);
  int calls = 0;
  const auto counting = [&](const Complex&, PointsOfFilling) -> std::optional<Filling> {
    ++calls;
    return std::nullopt;
  };
  fill_anew_round_the_worst(search, {filler(counting), 3});
  EXPECT_EQ(calls, 0);
}

TEST(FillAnew, ChangesNothingIfNothingFits) {
  const auto corners_of = [](const TetMesh& mesh) {
    std::vector<TetMesh::Corners> corners;
    for (const Tet t : solid(mesh)) corners.push_back(mesh.corners(t));
    return corners;
  };
  using Fill = std::function<std::optional<Filling>(const Complex&, PointsOfFilling)>;
  const std::vector<Fill> fills{[](const Complex&, PointsOfFilling) { return std::nullopt; },
                                [](const Complex&, PointsOfFilling) { return Filling{}; },
                                [](const Complex& complex, PointsOfFilling) {
                                  std::optional<Filling> filling = filled(complex);
                                  if (filling) filling->tetrahedra.pop_back();
                                  return filling;
                                }};
  for (const Fill& fill : fills) {
    Searched s(2);
    const std::vector<TetMesh::Corners> before = corners_of(s.mesh);
    int calls = 0;
    const auto counting = [&](const Complex& complex, PointsOfFilling points) {
      ++calls;
      return fill(complex, points);
    };
    fill_anew_round_the_worst(s.search, {filler(counting), 3});
    EXPECT_GT(calls, 0);
    EXPECT_EQ(corners_of(s.mesh), before);
  }
}

// The same with a point in the middle of the first tetrahedron, which becomes four.
Filling with_a_point(Filling filling, const Complex& complex) {
  const Tetrahedron t = filling.tetrahedra.front();
  Point middle{};
  for (const Index v : t)
    for (std::size_t k = 0; k < 3; ++k) middle[k] += complex.vertices[v][k] / 4;
  filling.added.push_back(middle);
  filling.tetrahedra.erase(filling.tetrahedra.begin());
  for (std::size_t i = 0; i < 4; ++i) {
    filling.tetrahedra.push_back(t);
    filling.tetrahedra.back()[i] = static_cast<Index>(complex.vertices.size());
  }
  return filling;
}

double worst_of(const Filling& filling, const Complex& complex) {
  std::vector<Point> points(complex.vertices.begin(), complex.vertices.end());
  points.insert(points.end(), filling.added.begin(), filling.added.end());
  double worst = 0;
  for (const Tetrahedron& t : filling.tetrahedra)
    worst = std::max(worst, quality(points[t[0]], points[t[1]], points[t[2]], points[t[3]]));
  return worst;
}

// A point must improve the quality ten times, as elsewhere.
TEST(FillAnew, AddsNoPointForALittleGain) {
  int offered = 0, better = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    Searched s(seed);
    const double before = badness_of(s.mesh, s.tets, kFrom).worst;
    const auto fill = [&](const Complex& complex, PointsOfFilling) -> std::optional<Filling> {
      std::optional<Filling> filling = filled(complex);
      if (!filling || !filling->added.empty()) return std::nullopt;
      filling = with_a_point(*filling, complex);
      const double worst = worst_of(*filling, complex);
      if (10 * worst <= before) return std::nullopt;
      ++offered;
      if (2 * worst < before) ++better;
      return filling;
    };
    fill_anew_round_the_worst(s.search, {filler(fill), 3});
    EXPECT_EQ(s.search.points_in_mesh(), 0U) << seed;
    EXPECT_EQ(find_fault(s.mesh), "");
  }
  EXPECT_GT(offered, 5);
  EXPECT_GT(better, 0);
}

// A Delaunay mesh of the rest does not need the points if elements may be bad.
TEST(FillAnew, RemovesPoints) {
  std::size_t gone = 0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    TetMesh mesh = slivers(0.2, seed, 3);
    const auto first_free = static_cast<Vertex>(mesh.vertex_count());
    for (int k = 0; k < 6; ++k) {
      MeshEditor editor(mesh);
      const std::vector<Tet> tets = solid(mesh);
      const Tet t = tets[(7 * seed + 11 * static_cast<std::size_t>(k)) % tets.size()];
      const TetMesh::Corners c = mesh.corners(t);
      Point middle{};
      for (const Vertex v : c)
        for (std::size_t i = 0; i < 3; ++i) middle[i] += mesh.position(v)[i] / 4;
      const Vertex p = editor.add_vertex(middle);
      std::vector<TetMesh::Corners> four(4, c);
      for (std::size_t i = 0; i < 4; ++i) four[i][i] = p;
      editor.replace({.old_tets = std::vector<Tet>{t}, .new_tets = four});
    }
    const exact::Dyadic volume = volume_of(mesh);
    const Limits limits;
    const std::function<bool(const Progress&)> progress;
    Monitor monitor(limits, progress);
    const std::vector<Tet> tets = solid(mesh);
    Search search(mesh, tets, first_free, kTarget, seed, 1, monitor);
    const double limit = search.worst_without_point();
    const std::size_t before = search.points_in_mesh();
    ASSERT_EQ(before, 6U);
    const auto fill = [&](const Complex& complex, PointsOfFilling points) {
      EXPECT_LT(points.most_recovered, search.points_in_mesh());
      EXPECT_FALSE(points.may_be_added);
      return filled(complex);
    };
    fill_anew_without_points(search, {filler(fill), 3});
    gone += before - search.points_in_mesh();
    EXPECT_LE(search.badness().worst, limit);
    EXPECT_EQ(find_fault(mesh), "");
    EXPECT_EQ((volume_of(mesh) - volume).sign(), 0);
    for (Vertex v = 0; v < first_free; ++v) EXPECT_TRUE(mesh.in_mesh(v));
  }
  EXPECT_GT(gone, 10U);
}

// The predicted request is mostly the next one, and predicting changes nothing.
TEST(FillAnew, PredictsTheNextRequest) {
  int likely_ones = 0, right = 0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Searched asking(seed, {}, 8), silent(seed, {}, 8);
    std::vector<ToFill> told;
    const Filler looking_ahead = [&](const ToFill& asked, const LikelyToFill& likely) {
      for (const ToFill& next : told)
        if (next.polyhedron.facets == asked.polyhedron.facets &&
            next.polyhedron.vertices == asked.polyhedron.vertices)
          ++right;
      told = likely(1);
      EXPECT_LE(told.size(), 1U);
      likely_ones += static_cast<int>(told.size());
      return filled(asked.polyhedron.view());
    };
    fill_anew_round_the_worst(asking.search, {looking_ahead, 3});
    fill_anew_round_the_worst(silent.search, {filler(filled), 3});
    EXPECT_EQ(find_fault(asking.mesh), "");  // no marks are left
    const std::vector<Tet> tets = solid(asking.mesh);
    ASSERT_EQ(tets, solid(silent.mesh)) << seed;
    for (const Tet t : tets) EXPECT_EQ(asking.mesh.corners(t), silent.mesh.corners(t)) << seed;
  }
  EXPECT_GT(right, 0);
  EXPECT_GE(likely_ones, right);
}

TEST(FillAnew, EndsIfTheCallIsCancelled) {
  Limits limits;
  limits.cancel = CancelToken();
  Searched s(4, limits);
  const auto cancelling = [&](const Complex& complex, PointsOfFilling) {
    limits.cancel->cancel();
    return filled(complex);
  };
  EXPECT_THROW(fill_anew_round_the_worst(s.search, {filler(cancelling), 3}), Interrupted);
  EXPECT_EQ(find_fault(s.mesh), "");
}

}  // namespace
}  // namespace holdfast::optimise_fill_anew_test
