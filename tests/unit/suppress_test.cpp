// Suppression: what goes, what moves, what grows, each against exhaustive search; constraints never move.
#include "suppress/suppress.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <random>

#include "enforce/enforce.h"
#include "hard_surfaces.h"
#include "mesh/assembly.h"
#include "mesh/validate.h"
#include "mesh_fixtures.h"
#include "recover/recover.h"
#include "suppress/cavity.h"
#include "suppress/collapse.h"
#include "suppress/degree.h"
#include "suppress/needed.h"
#include "suppress/refill.h"
#include "suppress/shake.h"

namespace holdfast {
namespace {

using namespace testing;
using Random = std::mt19937_64;
using Faces = std::vector<FaceKey>;

// --- polyhedra

const double kMostTwist = std::acos(-1.0) / 3;

struct Polyhedron {
  TetMesh mesh;  // vertices alone
  Faces faces;   // seen positively from inside
};

// Two triangles and three quadrilaterals, bent inwards along their diagonals where twist > 0: Schönhardt's.
Polyhedron twisted_prism(double twist, double height) {
  Polyhedron prism;
  for (int k = 0; k < 6; ++k) {
    const double angle = 2 * kMostTwist * (k % 3) + (k < 3 ? 0 : twist);
    MeshEditor(prism.mesh).add_vertex(Point{std::cos(angle), std::sin(angle), k < 3 ? 0 : height});
  }
  prism.faces = {{0, 1, 2}, {3, 5, 4}};
  for (Vertex k = 0; k < 3; ++k) {
    const Vertex j = (k + 1) % 3;
    prism.faces.insert(prism.faces.end(), {{k, 3 + j, j}, {k, 3 + k, 3 + j}});
  }
  return prism;
}

// The ball of the origin among n points of the unit sphere, each then moved to a radius of its own.
Polyhedron star(int n, double least_radius, Random& random) {
  std::normal_distribution<double> normal;
  Polyhedron out;
  while (out.faces.size() != 2 * static_cast<std::size_t>(n) - 4) {  // else a box corner is in the link
    std::vector<Point> points;
    for (int k = 0; k < n; ++k) {
      const Point p{normal(random), normal(random), normal(random)};
      points.push_back(hard::scaled(p, 1 / std::hypot(p[0], p[1], p[2])));
    }
    points.push_back({0, 0, 0});
    TetMesh mesh = delaunay_in_box(points);
    out = {{}, outer_faces(mesh, ball_of(mesh, static_cast<Vertex>(n)))};
    std::uniform_real_distribution<double> radius(least_radius, 1.0);
    for (int k = 0; k < n; ++k)
      MeshEditor(out.mesh).add_vertex(
          hard::scaled(points[static_cast<std::size_t>(k)], least_radius < 1 ? radius(random) : 1));
  }
  return out;
}

FaceKey rotated(FaceKey f) {
  std::rotate(f.begin(), std::min_element(f.begin(), f.end()), f.end());
  return f;
}

// Faces that are left when those of equal corners and opposite turns have cancelled.
std::set<FaceKey> boundary_of(const std::vector<TetMesh::Corners>& tets) {
  std::set<FaceKey> open;
  for (const auto& c : tets)
    for (const auto& k : kFaceVertex) {
      const FaceKey f{c[static_cast<std::size_t>(k[0])], c[static_cast<std::size_t>(k[1])],
                      c[static_cast<std::size_t>(k[2])]};
      if (open.erase(rotated({f[0], f[2], f[1]})) == 0) open.insert(rotated(f));
    }
  return open;
}

std::set<FaceKey> as_set(const Faces& faces) {
  std::set<FaceKey> out;
  for (const FaceKey& f : faces) out.insert(rotated(f));
  return out;
}

exact::Dyadic volume_of(const Polyhedron& p) { return testing::volume_of(p.mesh, cone(p.faces, 0)); }

void expect_fills(const Polyhedron& p, const std::vector<TetMesh::Corners>& tets) {
  EXPECT_TRUE(all_positive(p.mesh, tets));
  EXPECT_EQ(boundary_of(tets), as_set(p.faces));
  EXPECT_EQ(testing::volume_of(p.mesh, tets), volume_of(p));
}

// Whether any positive tetrahedra fill the polyhedron: tries all, and stops at the polyhedron's volume alone.
bool can_be_filled(const Polyhedron& p, std::set<FaceKey> open, double room) {
  if (open.empty()) return true;
  const FaceKey f = *open.begin();
  for (Vertex v = 0; v < p.mesh.vertex_count(); ++v) {
    if (p.mesh.orient(f[0], f[1], f[2], v) <= 0) continue;
    const std::vector<TetMesh::Corners> one{{f[0], f[1], f[2], v}};
    const double left = room - testing::volume_of(p.mesh, one).to_double();
    if (left < -1e-9) continue;
    std::set<FaceKey> rest = open;
    bool simple = true;
    for (const FaceKey& own : boundary_of(one))
      if (rest.erase(own) == 0) simple = rest.insert(rotated({own[0], own[2], own[1]})).second && simple;
    if (simple && can_be_filled(p, rest, left)) return true;
  }
  return false;
}

constexpr PolyhedronOptions kExhaustive{.most_vertices = 31, .most_nodes = 1'000'000};

TEST(SmallPolyhedron, SchoenhardtsIsFilledWhereItIsConvexAndNowhereElse) {
  for (const double height : {0.1, 1.0, 7.0})
    for (const double part : {1e-9, 1e-3, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99}) {
      const Polyhedron bent_in = twisted_prism(part * kMostTwist, height);
      EXPECT_FALSE(fill_polyhedron(bent_in.mesh, bent_in.faces, kExhaustive)) << part;
      const Polyhedron convex = twisted_prism(-part * kMostTwist, height);
      const auto filling = fill_polyhedron(convex.mesh, convex.faces);
      ASSERT_TRUE(filling.has_value()) << part;
      expect_fills(convex, *filling);
    }
}

TEST(SmallPolyhedron, ConvexOnesAreFilled) {
  Random random(1);
  for (int trial = 0; trial < 40; ++trial) {
    const Polyhedron p = star(6 + trial % 11, 1, random);
    const auto filling = fill_polyhedron(p.mesh, p.faces);
    ASSERT_TRUE(filling.has_value()) << trial;
    expect_fills(p, *filling);
  }
}

TEST(SmallPolyhedron, AgreesWithAnExhaustiveSearch) {
  Random random(2);
  std::uniform_real_distribution<double> u(-1, 1);
  int filled = 0, unfillable = 0;
  for (int trial = 0; trial < 600; ++trial) {
    Polyhedron p =
        trial % 3 == 0 ? star(6 + trial / 3 % 3, 0.1, random) : twisted_prism(0.2 + 0.2 * u(random), 1);
    for (Vertex v = 0; v < p.mesh.vertex_count(); ++v) {
      Point at = p.mesh.position(v);
      for (double& x : at) x += 0.05 * u(random);
      MeshAssembly(p.mesh).place_vertex(v, at);
    }
    const auto filling = fill_polyhedron(p.mesh, p.faces, kExhaustive);
    ASSERT_EQ(filling.has_value(), can_be_filled(p, as_set(p.faces), volume_of(p).to_double())) << trial;
    if (filling) expect_fills(p, *filling);
    ++(filling ? filled : unfillable);
  }
  EXPECT_GT(filled, 100);
  EXPECT_GT(unfillable, 100);
}

TEST(SmallPolyhedron, KeepsToItsLimits) {
  Random random(3);
  const Polyhedron p = star(12, 1, random);
  EXPECT_TRUE(fill_polyhedron(p.mesh, p.faces, {.most_vertices = 12, .most_nodes = 600}));
  EXPECT_FALSE(fill_polyhedron(p.mesh, p.faces, {.most_vertices = 11, .most_nodes = 600}));
  EXPECT_FALSE(fill_polyhedron(p.mesh, p.faces, {.most_vertices = 12, .most_nodes = 2}));
}

// --- meshes with Steiner points

// Input points and a box, constraints between them, and Steiner points off every constraint.
struct Scene {
  TetMesh mesh;
  Vertex first_free = 0;
  std::set<FaceKey> facets;
  std::set<EdgeEnds> segments;
  exact::Dyadic volume;

