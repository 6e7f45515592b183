// Points in the order of a sweep: from left to right, and upwards on a vertical line.
#pragma once

#include "plane/order.h"

namespace holdfast::plane {

/// `order` has the original numbers of the points, `number` the numbers here by original number.
struct Sorted {
  explicit Sorted(const GivenPoints& given)
      : order(order_from_left(given)), number(given.size()), points(in_order(given, order)) {
    for (Vertex i = 0; i < order.size(); ++i) number[order[i]] = i;
  }

  std::vector<Vertex> order, number;
  Points points;
};

}  // namespace holdfast::plane
