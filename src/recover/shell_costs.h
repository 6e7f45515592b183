// Costs of faces and edges among the vertices of a shell, for a segment to recover.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "mesh/edge_removal.h"
#include "mesh/tet_mesh.h"
#include "recover/target.h"

namespace holdfast {

/// The same costs as those of the target, with the sign of each pair of vertices computed once. Vertices are
/// given by position: corners of the link, then the ends of the edge.
class ShellCosts {
 public:
  ShellCosts(const TetMesh& mesh, const EdgeShell& shell, const Target& target)
      : mesh_(mesh), shell_(shell), target_(target), has_pairs_(target.is_segment()) {
    if (has_pairs_) std::fill_n(sides_.begin(), count() * count(), kUnknown);
  }

  [[nodiscard]] std::size_t a() const { return shell_.size(); }
  [[nodiscard]] std::size_t b() const { return shell_.size() + 1; }

  int face(std::size_t i, std::size_t k, std::size_t j) {
    if (!has_pairs_) return 0;
    const int s = side(i, k);
    if (s == 0 || side(k, j) != s || side(j, i) != s) return 0;
    return target_.face_round(mesh_, vertex(i), vertex(k), vertex(j));
  }
  int edge(std::size_t i, std::size_t j) {
    if (has_pairs_ && side(i, j) != 0) return 0;
    return target_.edge(mesh_, vertex(i), vertex(j));
  }

 private:
  static constexpr std::size_t kMost = kMostLink + 2;
  static constexpr std::int8_t kUnknown = 2;

  [[nodiscard]] std::size_t count() const { return shell_.size() + 2; }
  [[nodiscard]] Vertex vertex(std::size_t i) const {
    return i < shell_.size() ? shell_.link[i] : i == shell_.size() ? shell_.a : shell_.b;
  }
  // On which side of the segment the edge from i to j passes; 0 where one of them is an end of the segment.
  int side(std::size_t i, std::size_t j) {
    std::int8_t& known = sides_[i * count() + j];
    if (known == kUnknown) {
      known = static_cast<std::int8_t>(target_.side(mesh_, vertex(i), vertex(j)));
      sides_[j * count() + i] = static_cast<std::int8_t>(-known);
    }
    return known;
  }

  const TetMesh& mesh_;
  const EdgeShell& shell_;
  const Target& target_;
  const bool has_pairs_;
  std::array<std::int8_t, kMost * kMost> sides_;  // of pairs, as many as there are
};

}  // namespace holdfast
