#include "recover/flipper.h"

#include <algorithm>
#include <array>
#include <bit>
#include <optional>

#include "mesh/editor.h"
#include "numbers/random.h"
#include "recover/shell_costs.h"
#include "recover/tuning.h"

namespace holdfast {

// Costs a triangulated link by the crossings of the target that it makes; among equals, the fewest edges at
// the avoided vertex.
class Flipper::ForTarget {
 public:
  using Cost = int;
  static constexpr int kWeight = 64;  // of a crossing: more than the diagonals of any link

  ForTarget(const TetMesh& mesh, const EdgeShell& shell, const ShellEars& ears, const ShellSigns& signs,
            const Target& target, Vertex avoided)
      : shell_(shell),
        ears_(ears),
        signs_(signs),
        is_near_(target.may_meet(mesh, signs.low(), signs.high())),
        avoided_(avoided) {
    if (is_near_) costs_.emplace(mesh, shell, target);
  }

  [[nodiscard]] Cost none() const { return 0; }
  [[nodiscard]] Cost join(Cost x, Cost y) const { return x + y; }
  [[nodiscard]] bool better(Cost x, Cost y) const { return x < y; }

  std::optional<Cost> triangle(std::size_t i, std::size_t k, std::size_t j) {
    ++tests;
    if (!is_positive(i, k, j)) return std::nullopt;
    return is_near_ ? kWeight * costs_->face(i, k, j) : 0;
  }
  Cost diagonal(std::size_t i, std::size_t j) {
    const int avoided = shell_.link[i] == avoided_ || shell_.link[j] == avoided_ ? 1 : 0;
    if (!is_near_) return avoided;
    const int crossings =
        costs_->edge(i, j) + costs_->face(costs_->a(), i, j) + costs_->face(costs_->b(), i, j);
    return kWeight * crossings + avoided;
  }
  [[nodiscard]] int cost_now() {
    if (!is_near_) return 0;
    int cost = costs_->edge(costs_->a(), costs_->b());
    for (std::size_t i = 0; i < shell_.size(); ++i) cost += costs_->face(costs_->a(), costs_->b(), i);
    return cost;
  }

  std::size_t tests = 0;

 private:
  [[nodiscard]] bool is_positive(std::size_t i, std::size_t k, std::size_t j) const {
    if (k == i + 1 && j == i + 2) return ears_.sees_both(k);
    if (i == 0 && j + 1 == shell_.size()) {
      if (k == 1) return ears_.sees_both(0);
      if (k + 1 == j) return ears_.sees_both(j);
    }
    return signs_.sees_both(i, k, j);
  }

