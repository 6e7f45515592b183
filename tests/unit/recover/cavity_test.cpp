// Cavities grow where they may and nowhere else.
#include "suppress/cavity.h"

#include <gtest/gtest.h>

#include "unit/suppress_scenes.h"

namespace holdfast::cavity_test {
namespace {

using namespace testing;

// --- cavities

// What no cavity may contain: a ghost, a facet with both sides in it, or an input vertex or segment with all
// tetrahedra around it.
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

// The tetrahedra that could be added, and those of them that add no new vertex.
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

}  // namespace
}  // namespace holdfast::cavity_test
