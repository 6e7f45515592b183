// Replacement of cavities: what it keeps, what it adds, and what it refuses without any change.
#include <gtest/gtest.h>

#include <functional>
#include <optional>
#include <random>
#include <stdexcept>

#include "mesh/assembly.h"
#include "mesh/edge_removal.h"
#include "mesh/validate.h"
#include "mesh_fixtures.h"
#include "refine/point_cavity.h"

namespace holdfast::mesh_replace_test {
namespace {

using namespace testing;
using Random = std::mt19937_64;

struct Plan {
  std::vector<Tet> old_tets;
  std::vector<TetMesh::Corners> new_tets;
  std::vector<FaceKey> facets = {};
  std::vector<EdgeEnds> segments = {};

  [[nodiscard]] Replacement view() const { return {old_tets, new_tets, facets, segments}; }
};

Tet random_tet(const TetMesh& mesh, Random& random) {
  for (;;) {
    const auto t = static_cast<Tet>(random() % mesh.slot_count());
    if (mesh.alive(t) && !mesh.is_ghost(t)) return t;
  }
}

// The 2-3 flip of a face, where its edge passes through the face's inside.
std::optional<Plan> face_flip(const TetMesh& mesh, Face f) {
  const Face g = mesh.neighbour(f);
  if (mesh.is_ghost(tet_of(f)) || mesh.is_ghost(tet_of(g))) return std::nullopt;
  const auto [a, b, c] = mesh.face_vertices(f);
  const Vertex d = mesh.apex(f), e = mesh.apex(g);
  Plan plan{{tet_of(f), tet_of(g)}, {{a, b, e, d}, {b, c, e, d}, {c, a, e, d}}};
  if (!all_positive(mesh, plan.new_tets)) return std::nullopt;
  return plan;
}

// The 3-2 flip of an edge, or any other triangulation of its link with positive tetrahedra, by fans.
std::optional<Plan> edge_flip(const TetMesh& mesh, Tet t, int edge, Random& random) {
  const auto& e = kEdgeVertex[static_cast<std::size_t>(edge)];
  EdgeShell shell;
  if (!gather_shell(mesh, t, mesh.corner(t, e[0]), mesh.corner(t, e[1]), shell, 8)) return std::nullopt;
  const std::size_t n = shell.size();
  std::rotate(shell.link.begin(), shell.link.begin() + static_cast<std::ptrdiff_t>(random() % n),
              shell.link.end());
  std::vector<LinkTriangle> fan;
  for (std::size_t k = 1; k + 1 < n; ++k)
    fan.push_back({0, static_cast<std::uint8_t>(k), static_cast<std::uint8_t>(k + 1)});
  Plan plan{shell.tets, {}};
  tetrahedra_of(shell, fan, plan.new_tets);
  if (!all_positive(mesh, plan.new_tets)) return std::nullopt;
  return plan;
}

// A new vertex inside a tetrahedron or a face.
Plan split(TetMesh& mesh, Tet t, int corners) {
  Point p{};
  for (int i = 0; i < corners; ++i)
    for (std::size_t k = 0; k < 3; ++k) p[k] += mesh.position(mesh.corner(t, i))[k] / corners;
  Plan plan{{t}, {}};
  if (corners == 3) plan.old_tets.push_back(tet_of(mesh.neighbour(t, 3)));
  plan.new_tets = cone(outer_faces(mesh, plan.old_tets), MeshEditor(mesh).add_vertex(p));
  return plan;
}

// The constraints inside a cavity, which its replacement removes.
bool holds_constraints(const TetMesh& mesh, const Plan& plan) {
  std::set<FaceKey> new_faces;
  std::set<EdgeEnds> new_edges;
  for (const auto& c : plan.new_tets) {
    for (const auto& k : kFaceVertex)
      new_faces.insert(sorted(FaceKey{c[static_cast<std::size_t>(k[0])], c[static_cast<std::size_t>(k[1])],
                                      c[static_cast<std::size_t>(k[2])]}));
    for (const auto& e : kEdgeVertex)
      new_edges.insert(
          sorted(EdgeEnds{c[static_cast<std::size_t>(e[0])], c[static_cast<std::size_t>(e[1])]}));
  }
  for (const Tet t : plan.old_tets) {
    for (int i = 0; i < 4; ++i)
      if (mesh.is_facet(face_code(t, i)) && !new_faces.contains(sorted(mesh.face_vertices(face_code(t, i)))))
        return true;
    for (int k = 0; k < 6; ++k) {
      const auto& e = kEdgeVertex[static_cast<std::size_t>(k)];
      if (mesh.is_segment(t, k) &&
          !new_edges.contains(sorted(EdgeEnds{mesh.corner(t, e[0]), mesh.corner(t, e[1])})))
        return true;
    }
  }
  return false;
}

void constrain_at_random(TetMesh& mesh, Random& random, int count) {
  for (int k = 0; k < count; ++k) {
    const Tet t = random_tet(mesh, random);
    MeshEditor(mesh).set_facet(face_code(t, static_cast<int>(random() % 4)));
    const auto& e = kEdgeVertex[random() % 6];
    const Tet s = random_tet(mesh, random);
    MeshEditor(mesh).set_segment(s, mesh.corner(s, e[0]), mesh.corner(s, e[1]));
  }
}

// Compares everything that counts: the contents, and their slots.
void expect_same(const TetMesh& mesh, const TetMesh& other) {
  ASSERT_EQ(mesh.slot_count(), other.slot_count());
  for (Tet t = 0; t < mesh.slot_count(); ++t) {
    ASSERT_EQ(mesh.flags(t), other.flags(t));
    if (!mesh.alive(t)) continue;
    ASSERT_EQ(mesh.corners(t), other.corners(t));
    for (int i = 0; i < 4; ++i) ASSERT_EQ(mesh.neighbour(t, i), other.neighbour(t, i));
  }
  for (Vertex v = 0; v < mesh.vertex_count(); ++v) ASSERT_EQ(mesh.incident(v), other.incident(v));
}

// A random triangulation of a polygon with the corners from..to.
void triangulate(std::uint8_t from, std::uint8_t to, Random& random, std::vector<LinkTriangle>& out) {
  if (to - from < 2) return;
  const auto apex = static_cast<std::uint8_t>(from + 1 + random() % static_cast<unsigned>(to - from - 1));
  out.push_back({from, apex, to});
  triangulate(from, apex, random, out);
  triangulate(apex, to, random, out);
}

TEST(Replace, AShellAsAnyOtherCavity) {
  TetMesh mesh = delaunay_in_box(random_points(120, 5));
  Random random(5);
  constrain_at_random(mesh, random, 150);
  int flips = 0, large = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    const Tet t = random_tet(mesh, random);
    const auto& e = kEdgeVertex[random() % 6];
    EdgeShell shell;
    if (!gather_shell(mesh, t, mesh.corner(t, e[0]), mesh.corner(t, e[1]), shell)) continue;
    std::vector<LinkTriangle> triangles;
    triangulate(0, static_cast<std::uint8_t>(shell.size() - 1), random, triangles);
    Plan plan{shell.tets, {}};
    tetrahedra_of(shell, triangles, plan.new_tets);
    if (!all_positive(mesh, plan.new_tets) || holds_constraints(mesh, plan)) continue;
    TetMesh other = mesh;
    std::vector<Tet> created, created_there;
    MeshEditor(other).replace({.old_tets = shell.tets, .new_tets = plan.new_tets}, &created_there);
    MeshEditor(mesh).replace_shell(shell, triangles, &created);
    ASSERT_EQ(created, created_there);
    expect_same(mesh, other);
    ++flips;
    large += shell.size() > 4;
  }
  EXPECT_EQ(find_fault(mesh), "");
  EXPECT_GT(flips, 100);
  EXPECT_GT(large, 20);
}

TEST(Replace, ASwappedFaceAsAnyOtherCavity) {
  TetMesh mesh = delaunay_in_box(random_points(120, 6));
  Random random(6);
  constrain_at_random(mesh, random, 150);
  int flips = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const Face f = face_code(random_tet(mesh, random), static_cast<int>(random() % 4));
    const std::optional<Plan> plan = face_flip(mesh, f);
    if (!plan || holds_constraints(mesh, *plan)) continue;
    TetMesh other = mesh;
    std::vector<Tet> created;
    MeshEditor(other).replace({.old_tets = plan->old_tets, .new_tets = plan->new_tets}, &created);
    const auto tets = MeshEditor(mesh).swap_face(f);
    ASSERT_EQ(created, std::vector<Tet>(tets.begin(), tets.end()));
    expect_same(mesh, other);
    ++flips;
  }
  EXPECT_EQ(find_fault(mesh), "");
  EXPECT_GT(flips, 100);
}

