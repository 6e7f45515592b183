// Points from left to right, and on one vertical line upwards, as a sweep passes them.
#pragma once

#include "plane/order.h"

namespace holdfast::plane {

/// `order` has the numbers that the points had before, `number` those that they have here.
struct Sorted {
  explicit Sorted(std::span<const Position> given) : order(order_from_left(given)), number(given.size()) {
    Positions positions(given.size());
    for (Vertex i = 0; i < order.size(); ++i) {
      positions[i] = given[order[i]];
      number[order[i]] = i;
    }
    points = Points(std::move(positions));
  }

  std::vector<Vertex> order, number;
  Points points;
};

}  // namespace holdfast::plane