  [[nodiscard]] std::vector<Vertex> steiner() const {
    std::vector<Vertex> out;
    for (Vertex v = first_free; v < mesh.vertex_count(); ++v)
      if (mesh.in_mesh(v)) out.push_back(v);
    return out;
  }
  void remember() {
    facets = facet_faces(mesh);
    segments = segment_edges(mesh);
    volume = testing::volume_of(mesh);
  }
  void expect_kept() const {
    ASSERT_EQ(find_fault(mesh), "");
    ASSERT_EQ(facet_faces(mesh), facets);
    ASSERT_EQ(segment_edges(mesh), segments);
    ASSERT_EQ(testing::volume_of(mesh), volume);
    const std::vector<Vertex> points = steiner();
    ASSERT_EQ(std::count_if(points.begin(), points.end(), [&](Vertex p) { return !mesh.is_explicit(p); }),
              static_cast<std::ptrdiff_t>(mesh.exact_vertex_count()));
  }
};

void constrain(TetMesh& mesh, Tet t, int face) {
  const auto [a, b, c] = mesh.face_vertices(face_code(t, face));
  MeshEditor(mesh).set_facet(face_code(t, face));
  for (const auto& e : {EdgeEnds{a, b}, EdgeEnds{b, c}, EdgeEnds{c, a}})
    MeshEditor(mesh).set_segment(t, e[0], e[1]);
}

Scene scene(std::size_t input, std::size_t steiner, double share_of_facets, std::uint64_t seed) {
  Scene s;
  std::vector<Point> points = random_points(input, seed);
  for (int k = 0; k < 8; ++k) points.push_back({k & 1 ? 3. : -3., k & 2 ? 3. : -3., k & 4 ? 3. : -3.});
  for (const Point& p : points) MeshEditor(s.mesh).add_vertex(p);
  s.first_free = static_cast<Vertex>(points.size());
  for (const Point& p : random_points(steiner, seed + 1000)) MeshEditor(s.mesh).add_vertex(p);
  EXPECT_TRUE(build_delaunay(s.mesh, {}, nullptr));
  Random random(seed);
  std::bernoulli_distribution chosen(share_of_facets), dangling(0.02);
  for (const Tet t : living(s.mesh)) {
    if (s.mesh.is_ghost(t)) continue;
    for (int i = 0; i < 4; ++i) {
      const auto [a, b, c] = s.mesh.face_vertices(face_code(t, i));
      if (std::max({a, b, c}) < s.first_free && chosen(random)) constrain(s.mesh, t, i);
      if (std::max(a, b) < s.first_free && dangling(random)) MeshEditor(s.mesh).set_segment(t, a, b);
    }
  }
  s.remember();
  return s;
}

// Off every double by a little, as the apexes of thin sectors are.
void make_exact(TetMesh& mesh, Vertex p) {
  exact::ExactPoint x = mesh.exact_position(p);
  x.c[1] += exact::Dyadic(1, -70);
  MeshEditor(mesh).move_vertex(p, x);
}

bool can_collapse(TetMesh& mesh, Vertex p) {
  const Faces faces = outer_faces(mesh, ball_of(mesh, p));
  const std::vector<Vertex> link = link_vertices(mesh, p);
  return std::any_of(link.begin(), link.end(), [&](Vertex v) { return all_positive(mesh, cone(faces, v)); });
}

TEST(RemoveOrRecentre, DoesTheFirstThatCanBeDone) {
  std::map<Fate, int> fates;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    Scene s = scene(30, 40, 0.1 * static_cast<double>(seed), seed);
    for (const Vertex p : s.steiner()) {
      make_exact(s.mesh, p);
      const bool collapsible = can_collapse(s.mesh, p);
      const Faces faces = outer_faces(s.mesh, ball_of(s.mesh, p));
      const bool fillable = fill_polyhedron(s.mesh, faces).has_value();
      const Kernel kernel = kernel_of(s.mesh, faces);
      const Fate fate = remove_or_recentre(s.mesh, p, {});
      ++fates[fate];
      EXPECT_EQ(fate, collapsible ? Fate::collapsed : fillable ? Fate::filled : Fate::moved);
      EXPECT_EQ(s.mesh.in_mesh(p), fate == Fate::moved);
      if (fate != Fate::moved) continue;
      EXPECT_TRUE(kernel.holds(s.mesh.point(p)));
      EXPECT_TRUE(s.mesh.is_explicit(p));
    }
    s.expect_kept();
  }
  EXPECT_GT(fates[Fate::collapsed], 20);
  EXPECT_GT(fates[Fate::filled], 5);
  EXPECT_GT(fates[Fate::moved], 5);
}

TEST(LowerDegree, TellsWhetherTheDegreeFell) {
  int fell = 0, four = 0, refused = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    Scene s = scene(30, 40, seed % 2 == 0 ? 1 : 0, seed);
    Random random(seed);
    Flipper flipper(s.mesh, random);
    std::vector<Vertex> twice = s.steiner();
    twice.insert(twice.end(), twice.begin(), twice.end());
    for (const Vertex p : twice) {
      const std::size_t before = link_vertices(s.mesh, p).size();
      const bool lower = lower_degree(s.mesh, flipper, p, 2, 300);
      const std::size_t after = link_vertices(s.mesh, p).size();
      ASSERT_EQ(lower, after < before);
      ++(lower ? fell : refused);
      four += after == 4 ? 1 : 0;
    }
    s.expect_kept();
  }
  EXPECT_GT(fell, 50);
  EXPECT_GT(four, 20);
  EXPECT_GT(refused, 5);
}

