// Points from left to right, and on one vertical line upwards, as a sweep passes them.
#pragma once

#include "plane/order.h"

namespace holdfast::plane {

/// `order` has the numbers that the points had before, `number` those that they have here.
struct Sorted {
  explicit Sorted(const GivenPoints& given)
      : order(order_from_left(given)), number(given.size()), points(in_order(given, order)) {
    for (Vertex i = 0; i < order.size(); ++i) number[order[i]] = i;
  }

  std::vector<Vertex> order, number;
  Points points;
};

}  // namespace holdfast::plane
