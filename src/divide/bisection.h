// Cells of about equal work: boxes that planes across the axes cut from space, one after the other (recursive
// coordinate bisection; Berger and Bokhari 1987).
#pragma once

#include <span>
#include <vector>

#include "holdfast/types.h"

namespace holdfast::division {

/// So much work at a place.
struct Work {
  Point where;
  double amount;
};

class Bisection {
 public:
  /// At least one cell; `work` is reordered.
  Bisection(std::vector<Work> work, std::size_t cells);

  [[nodiscard]] std::size_t cells() const { return cells_; }
  [[nodiscard]] std::size_t cell_of(const Point& p) const;
  /// To the nearest of the walls between cells; infinite for a single cell.
  [[nodiscard]] double distance_to_wall(const Point& p) const;

 private:
  struct Box {
    Point low, high;
  };
  struct Node {
    Box box;
    std::size_t axis = 0;
    double wall = 0;
    std::size_t below = 0, above = 0;  ///< children; 0 for a cell
    std::size_t cell = 0;
  };
  std::size_t build(std::span<Work> work, const Box& box, std::size_t cells);
  [[nodiscard]] static double distance_to_wall_of(const Node& node, const Point& p);

  std::vector<Node> nodes_;
  std::size_t cells_ = 0;
};

}  // namespace holdfast::division
