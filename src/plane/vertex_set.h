// A set of vertices numbered from left to right. It finds the next one from a number on, and those between
// two numbers whose heights lie between two bounds.
#pragma once

#include <bit>
#include <cstring>
#include <vector>

#include "plane/grid.h"
#include "plane/number_set.h"
#include "plane/points.h"

namespace holdfast::plane {

/// Heights are compared eight at once, as rows of a grid, which are computed on first use.
class VertexSet {
 public:
  static constexpr std::size_t none = NumberSet::none;

  explicit VertexSet(const Points& points) : points_(points), numbers_(points.size()) {}

  void insert(Vertex v) {
    numbers_.insert(v);
    if (!rows_.empty()) rows_[v] = row(points_[v][1]);
  }
  void erase(Vertex v) {
    numbers_.erase(v);
    if (!rows_.empty()) rows_[v] = kAbsent;
  }
  [[nodiscard]] bool contains(Vertex v) const { return numbers_.contains(v); }
  /// The least number in the set that is at least `i`, or `none`.
  [[nodiscard]] std::size_t from(std::size_t i) const { return numbers_.from(i); }

  /// Calls `visit` in order for vertices with `first` <= number < `last` and heights from `low` to `high`,
  /// and for some just outside these heights, until it returns false.
  template <typename Visit>
  void each_between(Vertex first, Vertex last, double low, double high, Visit&& visit) {
    using Bytes = std::int8_t __attribute__((vector_size(kLanes)));
    if (rows_.empty()) find_rows();
    const Lanes from = Lanes{} + row(low), to = Lanes{} + row(high);
    for (Vertex v = first; v < last; v += kLanes) {
      Lanes rows;
      std::memcpy(&rows, &rows_[v], sizeof rows);
      const Lanes apart = (rows < from) | (rows > to);
      std::uint64_t near =
          ~std::bit_cast<std::uint64_t>(__builtin_convertvector(apart, Bytes)) & 0x0101010101010101u;
      if (std::endian::native == std::endian::big) near = __builtin_bswap64(near);
      for (; near != 0; near &= near - 1) {
        const Vertex found = v + static_cast<Vertex>(std::countr_zero(near)) / kLanes;
        if (found >= last || !visit(found)) return;
      }
    }
  }

 private:
  static constexpr std::uint32_t kLanes = 8;
  static constexpr std::uint32_t kRows = 1u << 14;
  static constexpr std::int16_t kAbsent = -1;  // below all rows
  using Lanes = std::int16_t __attribute__((vector_size(2 * kLanes)));

  [[nodiscard]] std::int16_t row(double y) const { return static_cast<std::int16_t>(grid_.cell(y, 1)); }

  void find_rows() {
    grid_ = Grid(points_.positions(), kRows);
    rows_.assign(points_.size() + kLanes, kAbsent);
    for (std::size_t v = from(0); v != none; v = from(v + 1))
      rows_[v] = row(points_[static_cast<Vertex>(v)][1]);
  }

  const Points& points_;
  NumberSet numbers_;
  Grid grid_;
  std::vector<std::int16_t> rows_;  // by vertex, computed on first use
};

}  // namespace holdfast::plane