TEST(Shake, ChangesTheMeshRoundAPointAndNothingElse) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    Scene s = scene(30, 40, 0.25 * static_cast<double>(seed - 1), seed);
    Random random(seed);
    Flipper flipper(s.mesh, random);
    int changed = 0;
    const std::vector<Vertex> points = s.steiner();
    for (const Vertex p : points) {
      const std::vector<Vertex> before = link_vertices(s.mesh, p);
      shake(s.mesh, flipper, p, 20, random);
      changed += link_vertices(s.mesh, p) != before ? 1 : 0;
    }
    EXPECT_GT(changed, 10) << seed;
    EXPECT_EQ(s.steiner(), points);
    s.expect_kept();
  }
}

// --- cavities

// What no cavity may hold: a ghost, a facet with both sides in it, an input vertex or a segment with all
// tetrahedra round it.
bool may_be_a_cavity(TetMesh& mesh, const std::vector<Tet>& tets, Vertex first_free) {
  const auto within = [&](const std::vector<Tet>& some) {
    return std::all_of(some.begin(), some.end(),
                       [&](Tet t) { return std::find(tets.begin(), tets.end(), t) != tets.end(); });
  };
  for (const Tet t : tets) {
    if (mesh.is_ghost(t)) return false;
    for (int i = 0; i < 4; ++i)
      if (mesh.is_facet(face_code(t, i)) && within({tet_of(mesh.neighbour(t, i))})) return false;
    for (const Vertex v : mesh.corners(t))
      if (v < first_free && within(ball_of(mesh, v))) return false;
    for (int k = 0; k < 6; ++k) {
      const auto& e = kEdgeVertex[static_cast<std::size_t>(k)];
      if (mesh.is_segment(t, k) && within(shell_of(mesh, mesh.corner(t, e[0]), mesh.corner(t, e[1]))))
        return false;
    }
  }
  return true;
}