// The centre of a star keeps another of its tetrahedra.
TEST(Replace, AStarAsAnyOtherCavity) {
  TetMesh mesh = delaunay_in_box(random_points(60, 9));
  Random random(9);
  constrain_at_random(mesh, random, 20);
  int inserted = 0;
  for (const Point& x : random_points(300, 10)) {
    const Vertex p = MeshEditor(mesh).add_vertex(x);
    TetMesh other = mesh;
    PointCavity cavity(mesh);
    if (!cavity.find(p, cavity.locate(p, mesh.incident(0)), Frame())) {
      MeshEditor(mesh).remove_last_vertex();
      continue;
    }
    std::vector<TetMesh::Corners> star;
    for (const RimFace& rim : cavity.rim()) star.push_back({rim.v[0], rim.v[1], rim.v[2], p});
    std::vector<Tet> created;
    MeshEditor(other).replace({.old_tets = cavity.tets(), .new_tets = star}, &created);
    cavity.insert();
    ASSERT_EQ(created, std::vector<Tet>(cavity.created().begin(), cavity.created().end()));
    ASSERT_EQ(mesh.incident(p), created.front());
    MeshAssembly(other).set_incident(p, created.front());
    expect_same(mesh, other);
    ++inserted;
  }
  EXPECT_EQ(find_fault(mesh), "");
  EXPECT_GT(inserted, 200);
}

