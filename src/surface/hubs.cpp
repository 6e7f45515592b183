// Surface layer: vertices of many elements.
#include "surface/hubs.h"

#include <algorithm>
#include <cmath>

#include "numbers/vector.h"
#include "surface/complex.h"

namespace holdfast {
namespace {

constexpr Box kAllDirections{{-1, -1, -1}, {1, 1, 1}};

// The direction from a to b, with an error of a few units of 2^-53; false if the difference overflows.
bool direction(const Point& a, const Point& b, Point& unit) {
  double largest = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    unit[k] = b[k] - a[k];
    largest = std::max(largest, std::fabs(unit[k]));
  }
  if (!(largest > 0) || !std::isfinite(largest)) return false;
  for (double& x : unit) x /= largest;
  const double size = length(unit);
  for (double& x : unit) x /= size;
  return true;
}

}  // namespace

Hubs::Hubs(const Complex& complex, const Elements& elements, std::size_t least)
    : complex_(complex), elements_(elements) {
  std::vector<Index> degree(complex.vertices.size(), 0), hub_of(complex.vertices.size(), no_index);
  for (const Element& element : elements.all) {
    for (unsigned i = 0; i < element.corners; ++i) ++degree[element.vertex[i]];
  }
  for (Index v = 0; v < degree.size(); ++v) {
    if (degree[v] < least) continue;
    hub_of[v] = static_cast<Index>(hubs_.size());
    hubs_.push_back({v, {}});
    hubs_.back().elements.reserve(degree[v]);
  }
  if (hubs_.empty()) return;
  of_.assign(elements.all.size(), {no_index, no_index, no_index});
  for (Index e = 0; e < elements.all.size(); ++e) {
    const Element& element = elements.all[e];
    for (unsigned i = 0, count = 0; i < element.corners; ++i) {
      const Index hub = hub_of[element.vertex[i]];
      if (hub == no_index) continue;
      of_[e][count++] = hub;
      hubs_[hub].elements.push_back(e);
    }
  }
}

Index Hubs::shared(Index a, Index b) const {
  Index least = no_index;
  for (const Index hub : of_[a]) {
    if (hub < least && std::find(of_[b].begin(), of_[b].end(), hub) != of_[b].end()) least = hub;
  }
  return least;
}

std::vector<Index> Hubs::fans() const {
  std::vector<Index> fans(of_.size(), no_index);
  for (Index e = 0; e < of_.size(); ++e) {
    std::size_t most = 0;
    for (const Index hub : of_[e]) {
      if (hub == no_index || hubs_[hub].elements.size() <= most) continue;
      most = hubs_[hub].elements.size();
      fans[e] = hub;
    }
  }
  return fans;
}

std::vector<Box> Hubs::directions(const Hub& hub) const {
  std::vector<Box> boxes;
  boxes.reserve(hub.elements.size());
  for (const Index e : hub.elements) {
    const Element& element = elements_.all[e];
    std::array<Point, 2> ends{};
    unsigned count = 0;
    bool good = true;
    for (unsigned i = 0; i < element.corners; ++i) {
      if (element.vertex[i] == hub.vertex) continue;
      good =
          good && direction(complex_.vertices[hub.vertex], complex_.vertices[element.vertex[i]], ends[count]);
      ++count;
    }
    if (!good) {
      boxes.push_back(kAllDirections);
      continue;
    }
    if (count == 1) ends[1] = ends[0];
    // With chord c, the arc is at most 1 - sqrt(1 - c^2 / 4) <= c^2 / 4 away from it.
    double chord = 0;
    for (std::size_t k = 0; k < 3; ++k) chord += (ends[1][k] - ends[0][k]) * (ends[1][k] - ends[0][k]);
    const double margin = chord / 4 + 1e-13;
    Box box;
    for (std::size_t k = 0; k < 3; ++k) {
      box.low[k] = std::min(ends[0][k], ends[1][k]) - margin;
      box.high[k] = std::max(ends[0][k], ends[1][k]) + margin;
    }
    boxes.push_back(box);
  }
  return boxes;
}

}  // namespace holdfast