void expect_consistent(Scene& s, const Cavity& cavity) {
  EXPECT_TRUE(may_be_a_cavity(s.mesh, cavity.tets(), s.first_free));
  const Faces faces = outer_faces(s.mesh, cavity.tets());
  EXPECT_EQ(as_set(cavity.faces()), as_set(faces));
  EXPECT_EQ(cavity.faces().size(), faces.size());
  std::set<Vertex> border, all;
  for (const FaceKey& f : faces) border.insert(f.begin(), f.end());
  for (const Tet t : cavity.tets()) all.insert(s.mesh.corners(t).begin(), s.mesh.corners(t).end());
  EXPECT_EQ(cavity.vertex_count(), border.size());
  std::vector<Vertex> inner;
  std::set_difference(all.begin(), all.end(), border.begin(), border.end(), std::back_inserter(inner));
  EXPECT_EQ(cavity.inner(), inner);
}

std::vector<Tet> united(std::vector<Tet> tets, const std::vector<Tet>& more) {
  tets.insert(tets.end(), more.begin(), more.end());
  std::sort(tets.begin(), tets.end());
  tets.erase(std::unique(tets.begin(), tets.end()), tets.end());
  return tets;
}

// The tetrahedra that could be added, and those of them that bring no new vertex.
std::pair<std::set<Tet>, std::set<Tet>> possible_steps(Scene& s, const Cavity& cavity) {
  std::set<Vertex> known;
  for (const FaceKey& f : cavity.faces()) known.insert(f.begin(), f.end());
  std::pair<std::set<Tet>, std::set<Tet>> out;
  for (const Tet t : cavity.tets())
    for (int i = 0; i < 4; ++i) {
      const Tet n = tet_of(s.mesh.neighbour(t, i));
      const std::vector<Tet> bigger = united(cavity.tets(), {n});
      if (bigger.size() == cavity.tets().size() || !may_be_a_cavity(s.mesh, bigger, s.first_free)) continue;
      out.first.insert(n);
      const auto& c = s.mesh.corners(n);
      if (std::all_of(c.begin(), c.end(), [&](Vertex v) { return known.contains(v); })) out.second.insert(n);
    }
  return out;
}

