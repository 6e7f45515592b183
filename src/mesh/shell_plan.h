// The plan of an edge removal: every neighbour is known from the polygon round the edge (edge_removal.h).
#pragma once

#include <array>
#include <vector>

#include "mesh/change.h"
#include "mesh/edge_removal.h"

namespace holdfast {

class ShellPlan {
 public:
  static constexpr std::size_t kMostNew = 2 * (kMostLink - 2);

  /// The triangles are those of a triangulation of the link; their tetrahedra are positive.
  ShellPlan(const TetMesh& mesh, const EdgeShell& shell, const std::vector<LinkTriangle>& triangles);

  [[nodiscard]] Change change() const {
    return {shell_.tets, std::span(new_tets_).first(2 * (shell_.size() - 2))};
  }

 private:
  // The parts of a shell that stay, at each end of the edge: an outer face, and the edge from the end to a
  // corner.
  struct AtEnd {
    Face across;
    bool is_facet, is_spoke_segment;
  };

  void read_shell(const TetMesh& mesh);
  void join(const LinkTriangle& triangle, std::size_t first);
  void join_side(std::size_t end, std::size_t tet, std::size_t x, std::size_t y, int c);
  void set_spoke(std::size_t end, std::size_t tet, std::size_t corner, int c);
  void link(std::size_t tet, int c, Face other);
  void set_flag(std::size_t tet, Flags flag) {
    new_tets_[tet].flags = static_cast<Flags>(new_tets_[tet].flags | flag);
  }

  const EdgeShell& shell_;
  // By side of the link, from corner i to the next.
  std::array<std::array<AtEnd, kMostLink>, 2> at_;
  std::array<bool, kMostLink> is_side_segment_;
  // At each end, the new face at a diagonal of the link that has no neighbour yet.
  std::array<std::array<std::array<Face, 2>, kMostLink>, kMostLink> open_;
  std::array<NewTet, kMostNew> new_tets_;
};

}  // namespace holdfast