  const EdgeShell& shell_;
  const ShellEars& ears_;
  const ShellSigns& signs_;
  const bool is_near_;  // otherwise none of these costs anything
  Vertex avoided_;
  std::optional<ShellCosts> costs_;
};

namespace {

// For a link with four corners: the number of triangles that the search for the best triangulation looks at,
// if it must end with none, or only with the one whose diagonal ends at the avoided vertex, whatever the
// costs.
std::optional<std::size_t> looks_in_vain_at_four(const EdgeShell& shell, const ShellEars& ears,
                                                 Vertex avoided) {
  const std::array<bool, 4> sees{ears.sees_both(0), ears.sees_both(1), ears.sees_both(2), ears.sees_both(3)};
  const std::size_t between = 2 + (sees[1] ? 1 : 0) + (sees[2] ? 1 : 0);
  const bool has_1_3 = sees[0] && sees[2], has_0_2 = sees[1] && sees[3];
  const auto avoids = [&](std::size_t i, std::size_t j) {
    return shell.link[i] != avoided && shell.link[j] != avoided;
  };
  if (!has_1_3 && !has_0_2) return between;
  if (!has_1_3 && !avoids(0, 2)) return between;
  // If corner 1 is visible as well, the costs decide whether the triangles of the other diagonal are looked
  // at.
  if (has_1_3 && !sees[1] && !avoids(1, 3)) return between;
  return std::nullopt;
}

}  // namespace

bool Flipper::holds(Tet t, Vertex a, Vertex b) const {
  return mesh_.alive(t) && mesh_.index_of(t, a) >= 0 && mesh_.index_of(t, b) >= 0;
}

bool Flipper::stands(const Crossing& crossing) const {
  return mesh_.alive(crossing.tet) &&
         std::all_of(crossing.corners.begin(), crossing.corners.begin() + crossing.count,
                     [&](Vertex v) { return mesh_.index_of(crossing.tet, v) >= 0; });
}

void Flipper::begin(int depth, std::size_t budget, int most_change_at_end) {
  if (levels_.size() <= static_cast<std::size_t>(depth)) levels_.resize(static_cast<std::size_t>(depth) + 1);
  work_.begin(budget);
  change_.begin(most_change_at_end);
  tried_.forget();
}

bool Flipper::clear(const Crossing& crossing, int depth, std::size_t budget) {
  begin(depth, budget, -1);
  if (crossing.count == 2) {
    remove_edge(crossing.tet, crossing.corners[0], crossing.corners[1], depth);
    return change_.is_fall();
  }
  if (flip_face(crossing)) return true;
  const std::size_t first = random_() % 3;
  for (std::size_t k = first; k < first + 3 && !change_.is_fall() && !work_.exhausted(); ++k) {
    const Vertex a = crossing.corners[k % 3], b = crossing.corners[(k + 1) % 3];
    if (holds(crossing.tet, a, b)) remove_edge(crossing.tet, a, b, depth);
  }
  return change_.is_fall();
}

bool Flipper::remove(Tet t, Vertex a, Vertex b, int depth, std::size_t budget) {
  begin(depth, budget, 0);
  return remove_edge(t, a, b, depth);
}

bool Flipper::flip_face(const Crossing& face) {
  Vertex d = kNone;
  for (const Vertex v : mesh_.corners(face.tet))
    if (v != face.corners[0] && v != face.corners[1] && v != face.corners[2]) d = v;
  const Face code = face_code(face.tet, mesh_.index_of(face.tet, d));
  const Face across = mesh_.neighbour(code);
  if (mesh_.is_facet(code) || mesh_.is_ghost(face.tet) || mesh_.is_ghost(tet_of(across))) return false;
  const Vertex e = mesh_.apex(across);
  const auto f = mesh_.face_vertices(code);
  work_.add(3);
  for (std::size_t k = 0; k < 3; ++k)
    if (mesh_.orient(f[k], f[(k + 1) % 3], e, d) <= 0) return false;
  int change = target_.edge(mesh_, d, e) - target_.face(mesh_, f[0], f[1], f[2]);
  for (const Vertex v : f) change += target_.face(mesh_, v, d, e);
  if (change >= 0) return false;
  MeshEditor(mesh_).swap_face(code);
  note_flip(2, change);
  ++counts_.face_flips;
  return true;
}

bool Flipper::may_try(Tet t, Vertex a, Vertex b, int depth) {
  return !mesh_.is_segment(t, mesh_.edge_of(t, a, b)) && tried_.add(a, b, depth);
}

bool Flipper::gather(Tet t, Vertex a, Vertex b, Vertex avoided, Level& level) {
  EdgeShell& shell = level.shell;
  // Edges inside a facet that is cut into pieces are not segments.
  const auto beyond = [&](Tet s, int i) {
    const Tet next = tet_of(mesh_.neighbour(s, i));
    mesh_.prefetch_vertex(mesh_.corner(s, i));
    return mesh_.is_facet(face_code(s, i)) || mesh_.is_ghost(next) ? kNone : next;
  };
  if (mesh_.is_ghost(t) ||
      !gather_round(mesh_, t, a, b, shell, avoided == kNone ? tuning::kMostClipped : kMostLink, beyond))
    return false;
  if (shell.size() > kMostLink && !clip_ears(shell)) return false;
  signs_.set(shell);
  level.ears = signs_.ears();
  return true;
}

// If nothing is avoided, the edge crosses the target, and its removal must reduce the crossings.
bool Flipper::remove_now(const Level& level, Vertex avoided) {
  const EdgeShell& shell = level.shell;
  work_.add(shell.size());
  // Every triangulation of a polygon has two ears (Meisters 1975).
  if (std::popcount(level.ears.see_both()) < 2) {
    work_.add(2 * shell.size());
    return false;
  }
  if (shell.size() == 4)
    if (const auto looks = looks_in_vain_at_four(shell, level.ears, avoided)) {
      work_.add(2 * *looks);
      return false;
    }
  ForTarget objective(mesh_, shell, level.ears, signs_, target_, avoided);
  const auto cost = triangulation_.find(shell.size(), objective);
  work_.add(2 * objective.tests);
  if (!cost || *cost % ForTarget::kWeight != 0) return false;
  const int change = *cost / ForTarget::kWeight - objective.cost_now();
  if (!change_.allows(change, avoided == kNone)) return false;
  triangles_.clear();
  triangulation_.triangles(shell.size(), triangles_);
  MeshEditor(mesh_).replace_shell(shell, triangles_);
  note_flip(shell.size(), change);
  ++counts_.edge_removals;
  return true;
}

// Shells too large for the dynamic programme first lose tetrahedra by 2-3 flips, ear by ear.
bool Flipper::clip_ears(EdgeShell& shell) {
  std::size_t i = random_() % shell.size(), misses = 0;
  while (shell.size() > kMostLink && misses < shell.size()) {
    i = (i + 1) % shell.size();
    misses = clip_ear(shell, i) ? 0 : misses + 1;
  }
  return shell.size() <= kMostLink;
}

//   p_i-1   p_i+1          The face (a b p_i) gives way to the edge p_i-1 p_i+1, and the shell has one
//      \ / \ /            tetrahedron (a b p_i-1 p_i+1) in the place of two.
//       p_i
bool Flipper::clip_ear(EdgeShell& shell, std::size_t i) {
  const std::size_t n = shell.size(), last = (i + n - 1) % n, next = (i + 1) % n;
  const Vertex a = shell.a, b = shell.b, u = shell.link[last], p = shell.link[i], w = shell.link[next];
  work_.add(3);
  if (mesh_.orient(u, p, w, b) <= 0 || mesh_.orient(w, p, u, a) <= 0 || mesh_.orient(a, b, u, w) <= 0)
    return false;
  int change = target_.edge(mesh_, u, w) - target_.face(mesh_, a, b, p);
  for (const Vertex v : {a, b, p}) change += target_.face(mesh_, v, u, w);
  if (change > 0) return false;
  const std::array<TetMesh::Corners, 3> fresh{{{u, p, w, b}, {w, p, u, a}, {a, b, u, w}}};
  const std::array<Tet, 2> old_tets{shell.tets[last], shell.tets[i]};
  created_.clear();
  MeshEditor(mesh_).replace({.old_tets = old_tets, .new_tets = fresh}, &created_);
  note_flip(old_tets.size(), change);
  ++counts_.face_flips;
  shell.tets[last] = created_[2];
  shell.tets.erase(shell.tets.begin() + static_cast<std::ptrdiff_t>(i));
  shell.link.erase(shell.link.begin() + static_cast<std::ptrdiff_t>(i));
  return true;
}

// An ear is blocked at an end of the edge if it sees that end from the wrong side; then the spoke there is
// reflex. The order is random, but ears blocked at only one end come first.
void Flipper::begin_spokes(Level& level) {
  BlockedSpokes mixed;
  std::size_t count = 0;
  for (std::size_t i = 0; i < level.shell.size(); ++i) {
    const LinkCorners bit = LinkCorners{1} << i;
    const bool sees_a = (level.ears.see_a & bit) != 0, sees_b = (level.ears.see_b & bit) != 0;
    if (!sees_b) mixed[count++] = {i, true, !sees_a};
    if (!sees_a) mixed[count++] = {i, false, !sees_b};
  }
  const auto end = mixed.begin() + static_cast<std::ptrdiff_t>(count);
  numbers::shuffle(mixed.begin(), end, random_);
  const auto is_blocked_once = [](BlockedSpoke s) { return !s.is_blocked_twice(); };
  const auto twice = std::copy_if(mixed.begin(), end, level.spokes.begin(), is_blocked_once);
  std::remove_copy_if(mixed.begin(), end, twice, is_blocked_once);
  level.next = 0;
  level.count = count;
  work_.add(2 * level.shell.size());
}

std::optional<ShellSpoke> Flipper::next_blocked(Level& level) {
  if (level.next == level.count || work_.exhausted()) return std::nullopt;
  return level.spokes[level.next++].spoke();
}

void Flipper::note_flip(std::size_t old_tets, int change) {
  work_.add(8 * old_tets);
  tried_.forget();
  change_.add(change);
}

}  // namespace holdfast