TEST(Cavity, GrowsWhereItMayAndNowhereElse) {
  int grown = 0, stuck = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Scene s = scene(25, 8, 0.1 * static_cast<double>(seed), seed);
    Random random(seed);
    for (const Vertex p : s.steiner()) {
      Cavity cavity(s.mesh, ball_of(s.mesh, p), s.first_free);
      expect_consistent(s, cavity);
      for (int step = 0; step < 14; ++step) {
        const auto [possible, without_new_vertex] = possible_steps(s, cavity);
        const bool more = cavity.grow(random);
        ASSERT_EQ(more, !possible.empty());
        expect_consistent(s, cavity);
        ++(more ? grown : stuck);
        if (!more) break;
        const Tet added = cavity.tets().back();
        EXPECT_TRUE((without_new_vertex.empty() ? possible : without_new_vertex).contains(added));
      }
    }
  }
  EXPECT_GT(grown, 200);
  EXPECT_GT(stuck, 2);
}

TEST(Cavity, GrowsAcrossTheFaceNamed) {
  int grown = 0, refused = 0;
  Scene s = scene(25, 8, 0.4, 3);
  for (const Vertex p : s.steiner()) {
    const Cavity start(s.mesh, ball_of(s.mesh, p), s.first_free);
    for (std::size_t k = 0; k < start.faces().size(); ++k) {
      Cavity cavity = start;
      const bool grew = cavity.grow_across(k);
      const auto [a, b, c] = start.faces()[k];
      const std::vector<Tet> bigger = united(start.tets(), living_with(s.mesh, {a, b, c}));
      ASSERT_EQ(grew, may_be_a_cavity(s.mesh, bigger, s.first_free));
      EXPECT_EQ(united(cavity.tets(), {}), grew ? bigger : united(start.tets(), {}));
      ++(grew ? grown : refused);
    }
  }
  EXPECT_GT(grown, 20);
  EXPECT_GT(refused, 5);
}

TEST(Cavity, SwallowsAllOfABallOrNothing) {
  int swallowed = 0, refused = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    Scene s = scene(25, 25, seed % 2 == 0 ? 0.3 : 1, seed);
    for (const Vertex p : s.steiner())
      for (const Vertex q : link_vertices(s.mesh, p)) {
        if (q < s.first_free) continue;
        Cavity cavity(s.mesh, ball_of(s.mesh, p), s.first_free);
        const std::vector<Tet> before = cavity.tets(), both = united(before, ball_of(s.mesh, q));
        const bool done = cavity.swallow(ball_of(s.mesh, q));
        ASSERT_EQ(done, may_be_a_cavity(s.mesh, both, s.first_free));
        EXPECT_EQ(united(cavity.tets(), {}), done ? both : united(before, {}));
        expect_consistent(s, cavity);
        ++(done ? swallowed : refused);
      }
  }
  EXPECT_GT(swallowed, 50);
  EXPECT_GT(refused, 5);
}

// --- filling again

// Runs an operation on the Steiner points of some scenes; where it fails, nothing may have changed.
void expect_all_or_nothing(const std::function<bool(Scene&, Vertex, Random&)>& operation) {
  int done = 0, failed = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    Scene s = scene(30, 30, seed % 2 == 0 ? 0.3 : 1, seed);
    Random random(seed);
    for (const Vertex p : s.steiner()) make_exact(s.mesh, p);
    for (const Vertex p : s.steiner()) {
      if (!s.mesh.in_mesh(p)) continue;
      const TetMesh before = s.mesh;
      const bool success = operation(s, p, random);
      ++(success ? done : failed);
      EXPECT_TRUE(success || difference(s.mesh, before).empty());
      s.expect_kept();
    }
  }
  EXPECT_GT(done, 20);
  EXPECT_GT(failed, 5);
}