TEST(Replace, RandomFlipsKeepTheMeshAndItsConstraints) {
  Random random(3);
  TetMesh mesh = delaunay_in_box(random_points(80, 3));
  constrain_at_random(mesh, random, 25);
  const std::set<FaceKey> facets = facet_faces(mesh);
  const std::set<EdgeEnds> segments = segment_edges(mesh);
  const exact::Dyadic volume = volume_of(mesh);
  int flips[3] = {0, 0, 0};
  for (int step = 0; step < 3000; ++step) {
    const Tet t = random_tet(mesh, random);
    const std::size_t kind = step % 10 == 9 ? 2 : static_cast<std::size_t>(step) % 2;
    std::optional<Plan> plan;
    if (kind == 0) plan = face_flip(mesh, face_code(t, static_cast<int>(random() % 4)));
    if (kind == 1) plan = edge_flip(mesh, t, static_cast<int>(random() % 6), random);
    if (kind == 2) plan = split(mesh, t, 4);
    if (!plan || !all_positive(mesh, plan->new_tets) || holds_constraints(mesh, *plan)) continue;
    MeshEditor(mesh).replace(plan->view());
    ++flips[kind];
    if (step % 50 == 0) {
      ASSERT_EQ(find_fault(mesh), "") << step;
    }
  }
  for (const int n : flips) EXPECT_GT(n, 100);
  EXPECT_EQ(find_fault(mesh), "");
  EXPECT_EQ(facet_faces(mesh), facets);
  EXPECT_EQ(segment_edges(mesh), segments);
  EXPECT_EQ(volume_of(mesh), volume);
}

TEST(Replace, AddsTheConstraintsNamed) {
  TetMesh mesh = delaunay_in_box(random_points(40, 5));
  Random random(5);
  Plan plan = split(mesh, random_tet(mesh, random), 4);
  const auto [a, b, c, p] = plan.new_tets[0];
  plan.facets = {{p, b, a}};
  plan.segments = {{c, p}, {p, a}};
  std::vector<Tet> created;
  MeshEditor(mesh).replace(plan.view(), &created);
  EXPECT_EQ(find_fault(mesh), "");
  EXPECT_EQ(facet_faces(mesh), (std::set<FaceKey>{sorted(FaceKey{a, b, p})}));
  EXPECT_EQ(segment_edges(mesh), (std::set<EdgeEnds>{sorted(EdgeEnds{c, p}), sorted(EdgeEnds{a, p})}));
  ASSERT_EQ(created.size(), plan.new_tets.size());
  for (std::size_t k = 0; k < created.size(); ++k) EXPECT_EQ(mesh.corners(created[k]), plan.new_tets[k]);
}

// A constraint in the way of a replacement is removed: its bits must not stay anywhere.
TEST(Replace, DropsConstraintsThatNoLongerStand) {
  TetMesh mesh = delaunay_in_box(random_points(40, 6));
  Random random(6);
  for (int tries = 0; tries < 1000; ++tries) {
    const Face f = face_code(random_tet(mesh, random), static_cast<int>(random() % 4));
    const auto plan = face_flip(mesh, f);
    if (!plan) continue;
    MeshEditor(mesh).set_facet(f);
    EXPECT_EQ(facet_faces(mesh).size(), 1u);
    MeshEditor(mesh).replace(plan->view());
    EXPECT_EQ(facet_faces(mesh).size(), 0u);
    EXPECT_EQ(find_fault(mesh), "");
    return;
  }
  FAIL() << "no face can be flipped";
}

