// Removes an edge by flips, after other flips that clear its way: one recursion for every objective (George,
// Hecht, Saltel 1991; Si 2015, flipnm).
//
//        b         The edge ab goes where its link can be triangulated. An ear (p q r) of the link is in the
//      / | \       way where the objective takes it at one end of ab for none of the new tetrahedra. Without
//     p--|--r      the spoke from that end to q, the shell has one tetrahedron fewer. So the spoke goes
//      \ q /       first, in the same way, one level deeper, and gets no new edge at the other end.
//        a
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "mesh/edge_removal.h"

namespace holdfast {

/// An edge from an end of a shell's edge to a corner of its link.
struct ShellSpoke {
  std::uint32_t corner;
  bool at_b;
};

/// Removes edge ab of tetrahedron t by flips of at most `depth` levels. `avoided`, if it is a vertex, gets no
/// new edge. Returns whether the edge is gone; flips on the way stay in either case.
///
/// A Policy has
///   bool may_try(Tet, a, b, int depth)               whether the edge is worth a look
///   Level& level(int depth)                          what it remembers of an edge there, with a `shell`
///   bool gather(Tet, a, b, avoided, Level&)          the shell; false where the edge has to stay
///   bool remove_now(Level&, avoided)                 the flip of the edge itself, if its link allows it
///   void begin_spokes(Level&)                        before the first of them
///   std::optional<ShellSpoke> next_blocked(Level&)   the next spoke in the way; nothing after the last
///   std::size_t edge_removals() const                how many flips there were
///   Tet find_edge(a, b)                              a tetrahedron of an edge, or kNone
template <typename Policy>
class EdgeClearing {
 public:
  explicit EdgeClearing(const TetMesh& mesh, Policy& policy) : mesh_(mesh), policy_(policy) {}

  bool remove(Tet t, Vertex a, Vertex b, int depth, Vertex avoided) {
    if (!policy_.may_try(t, a, b, depth)) return false;
    auto& level = policy_.level(depth);
    while (policy_.gather(t, a, b, avoided, level)) {
      if (policy_.remove_now(level, avoided)) return true;
      if (depth == 0 || !thin_out(level, depth)) return false;
      t = survivor(level.shell);
      if (t == kNone) return true;
    }
    return false;
  }

 private:
  // Whether the flips for one of the spokes have changed the mesh.
  template <typename Level>
  bool thin_out(Level& level, int depth) {
    const EdgeShell& shell = level.shell;
    const std::size_t before = policy_.edge_removals();
    policy_.begin_spokes(level);
    while (const std::optional<ShellSpoke> spoke = policy_.next_blocked(level)) {
      const Vertex end = spoke->at_b ? shell.b : shell.a, other = spoke->at_b ? shell.a : shell.b;
      remove(shell.tets[spoke->corner], end, shell.link[spoke->corner], depth - 1, other);
      if (policy_.edge_removals() > before) return true;
    }
    return false;
  }

  // A tetrahedron of an edge's shell after flips beside it.
  Tet survivor(const EdgeShell& shell) {
    const auto holds = [&](Tet t) {
      return mesh_.alive(t) && mesh_.index_of(t, shell.a) >= 0 && mesh_.index_of(t, shell.b) >= 0;
    };
    const auto at = std::find_if(shell.tets.begin(), shell.tets.end(), holds);
    return at != shell.tets.end() ? *at : policy_.find_edge(shell.a, shell.b);
  }

  const TetMesh& mesh_;
  Policy& policy_;
};

}  // namespace holdfast