TEST(RefillWithout, RemovesThePointOrChangesNothing) {
  expect_all_or_nothing([](Scene& s, Vertex p, Random& random) {
    const bool done = refill_without(s.mesh, p, s.first_free, {.attempts = 1, .steps = 1}, random);
    EXPECT_EQ(done, !s.mesh.in_mesh(p));
    return done;
  });
}

TEST(Merge, RemovesTheNeighbourOrBothOrChangesNothing) {
  int one = 0, both = 0;
  expect_all_or_nothing([&](Scene& s, Vertex p, Random& random) {
    const PolyhedronOptions search{.most_vertices = random() % 2 == 0 ? 4u : 20u, .most_nodes = 200};
    for (const Vertex q : link_vertices(s.mesh, p)) {
      if (q < s.first_free) continue;
      const bool done = merge(s.mesh, p, q, s.first_free, 4, search);
      const bool stays = s.mesh.in_mesh(p);
      EXPECT_EQ(done, !s.mesh.in_mesh(q));
      EXPECT_TRUE(done ? !stays || s.mesh.is_explicit(p) : stays);
      one += done && stays ? 1 : 0;
      both += stays ? 0 : 1;
      return done;
    }
    return false;
  });
  EXPECT_GT(one, 5);
  EXPECT_GT(both, 5);
}

// A Steiner point in a tetrahedron one unit in the last place thick: no double lies inside.
Scene sliver(bool closed_off) {
  Scene s;
  const double above = std::nextafter(1.0, 2.0);
  const std::vector<Point> points{{1, 0, 1}, {0, 1, above}, {-1, 0, 1}, {0, -1, above}};
  s.mesh = delaunay_in_box(points, 4);
  s.first_free = static_cast<Vertex>(s.mesh.vertex_count());
  const std::vector<Tet> thin = living_with(s.mesh, {0, 1, 2, 3});
  EXPECT_EQ(thin.size(), 1u);
  if (closed_off)
    for (int i = 0; i < 4; ++i) constrain(s.mesh, thin[0], i);
  const Vertex p = MeshEditor(s.mesh).add_vertex(
      exact::ExactPoint{{0.0, 0.0, exact::Dyadic(1.0) + exact::Dyadic(1, -53)}});
  const std::vector<TetMesh::Corners> fresh = cone(outer_faces(s.mesh, thin), p);
  MeshEditor(s.mesh).replace({.old_tets = thin, .new_tets = fresh});
  s.remember();
  return s;
}

TEST(RoundWithNeighbours, GrowsTheBallUntilADoubleFits) {
  Scene s = sliver(false);
  const Vertex p = s.first_free;
  ASSERT_FALSE(s.mesh.is_explicit(p));
  const TetMesh before = s.mesh;
  EXPECT_FALSE(round_with_neighbours(s.mesh, p, s.first_free, 0));
  EXPECT_EQ(difference(s.mesh, before), "");
  EXPECT_TRUE(round_with_neighbours(s.mesh, p, s.first_free, 30));
  EXPECT_TRUE(s.mesh.is_explicit(p));
  EXPECT_GT(ball_of(s.mesh, p).size(), 4u);
  s.expect_kept();
}

TEST(RoundWithNeighbours, NeverGrowsAcrossAFacet) {
  Scene s = sliver(true);
  const TetMesh before = s.mesh;
  EXPECT_FALSE(round_with_neighbours(s.mesh, s.first_free, s.first_free, 30));
  EXPECT_EQ(difference(s.mesh, before), "");
  s.expect_kept();
}

// --- all of it

SuppressStats suppress_all(Scene& s) {
  const Options options;
  Monitor monitor(options);
  const std::size_t before = s.steiner().size();
  const SuppressStats stats = suppress(s.mesh, s.steiner(), s.first_free, monitor);
  s.expect_kept();
  EXPECT_EQ(stats.left, s.steiner().size());
  EXPECT_EQ(stats.collapsed + stats.filled + stats.merged + stats.left, before);
  EXPECT_EQ(stats.unrounded, s.mesh.exact_vertex_count());
  return stats;
}

TEST(Suppress, LeavesFewPointsAndAllInDoubles) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Scene s = scene(40, 60, 0.25 * static_cast<double>(seed - 1), seed);
    for (const Vertex p : s.steiner()) make_exact(s.mesh, p);
    const SuppressStats stats = suppress_all(s);
    EXPECT_EQ(stats.left, 0u) << seed;
    EXPECT_EQ(stats.unrounded, 0u) << seed;
  }
  Scene thin = sliver(true);
  EXPECT_EQ(suppress_all(thin).left, 0u);
}

