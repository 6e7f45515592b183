// A free vertex that goes: its ball, filled again with one of its neighbours in its place.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "optimise/volume.h"

namespace holdfast {

class Contraction {
 public:
  explicit Contraction(ImprovedVolume& volume) : volume_(volume) {}

  /// Turns to v. Returns whether its ball is small enough to be worth a look.
  bool turn_to(Vertex v);
  [[nodiscard]] std::span<const Tet> ball() const { return ball_; }
  /// The length of the longest edge at v.
  [[nodiscard]] double longest() const;
  /// The neighbours of v, in ascending order.
  [[nodiscard]] std::span<const Vertex> link() const { return link_; }
  /// The tetrahedra of the ball with w in the place of v, until the next call.
  std::span<const TetMesh::Corners> with(Vertex w);
  [[nodiscard]] std::span<const TetMesh::Corners> listed() const { return candidate_; }
  /// Whether all of them are positive.
  [[nodiscard]] bool is_valid() const;
  /// Whether no edge of those, listed with w, is longer than that at w.
  [[nodiscard]] bool is_within(double longest, Vertex w) const;
  /// Takes those, of all that were listed since v was turned to.
  void choose() { chosen_.swap(candidate_); }
  [[nodiscard]] bool has_choice() const { return !chosen_.empty(); }
  /// Whether the figures that the volume keeps, if any, allow what was chosen.
  [[nodiscard]] bool is_allowed() { return volume_.allows(ball_, chosen_); }
  /// Replaces the ball and removes v. Returns the new tetrahedra, until the next change.
  std::span<const Tet> make();

 private:
  // A tetrahedron of the ball.
  struct Member {
    TetMesh::Corners corners;
    std::size_t index;  // of v
  };

  ImprovedVolume& volume_;
  Vertex v_ = kNone;
  std::vector<Tet> ball_;
  std::vector<Member> members_;
  std::vector<std::array<Vertex, 3>> faces_;  // of the ball, opposite v
  std::vector<Vertex> link_;
  std::vector<TetMesh::Corners> candidate_, chosen_;
};

}  // namespace holdfast
