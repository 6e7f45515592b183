#include "recover/flipper.h"

#include <algorithm>
#include <stdexcept>

#include "mesh/replace.h"

namespace holdfast {

// Counts what a triangulated link puts in the target's way; among equals, the fewest edges at one of the
// link's vertices, whose other edge is to lose degree.
class Flipper::ForTarget {
 public:
  using Cost = int;
  static constexpr int kWeight = 64;

  ForTarget(const TetMesh& mesh, const EdgeShell& shell, const Target& target, Vertex favoured)
      : mesh_(mesh), shell_(shell), target_(target), favoured_(favoured) {}

  [[nodiscard]] Cost none() const { return 0; }
  [[nodiscard]] Cost join(Cost x, Cost y) const { return x + y; }
  [[nodiscard]] bool better(Cost x, Cost y) const { return x < y; }

  std::optional<Cost> triangle(std::size_t i, std::size_t k, std::size_t j) {
    ++tests;
    if (!sees_both_ends(mesh_, shell_, i, k, j)) return std::nullopt;
    return kWeight * target_.face(mesh_, shell_.link[i], shell_.link[k], shell_.link[j]);
  }
  Cost diagonal(std::size_t i, std::size_t j) {
    const Vertex u = shell_.link[i], v = shell_.link[j];
    const int crossings =
        target_.edge(mesh_, u, v) + target_.face(mesh_, shell_.a, u, v) + target_.face(mesh_, shell_.b, u, v);
    return kWeight * crossings + (u == favoured_ || v == favoured_ ? 1 : 0);
  }
  [[nodiscard]] int cost_now() const {
    int cost = target_.edge(mesh_, shell_.a, shell_.b);
    for (const Vertex p : shell_.link) cost += target_.face(mesh_, shell_.a, shell_.b, p);
    return cost;
  }

  std::size_t tests = 0;

