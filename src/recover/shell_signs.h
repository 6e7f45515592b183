// The orientation of triangles among the corners of a link towards the ends of its edge.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "exact/orient_ring.h"
#include "mesh/edge_removal.h"
#include "mesh/tet_mesh.h"

namespace holdfast {

/// A set of corners of a link, one bit each.
using LinkCorners = std::uint32_t;

/// Of each corner, the triangle between the one before and the one after it: the corners where that sees the
/// end from the right side.
struct ShellEars {
  LinkCorners see_a = 0, see_b = 0;

  [[nodiscard]] LinkCorners see_both() const { return see_a & see_b; }
  [[nodiscard]] bool sees_both(std::size_t corner) const { return (see_both() >> corner & 1) != 0; }
};

/// Signs among the vertices of a shell of at most kMostLink tetrahedra: floating point for all at once, and
/// exactly what that leaves open.
class ShellSigns {
 public:
  explicit ShellSigns(const TetMesh& mesh) : mesh_(mesh) {}

  /// The shell must stay as it is.
  void set(const EdgeShell& shell) {
    shell_ = &shell;
    filter_.set(
        shell.size(), [&](std::size_t i) { return mesh_.position(shell.link[i]).data(); },
        mesh_.position(shell.a).data(), mesh_.position(shell.b).data());
    is_explicit_ = mesh_.exact_vertex_count() == 0 || all_are_explicit(shell);
  }

  /// The box of the doubles nearest to all of them.
  [[nodiscard]] const Point& low() const { return filter_.low(); }
  [[nodiscard]] const Point& high() const { return filter_.high(); }

  [[nodiscard]] ShellEars ears() const {
    const exact::OrientRing::OfBoth known = is_explicit_ ? filter_.ears() : exact::OrientRing::OfBoth{};
    ShellEars ears{known.a.negative, known.b.positive};
    const std::size_t n = shell_->size();
    const LinkCorners all = (LinkCorners{1} << n) - 1;
    const LinkCorners open_at_a = all & ~(known.a.negative | known.a.positive),
                      open_at_b = all & ~(known.b.negative | known.b.positive);
    for (LinkCorners open = open_at_a | open_at_b; open != 0; open &= open - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(open));
      const LinkCorners bit = LinkCorners{1} << i;
      const Vertex before = shell_->link[i == 0 ? n - 1 : i - 1], p = shell_->link[i],
                   after = shell_->link[i + 1 == n ? 0 : i + 1];
      if ((open_at_a & bit) != 0 && mesh_.orient(before, p, after, shell_->a) < 0) ears.see_a |= bit;
      if ((open_at_b & bit) != 0 && mesh_.orient(before, p, after, shell_->b) > 0) ears.see_b |= bit;
    }
    return ears;
  }

  /// sees_both_ends of the shell.
  [[nodiscard]] bool sees_both(std::size_t i, std::size_t k, std::size_t j) const {
    if (!is_explicit_) return sees_both_ends(mesh_, *shell_, i, k, j);
    const auto [positive, negative] = filter_.triangle(i, k, j);
    if ((positive & 1) != 0 || (negative & 2) != 0) return false;
    if ((negative & 1) != 0 && (positive & 2) != 0) return true;
    return sees_both_ends(mesh_, *shell_, i, k, j);
  }

 private:
  [[nodiscard]] bool all_are_explicit(const EdgeShell& shell) const {
    return mesh_.is_explicit(shell.a) && mesh_.is_explicit(shell.b) &&
           std::all_of(shell.link.begin(), shell.link.end(), [&](Vertex v) { return mesh_.is_explicit(v); });
  }

  const TetMesh& mesh_;
  const EdgeShell* shell_ = nullptr;
  exact::OrientRing filter_;
  bool is_explicit_ = false;
};

}  // namespace holdfast
