// Signs and costs among the vertices of a shell agree with those of the mesh, however they are computed.
#include "recover/shell_signs.h"

#include <gtest/gtest.h>

#include <random>

#include "mesh/editor.h"
#include "mesh_fixtures.h"
#include "recover/shell_costs.h"

namespace holdfast::shell_signs_test {
namespace {

using namespace testing;

template <typename Visit>
void for_each_shell(const TetMesh& mesh, Visit&& visit) {
  EdgeShell shell;
  for (const Tet t : solid(mesh))
    for (int k = 0; k < 6; ++k) {
      const auto [a, b] = ends_of_edge(mesh.corners(t), k);
      if (gather_shell(mesh, t, a, b, shell)) visit(shell);
    }
}

// Counts the corners that see both ends, and those that do not.
struct Seen {
  std::size_t yes = 0, no = 0;
};

Seen compare_ears(const TetMesh& mesh) {
  Seen seen;
  ShellSigns signs(mesh);
  for_each_shell(mesh, [&](const EdgeShell& shell) {
    signs.set(shell);
    const ShellEars ears = signs.ears();
    const std::size_t n = shell.size();
    EXPECT_EQ((ears.see_a | ears.see_b) >> n, 0U);
    for (std::size_t i = 0; i < n; ++i) {
      const Vertex before = shell.link[(i + n - 1) % n], p = shell.link[i], after = shell.link[(i + 1) % n];
      EXPECT_EQ((ears.see_a >> i & 1) != 0, mesh.orient(before, p, after, shell.a) < 0);
      EXPECT_EQ((ears.see_b >> i & 1) != 0, mesh.orient(before, p, after, shell.b) > 0);
      ++(ears.sees_both(i) ? seen.yes : seen.no);
      for (std::size_t k = 0; k < i; ++k)
        for (std::size_t j = 0; j < k; ++j)
          EXPECT_EQ(signs.sees_both(j, k, i), sees_both_ends(mesh, shell, j, k, i));
    }
  });
  return seen;
}

TEST(ShellSigns, AreThoseOfTheMesh) {
  for (const double jitter : {0.0, 1e-15, 0.3}) {
    const Seen seen = compare_ears(slivers(jitter, 3));
    EXPECT_GT(seen.yes, 100U);
    EXPECT_GT(seen.no, 100U);
  }
}

// Floating point alone would replace such a vertex by the double next to it.
TEST(ShellSigns, AreThoseOfExactVertices) {
  TetMesh mesh = slivers(0, 4);
  const exact::Dyadic tiny(1, -90);
  for (Vertex v = 0; v < 64; v += 3) {
    exact::ExactPoint p = mesh.exact_position(v);
    for (std::size_t k = 0; k < 3; ++k) p.c[k] = (v + k) % 2 == 0 ? p.c[k] + tiny : p.c[k] - tiny;
    MeshEditor(mesh).move_vertex(v, p);
  }
  ASSERT_GT(mesh.exact_vertex_count(), 10U);
  compare_ears(mesh);
}

TEST(ShellSigns, KnowTheBox) {
  const TetMesh mesh = slivers(0.3, 5);
  ShellSigns signs(mesh);
  for_each_shell(mesh, [&](const EdgeShell& shell) {
    signs.set(shell);
    Point low = mesh.position(shell.a), high = low;
    const auto take = [&](Vertex v) {
      for (std::size_t k = 0; k < 3; ++k) {
        low[k] = std::min(low[k], mesh.position(v)[k]);
        high[k] = std::max(high[k], mesh.position(v)[k]);
      }
    };
    take(shell.b);
    for (const Vertex v : shell.link) take(v);
    EXPECT_EQ(signs.low(), low);
    EXPECT_EQ(signs.high(), high);
  });
}

void compare_costs(const TetMesh& mesh, const EdgeShell& shell, const Target& target, int& sum) {
  ShellCosts costs(mesh, shell, target);
  const std::size_t n = shell.size();
  const auto vertex = [&](std::size_t i) { return i < n ? shell.link[i] : i == n ? shell.a : shell.b; };
  for (std::size_t i = 0; i < n + 2; ++i)
    for (std::size_t k = 0; k < i; ++k) {
      EXPECT_EQ(costs.edge(i, k), target.edge(mesh, vertex(i), vertex(k)));
      for (std::size_t j = 0; j < k; ++j) {
        EXPECT_EQ(costs.face(i, k, j), target.face(mesh, vertex(i), vertex(k), vertex(j)));
        sum += costs.edge(i, k) + costs.face(i, k, j);
      }
    }
  EXPECT_EQ(costs.edge(costs.a(), costs.b()), target.edge(mesh, shell.a, shell.b));
}

TEST(ShellCosts, AreThoseOfTheTarget) {
  for (const double jitter : {0.0, 0.3}) {
    const TetMesh mesh = slivers(jitter, 6, 3);
    std::mt19937_64 random(1);
    const auto any = [&] { return static_cast<Vertex>(random() % 27); };
    int of_segments = 0, of_facets = 0;
    for_each_shell(mesh, [&](const EdgeShell& shell) {
      const Vertex a = any(), b = any(), c = any();
      if (a == b || b == c || c == a) return;
      compare_costs(mesh, shell, Target::segment(a, b), of_segments);
      compare_costs(mesh, shell, Target::facet({a, b, c}), of_facets);
    });
    EXPECT_GT(of_segments, 100);
    EXPECT_GT(of_facets, 100);
  }
}

}  // namespace
}  // namespace holdfast::shell_signs_test
