// Which triangles of a plane mesh a closed chain of its edges goes round.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "holdfast/types.h"

namespace holdfast::repairing {

/// Told by the edges alone, so that the triangles of several chains that make up a closed surface do so, too,
/// however crooked these are.
class RoundChain {
 public:
  using Step = std::array<Index, 2>;  // from a vertex to the next

  /// The triangles turn left, and have no gaps inside chains.
  explicit RoundChain(std::span<const Triangle> triangles);

  /// Those that the chain goes round an odd number of times, ascending: exactly the edges that the chain has
  /// an odd number of times are edges of an odd number of them. The chain is taken to turn left, which
  /// makes the search fast, and where it does not, the result is the same.
  [[nodiscard]] std::vector<Index> inside(std::span<const Step> chain) const;

 private:
  struct EdgeOf {
    Step edge;
    Index code;  // 3 * triangle + number of its first end
  };

  [[nodiscard]] Index triangle_left_of(const Step& edge) const;
  /// What lies left of the steps and is not separated from it; false if that is not all and nothing else.
  [[nodiscard]] bool flood(std::span<const Step> odd, std::vector<Index>& inside) const;
  [[nodiscard]] std::vector<Index> by_parity(std::span<const Step> odd) const;

  std::span<const Triangle> triangles_;
  std::vector<EdgeOf> edges_;  // ascending
  std::vector<Index> beside_;  // by code the triangle on the other side, or no_index
};

}  // namespace holdfast::repairing
