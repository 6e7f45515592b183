// The undo log: random changes are undone slot by slot, including free slots and vertices.
#include "mesh/undo_log.h"

#include <gtest/gtest.h>

#include <random>

#include "mesh/assembly.h"
#include "mesh/kernel.h"
#include "mesh/traverse.h"
#include "mesh/validate.h"
#include "mesh_fixtures.h"
#include "recover/flipper.h"
#include "suppress/refill.h"
#include "suppress/shake.h"

namespace holdfast::undo_log_test {
namespace {

using namespace testing;

constexpr Vertex kPoints = 60;  // all free; the corners of a box round them come after these

TetMesh some_mesh(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> coordinate(0, 1);
  std::vector<Point> points;
  for (int k = 0; k < static_cast<int>(kPoints); ++k)
    points.push_back({coordinate(random), coordinate(random), coordinate(random)});
  return delaunay_in_box(points, 4.0);
}

// Everything that later changes can depend on; free slots by the order in which they are allocated.
void expect_same(TetMesh x, TetMesh y) {
  ASSERT_EQ(x.slot_count(), y.slot_count());
  ASSERT_EQ(x.tet_count(), y.tet_count());
  ASSERT_EQ(x.vertex_count(), y.vertex_count());
  for (Tet t = 0; t < x.slot_count(); ++t) {
    EXPECT_EQ(x.flags(t), y.flags(t));
    EXPECT_EQ(x.corners(t), y.corners(t));
    for (int i = 0; i < 4; ++i) EXPECT_EQ(x.neighbour(t, i), y.neighbour(t, i));
  }
  for (Vertex v = 0; v < x.vertex_count(); ++v) {
    EXPECT_EQ(x.position(v), y.position(v));
    EXPECT_EQ(x.incident(v), y.incident(v));
  }
  for (std::size_t k = x.slot_count() - x.tet_count() + 1; k > 0; --k)
    EXPECT_EQ(MeshAssembly(x).add_tet({0, 1, 2, 3}), MeshAssembly(y).add_tet({0, 1, 2, 3}));
}

Vertex some_vertex(const TetMesh& mesh, std::mt19937_64& random) {
  for (;;)
    if (const auto v = static_cast<Vertex>(random() % mesh.vertex_count()); mesh.in_mesh(v)) return v;
}

// Flips, and vertices that are added, moved and removed.
void change(TetMesh& mesh, std::mt19937_64& random, int times) {
  Flipper flipper(mesh, random);
  for (; times > 0; --times) {
    const Vertex v = some_vertex(mesh, random);
    shake(mesh, flipper, v, 4, random);
    const Vertex w = some_vertex(mesh, random);
    if (w >= kPoints && w < kPoints + 8) continue;
    if (random() % 2 == 0) {
      round_with_neighbours(mesh, w, 0, 3);
    } else if (refill_without(mesh, w, 0, {}, random)) {
      MeshEditor(mesh).add_vertex(Point{0.5, 0.5, 0.5});
    }
  }
}

TEST(UndoLog, RestoresEverySlot) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    TetMesh mesh = some_mesh(seed);
    std::mt19937_64 random(seed);
    change(mesh, random, 5);
    const TetMesh before = mesh;
    UndoLog log(mesh);
    const UndoLog::Mark mark = log.mark();
    change(mesh, random, 10);
    EXPECT_FALSE(log.before(mark).changed().empty());
    log.undo(mark);
    expect_same(mesh, before);
    EXPECT_TRUE(log.before(mark).changed().empty());
    log.release();
    EXPECT_EQ(find_fault(mesh), "");
  }
}

TEST(UndoLog, MarksNest) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    TetMesh mesh = some_mesh(seed);
    std::mt19937_64 random(seed);
    const TetMesh before = mesh;
    UndoLog log(mesh);
    const UndoLog::Mark outer = log.mark();
    change(mesh, random, 3);
    for (int k = 0; k < 4; ++k) {
      const TetMesh between = mesh;
      const UndoLog::Mark inner = log.mark();
      change(mesh, random, 3);
      if (k % 2 == 0) {
        log.undo(inner);
        expect_same(mesh, between);
      }
      log.release();
    }
    change(mesh, random, 3);
    log.undo(outer);
    expect_same(mesh, before);
  }
}

TEST(UndoLog, ReportsTheOriginalTetrahedra) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    TetMesh mesh = some_mesh(seed);
    std::mt19937_64 random(seed);
    const TetMesh old = mesh;
    UndoLog log(mesh);
    const UndoLog::Mark mark = log.mark();
    change(mesh, random, 10);
    const UndoLog::Before before = log.before(mark);
    std::vector<Tet> changed;
    for (Tet t = 0; t < mesh.slot_count(); ++t) {
      EXPECT_EQ(before.existed(t), t < old.slot_count());
      if (t < old.slot_count()) {
        EXPECT_EQ(before.alive(t), old.alive(t));
        EXPECT_EQ(before.corners(t), old.corners(t));
      }
      if (t >= old.slot_count() || old.alive(t) != mesh.alive(t) || old.corners(t) != mesh.corners(t))
        changed.push_back(t);
    }
    EXPECT_EQ(before.changed(), changed);
    for (Vertex v = 0; v < old.vertex_count(); ++v) EXPECT_EQ(before.position(v), old.position(v));
  }
}

TEST(UndoLog, CopiesAreNotLogged) {
  TetMesh mesh = some_mesh(1);
  UndoLog log(mesh);
  const UndoLog::Mark mark = log.mark();
  TetMesh copy = mesh;
  std::mt19937_64 random(1);
  change(copy, random, 5);
  EXPECT_TRUE(log.before(mark).changed().empty());
}

}  // namespace
}  // namespace holdfast::undo_log_test
