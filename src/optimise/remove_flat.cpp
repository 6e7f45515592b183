#include "optimise/remove_flat.h"

#include <algorithm>
#include <array>

#include "mesh/editor.h"
#include "mesh/quality_below.h"
#include "mesh/traverse.h"
#include "optimise/badness.h"
#include "optimise/nothing_bad.h"

namespace holdfast {
bool FlatRemover::remove(Tet t, double bad_from, std::vector<Tet>& created) {
  bad_from_ = bad_from;
  created_ = &created;
  work_ = 0;
  const TetMesh::Corners corners = mesh_.corners(t);
  for (const int edge : wide_edges(mesh_, t)) {
    const auto [a, b] = ends_of_edge(corners, edge);
    if (EdgeClearing(mesh_, *this).remove(t, a, b, tuning::kFlatDepth, kNone)) return true;
    if (!mesh_.alive(t) || mesh_.corners(t) != corners) return true;
  }
  return false;
}

bool FlatRemover::gather(Tet t, Vertex a, Vertex b, Vertex, Level& level) {
  return ++work_ <= tuning::kFlatShells && !mesh_.is_segment(t, mesh_.edge_of(t, a, b)) &&
         gather_shell(mesh_, t, a, b, level.shell, tuning::kMostShellForFlat);
}

bool FlatRemover::remove_now(const Level& level, Vertex avoided) {
  const EdgeShell& shell = level.shell;
  NothingBad objective(mesh_, shell, bad_from_, avoided);
  if (!triangulation_.find(shell.size(), objective)) return false;
  triangles_.clear();
  triangulation_.triangles(shell.size(), triangles_);
  MeshEditor(mesh_).replace_shell(shell, triangles_, created_);
  ++edge_removals_;
  return true;
}

// A spoke is in the way if the ear at its corner would be bad or negative.
std::optional<ShellSpoke> FlatRemover::next_blocked(Level& level) const {
  const EdgeShell& shell = level.shell;
  const std::size_t n = shell.size();
  while (level.next < 2 * n) {
    const std::uint32_t i = level.next / 2;
    const bool at_b = level.next++ % 2 == 0;
    const Vertex p = shell.link[(i + n - 1) % n], q = shell.link[i], r = shell.link[(i + 1) % n];
    if (at_b ? !is_good(p, q, r, shell.b) : !is_good(r, q, p, shell.a)) return ShellSpoke{i, at_b};
  }
  return std::nullopt;
}

// Like holdfast::find_edge, but without marks: threads that change parts of the mesh must not set them
// (mesh/in_place_parts.h).
Tet FlatRemover::find_edge(Vertex a, Vertex b) {
  round_.clear();
  ball_without_marks(mesh_, a, round_);
  const auto at =
      std::find_if(round_.begin(), round_.end(), [&](Tet t) { return mesh_.index_of(t, b) >= 0; });
  return at != round_.end() ? *at : kNone;
}

bool FlatRemover::is_good(Vertex a, Vertex b, Vertex c, Vertex d) const {
  return mesh_.orient(a, b, c, d) > 0 && is_quality_below(mesh_.position(a), mesh_.position(b),
                                                          mesh_.position(c), mesh_.position(d), bad_from_);
}

}  // namespace holdfast