// The mesh of a surface in a box, by partition and elimination.
Scene enforced(const std::vector<Point>& points, const std::vector<Triangle>& facets, std::uint64_t seed) {
  Scene s;
  s.mesh = delaunay_in_box(points, 40);
  s.first_free = static_cast<Vertex>(s.mesh.vertex_count());
  const SegmentTable table = segment_table({points, facets, {}, {}, {}});
  Standing standing = mark_present(s.mesh, table);
  const Options options;
  Monitor monitor(options);
  enforce(s.mesh, table, facets, standing, s.first_free, {.seed = seed, .flips = false}, monitor);
  EXPECT_EQ(facet_faces(s.mesh).size(), facets.size());
  s.remember();
  return s;
}

Scene enforced(const Polyhedron& p) {
  return enforced({p.mesh.positions().begin(), p.mesh.positions().end()}, p.faces, 1);
}

TEST(Suppress, MergesPointsOfChazellesPolyhedron) {
  const Surface surface = hard::chazelle(3);
  std::size_t merged = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    Scene s = enforced(surface.vertices, surface.facets, seed);
    const SuppressStats stats = suppress_all(s);
    merged += stats.merged;
    EXPECT_EQ(stats.unrounded, 0u);
  }
  EXPECT_GT(merged, 0u);
}

TEST(Suppress, LeavesSchoenhardtOnePointThatItNeeds) {
  for (const double part : {0.1, 0.5, 0.9}) {
    Scene bent_in = enforced(twisted_prism(part * kMostTwist, 1));
    EXPECT_EQ(suppress_all(bent_in).left, 1u) << part;
    EXPECT_EQ(bent_in.mesh.exact_vertex_count(), 0u);
    Scene convex = enforced(twisted_prism(-part * kMostTwist, 1));
    EXPECT_EQ(suppress_all(convex).left, 0u) << part;
  }
}

// Meshes a convex prism from a point in its middle.
Vertex add_centre(Scene& prism) {
  std::vector<Tet> inside = living(prism.mesh);
  std::erase_if(inside, [&](Tet t) {
    const auto& c = prism.mesh.corners(t);
    return std::any_of(c.begin(), c.end(), [](Vertex v) { return v >= 6; });
  });
  const Vertex p = MeshEditor(prism.mesh).add_vertex(Point{0, 0, 0.5});
  const auto fresh = cone(outer_faces(prism.mesh, inside), p);
  MeshEditor(prism.mesh).replace({.old_tets = inside, .new_tets = fresh});
  return p;
}

TEST(IsNeeded, IsProvenOfSchoenhardtsPointAndOfNoneThatCanGo) {
  for (const double part : {0.1, 0.5, 0.9}) {
    Scene bent_in = enforced(twisted_prism(part * kMostTwist, 1));
    suppress_all(bent_in);
    ASSERT_EQ(bent_in.steiner().size(), 1u);
    EXPECT_TRUE(is_needed(bent_in.mesh, bent_in.steiner()[0], bent_in.first_free)) << part;
    bent_in.expect_kept();
    Scene convex = enforced(twisted_prism(-part * kMostTwist, 1));
    EXPECT_FALSE(is_needed(convex.mesh, add_centre(convex), convex.first_free)) << part;
    EXPECT_EQ(suppress_all(convex).left, 0u);
  }
}

// A filling would have to keep a segment inside: then nothing is proven.
TEST(IsNeeded, IsNotSaidWhereAConstraintStandsInside) {
  Scene s = enforced(twisted_prism(0.5 * kMostTwist, 1));
  suppress_all(s);
  const Vertex p = s.steiner().at(0);
  const Tet t = s.mesh.incident(p);
  const int i = s.mesh.index_of(t, p);
  const Vertex q = s.mesh.corner(t, (i + 1) % 4);
  MeshEditor(s.mesh).set_segment(t, p, q);
  EXPECT_FALSE(is_needed(s.mesh, p, s.first_free));
}

TEST(Suppress, StopsWhenToldToWithAValidMesh) {
  Scene s = scene(40, 60, 0.5, 9);
  Options options;
  options.time_limit = 1e-9;
  Monitor monitor(options);
  EXPECT_THROW(suppress(s.mesh, s.steiner(), s.first_free, monitor), Interrupted);
  s.expect_kept();
}

}  // namespace
}  // namespace holdfast
