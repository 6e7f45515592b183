// Which triangles of a plane mesh a closed chain of its edges goes round.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "holdfast/types.h"

namespace holdfast::repairing {

/// The edges alone decide this. So if several chains bound a closed surface, the triangles of these chains
/// make up a closed surface, too, however crooked the chains are.
class RoundChain {
 public:
  using Step = std::array<Index, 2>;  // from a vertex to the next

  /// The triangles must turn left and have no gaps inside chains.
  explicit RoundChain(std::span<const Triangle> triangles);

  /// The triangles that the chain goes round an odd number of times, ascending. Exactly the edges that occur
  /// in the chain an odd number of times are edges of an odd number of these triangles. The search assumes
  /// that the chain turns left, which makes it fast; the result does not depend on it.
  [[nodiscard]] std::vector<Index> inside(std::span<const Step> chain) const;

 private:
  struct EdgeOf {
    Step edge;
    Index code;  // 3 * triangle + number of its first end
  };

  [[nodiscard]] Index triangle_left_of(const Step& edge) const;
  /// Collects the triangles left of the steps and all that no step separates from them. False if these are
  /// not exactly the result.
  [[nodiscard]] bool flood(std::span<const Step> odd, std::vector<Index>& inside) const;
  [[nodiscard]] std::vector<Index> by_parity(std::span<const Step> odd) const;

  std::span<const Triangle> triangles_;
  std::vector<EdgeOf> edges_;  // ascending
  std::vector<Index> beside_;  // by code, the triangle on the other side, or no_index
};

}  // namespace holdfast::repairing