TEST(Replace, AVertexThatLosesItsBallIsInNoTetrahedron) {
  const std::vector<Point> points = random_points(60, 7);
  TetMesh mesh = delaunay_in_box(points);
  const std::size_t slots = mesh.slot_count();
  const std::size_t finite = mesh.tet_count();
  Random random(7);
  Plan plan = split(mesh, random_tet(mesh, random), 4);
  const Vertex p = plan.new_tets[0][3];
  const TetMesh::Corners before = mesh.corners(plan.old_tets[0]);
  MeshEditor(mesh).replace(plan.view());
  EXPECT_TRUE(mesh.in_mesh(p));
  EXPECT_EQ(mesh.tet_count(), finite + 3);
  MeshEditor(mesh).replace(Plan{ball_of(mesh, p), {before}}.view());
  EXPECT_FALSE(mesh.in_mesh(p));
  EXPECT_EQ(mesh.tet_count(), finite);
  EXPECT_LE(mesh.slot_count(), slots + 4);
  EXPECT_EQ(find_fault(mesh), "");
}

// A plan that fits, spoilt in one place.
struct Spoiler {
  const char* name;
  std::function<void(const TetMesh&, Plan&)> spoil;
};

const Spoiler kSpoilers[] = {
    {"one missing", [](const TetMesh&, Plan& p) { p.new_tets.pop_back(); }},
    {"none at all", [](const TetMesh&, Plan& p) { p.new_tets.clear(); }},
    {"one twice", [](const TetMesh&, Plan& p) { p.new_tets.push_back(p.new_tets[0]); }},
    {"a face too many", [](const TetMesh& m, Plan& p) { p.new_tets.push_back(m.corners(p.old_tets[0])); }},
    {"another vertex", [](const TetMesh&, Plan& p) { p.new_tets[0][0] = p.new_tets[0][0] == 0 ? 1 : 0; }},
    {"an old one kept", [](const TetMesh&, Plan& p) { p.old_tets.pop_back(); }},
    {"an old one too many",
     [](const TetMesh& m, Plan& p) {
       for (const Tet t : living(m))
         if (std::find(p.old_tets.begin(), p.old_tets.end(), t) == p.old_tets.end()) {
           p.old_tets.push_back(t);
           return;
         }
     }},
    {"nothing old", [](const TetMesh&, Plan& p) { p.old_tets.clear(); }},
};

TEST(Replace, RefusesACavityThatIsNotFilledAndChangesNothing) {
  Random random(8);
  TetMesh mesh = delaunay_in_box(random_points(50, 8));
  constrain_at_random(mesh, random, 10);
  for (int k = 0; k < 20; ++k) {
    MeshEditor(mesh).replace(split(mesh, random_tet(mesh, random), 4).view());
    const Vertex p = static_cast<Vertex>(mesh.vertex_count() - 1);
    // A free slot or two, and a vertex at an exact position.
    exact::ExactPoint elsewhere = mesh.exact_position(p);
    elsewhere.c[0] += exact::Dyadic(1, -80);
    MeshEditor(mesh).move_vertex(p, elsewhere);
    std::vector<Plan> plans{split(mesh, random_tet(mesh, random), 4)};
    for (int tries = 0; tries < 100; ++tries) {
      const Tet t = random_tet(mesh, random);
      if (const auto plan = face_flip(mesh, face_code(t, tries % 4))) plans.push_back(*plan);
      if (const auto plan = edge_flip(mesh, t, tries % 6, random)) plans.push_back(*plan);
    }
    for (const Plan& good : plans)
      for (const Spoiler& spoiler : kSpoilers) {
        Plan bad = good;
        spoiler.spoil(mesh, bad);
        const TetMesh before = mesh;
        std::vector<Tet> created;
        EXPECT_THROW(MeshEditor(mesh).replace(bad.view(), &created), std::logic_error) << spoiler.name;
        ASSERT_EQ(difference(mesh, before), "") << spoiler.name;
      }
    MeshEditor(mesh).replace(plans[0].view());  // the plan without the fault still fits
    ASSERT_EQ(find_fault(mesh), "");
  }
}

}  // namespace
}  // namespace holdfast::mesh_replace_test
