// A triangulation of a closed walk in space that need not be plane.
#include "plane/least_area.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "numbers/vector.h"

namespace holdfast::plane {
namespace {

/// Flat triangles count before area, since a triangle between three corners of one line has none.
struct Cost {
  std::size_t flat = 0;
  double area = 0;

  Cost operator+(const Cost& other) const { return {flat + other.flat, area + other.area}; }
  bool operator<(const Cost& other) const {
    return flat != other.flat ? flat < other.flat : area < other.area;
  }
};

Cost cost_of(const Point& a, const Point& b, const Point& c) {
  constexpr double kFlat = 0x1p-40;  // of a square: nothing but the rounding of corners on one line
  const Point ab = b - a, ac = c - a, bc = c - b;
  const double area = length(cross(ab, ac));
  const double square = std::max({dot(ab, ab), dot(ac, ac), dot(bc, bc)});
  return {area <= kFlat * square ? std::size_t{1} : 0, area};
}

/// The places scaled by a power of two, so that areas neither overflow nor underflow.
std::vector<Point> scaled_places(std::span<const Point> walk) {
  double most = 0;
  for (const Point& p : walk)
    for (const double x : p) most = std::max(most, std::abs(x));
  const int exponent = most > 0 && std::isfinite(most) ? std::ilogb(most) : 0;
  const auto scaled = [&](double x) { return std::scalbn(x, -exponent); };
  std::vector<Point> places;
  places.reserve(walk.size());
  for (const Point& p : walk) places.push_back(Point{scaled(p[0]), scaled(p[1]), scaled(p[2])});
  return places;
}

/// The cheapest triangulations of all parts of a walk between two of its corners.
class Parts {
 public:
  Parts(std::span<const Point> places, const Poll& poll) : places_(places), n_(places.size()) {
    cost_.resize(n_ * n_);
    apex_.resize(n_ * n_, 0);
    for (std::size_t width = 2; width < n_; ++width) {
      if (poll) poll(static_cast<double>(width) / static_cast<double>(n_));
      for (std::size_t i = 0; i + width < n_; ++i) choose(i, i + width);
    }
  }

  [[nodiscard]] std::vector<std::array<Vertex, 3>> triangles(std::span<const Point> walk) const {
    std::vector<std::array<Vertex, 3>> triangles;
    std::vector<std::pair<std::size_t, std::size_t>> open{{0, n_ - 1}};
    while (!open.empty()) {
      const auto [i, j] = open.back();
      open.pop_back();
      if (j - i < 2) continue;
      const std::size_t k = apex_[i * n_ + j];
      if (k == 0) return {};
      if (walk[i] != walk[k] && walk[k] != walk[j] && walk[j] != walk[i])
        triangles.push_back({static_cast<Vertex>(i), static_cast<Vertex>(k), static_cast<Vertex>(j)});
      open.emplace_back(i, k);
      open.emplace_back(k, j);
    }
    return triangles;
  }

 private:
  void choose(std::size_t i, std::size_t j) {
    Cost best{n_, std::numeric_limits<double>::infinity()};
    for (std::size_t k = i + 1; k < j; ++k) {
      const Cost cost = cost_[i * n_ + k] + cost_[k * n_ + j] + cost_of(places_[i], places_[k], places_[j]);
      if (!(cost < best)) continue;
      best = cost;
      apex_[i * n_ + j] = static_cast<Vertex>(k);
    }
    cost_[i * n_ + j] = best;
  }

  std::span<const Point> places_;
  std::size_t n_;
  std::vector<Cost> cost_;
  std::vector<Vertex> apex_;  // 0: none
};

}  // namespace

std::vector<std::array<Vertex, 3>> triangles_of_least_area(std::span<const Point> walk, const Poll& poll) {
  if (walk.size() < 3 || walk.size() > kMostCornersOfLeastArea) return {};
  const std::vector<Point> places = scaled_places(walk);
  return Parts(places, poll).triangles(walk);
}

}  // namespace holdfast::plane