 private:
  const TetMesh& mesh_;
  const EdgeShell& shell_;
  const Target& target_;
  Vertex favoured_;
};

void Flipper::aim(const Target& target, std::size_t budget) {
  target_ = target;
  budget_ = budget;
  work_ = 0;
  forget();
}

bool Flipper::holds(Tet t, Vertex a, Vertex b) const {
  return mesh_.alive(t) && mesh_.index_of(t, a) >= 0 && mesh_.index_of(t, b) >= 0;
}

bool Flipper::clear(const Crossing& crossing, int depth, int most_change) {
  most_change_ = most_change;
  const Tet t = crossing.tet;
  if (!mesh_.alive(t)) return false;
  for (int k = 0; k < crossing.count; ++k)
    if (mesh_.index_of(t, crossing.corners[static_cast<std::size_t>(k)]) < 0) return false;
  forget();
  const Mark start = mark();
  const auto helped = [&] {
    if (change_ <= most_change && entries_.size() > 0) return true;
    undo_to(start);
    return false;
  };
  if (crossing.count == 3 && flip_face(crossing) && helped()) return true;
  const std::size_t edges = crossing.count == 3 ? 3 : 1;
  const std::size_t first = edges == 3 ? random_() % 3 : 0;
  for (std::size_t k = first; k < first + edges && !exhausted(); ++k) {
    const Vertex a = crossing.corners[k % 3], b = crossing.corners[edges == 1 ? 1 : (k + 1) % 3];
    remove_edge(t, a, b, depth, kNone);
    if (helped()) return true;
  }
  return false;
}

int Flipper::last_change() const { return change_; }

//          d                       The 2-3 flip: face (f0 f1 f2) between apexes d and e gives way to
//        / | \                     edge de, and (f0 f1 f2 d), (f0 f2 f1 e) to (f0 f1 e d), (f1 f2 e d)
//      f0--|--f2                   and (f2 f0 e d). These are positive exactly if de passes through the
//        \ f1 /                    inside of the face.
//          e
bool Flipper::flip_face(const Crossing& face) {
  Vertex d = kNone;
  for (const Vertex v : mesh_.corners(face.tet))
    if (v != face.corners[0] && v != face.corners[1] && v != face.corners[2]) d = v;
  const Face code = face_code(face.tet, mesh_.index_of(face.tet, d));
  const Face across = mesh_.neighbour(code);
  if (mesh_.is_facet(code) || mesh_.is_ghost(face.tet) || mesh_.is_ghost(tet_of(across))) return false;
  const Vertex e = mesh_.apex(across);
  const auto f = mesh_.face_vertices(code);
  work_ += 3;
  for (std::size_t k = 0; k < 3; ++k)
    if (mesh_.orient(f[k], f[(k + 1) % 3], e, d) <= 0) return false;
  change_ += target_.edge(mesh_, d, e) - target_.face(mesh_, f[0], f[1], f[2]);
  for (const Vertex v : f) change_ += target_.face(mesh_, v, d, e);
  fresh_.clear();
  for (std::size_t k = 0; k < 3; ++k) fresh_.push_back({f[k], f[(k + 1) % 3], e, d});
  apply({face.tet, tet_of(across)}, fresh_);
  ++counts_.face_flips;
  return true;
}

// Removes edge ab, or returns false; flips that cleared the way then stay for the caller to undo.
bool Flipper::remove_edge(Tet t, Vertex a, Vertex b, int depth, Vertex favoured) {
  if (mesh_.is_segment(t, kEdgeOf[static_cast<std::size_t>(mesh_.index_of(t, a))]
                                 [static_cast<std::size_t>(mesh_.index_of(t, b))]))
    return false;
  EdgeShell shell;
  if (!gather_shell(mesh_, t, a, b, shell)) return false;
  if (remove_edge_now(shell, favoured)) return true;
  while (depth > 0 && !exhausted() && thin_out(shell, depth))
    if (remove_edge_now(shell, favoured)) return true;
  return false;
}

bool Flipper::remove_edge_now(const EdgeShell& shell, Vertex favoured) {
  ForTarget objective(mesh_, shell, target_, favoured);
  LinkTriangulation<ForTarget> triangulation;
  const auto cost = triangulation.find(shell.size(), objective);
  work_ += 2 * objective.tests + shell.size();
  if (!cost) return false;
  const int change = *cost / ForTarget::kWeight - objective.cost_now();
  if (*cost % ForTarget::kWeight != 0 || change_ + change > (favoured == kNone ? most_change_ : kNestedChange))
    return false;
  change_ += change;
  triangles_.clear();
  fresh_.clear();
  triangulation.triangles(shell.size(), triangles_);
  tetrahedra_of(shell, triangles_, fresh_);
  apply(shell.tets, fresh_);
  ++counts_.edge_removals;
  return true;
}

// An ear (p_i-1 p_i p_i+1) of the link is blocked at an end where it sees that end wrongly: then the spoke
// from that end to p_i is reflex. Removes such a spoke so that the shell has one tetrahedron fewer.
bool Flipper::thin_out(EdgeShell& shell, int depth) {
  const std::size_t n = shell.size();
  std::vector<Spoke> spokes;
  for (std::uint32_t i = 0; i < n; ++i) {
    const Vertex before = shell.link[(i + n - 1) % n], p = shell.link[i], after = shell.link[(i + 1) % n];
    const bool at_b = mesh_.orient(before, p, after, shell.b) <= 0;
    const bool at_a = mesh_.orient(after, p, before, shell.a) <= 0;
    work_ += 2;
    if (at_b) spokes.push_back({i, true, at_a});
    if (at_a) spokes.push_back({i, false, at_b});
  }
  std::shuffle(spokes.begin(), spokes.end(), random_);
  std::stable_partition(spokes.begin(), spokes.end(), [](const Spoke& s) { return !s.blocked_twice; });
  EdgeShell thinner;
  for (const Spoke& spoke : spokes) {
    if (exhausted()) return false;
    const Vertex end = spoke.at_b ? shell.b : shell.a, other = spoke.at_b ? shell.a : shell.b;
    const Mark before = mark();
    const bool removed = remove_edge(shell.tets[spoke.corner], end, shell.link[spoke.corner], depth - 1, other);
    if (entries_.size() == before.entries) continue;
    const Tet t = survivor(shell);
    if (removed && t != kNone && gather_shell(mesh_, t, shell.a, shell.b, thinner) && thinner.size() < n) {
      shell = thinner;
      return true;
    }
    undo_to(before);
  }
  return false;
}

// A tetrahedron of an edge's shell after flips beside it.
Tet Flipper::survivor(const EdgeShell& shell) {
  for (const Tet t : shell.tets)
    if (holds(t, shell.a, shell.b)) return t;
  return piercing_.find_edge(shell.a, shell.b);
}

void Flipper::apply(const std::vector<Tet>& old_tets, const std::vector<TetMesh::Corners>& new_tets) {
  entries_.push_back({removed_.size(), created_.size()});
  for (const Tet t : old_tets) {
    removed_.push_back(t);
    removed_corners_.push_back(mesh_.corners(t));
  }
  replace(mesh_, {.old_tets = old_tets, .new_tets = new_tets}, &created_);
  work_ += 8 * old_tets.size();
}

// Replays the journal backwards. Slots are freed and taken last in, first out, so that removing what was
// created in the opposite order gives every tetrahedron its old name back: older entries stay true.
void Flipper::undo_to(const Mark& mark) {
  while (entries_.size() > mark.entries) {
    const Entry entry = entries_.back();
    entries_.pop_back();
    std::reverse(created_.begin() + static_cast<std::ptrdiff_t>(entry.created), created_.end());
    std::reverse(removed_corners_.begin() + static_cast<std::ptrdiff_t>(entry.removed),
                 removed_corners_.end());
    made_.clear();
    replace(mesh_,
            {.old_tets = std::span(created_).subspan(entry.created),
             .new_tets = std::span(removed_corners_).subspan(entry.removed)},
            &made_);
    if (!std::equal(made_.rbegin(), made_.rend(),
                    removed_.begin() + static_cast<std::ptrdiff_t>(entry.removed)))
      throw std::logic_error("holdfast: slots of tetrahedra are not reused last in, first out");
    removed_.resize(entry.removed);
    removed_corners_.resize(entry.removed);
    created_.resize(entry.created);
    ++counts_.undone;
  }
  change_ = mark.change;
}

void Flipper::forget() {
  entries_.clear();
  removed_.clear();
  removed_corners_.clear();
  created_.clear();
  change_ = 0;
}

}  // namespace holdfast
