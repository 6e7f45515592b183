// The nodes of a .msh file, which its elements name by tags.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "holdfast/holdfast.h"
#include "io/msh_numbers.h"

namespace holdfast::io {

/// Nodes in file order, then a look-up by node tag.
class MshNodes {
 public:
  void reserve(std::size_t count) {
    tags_.reserve(count);
    points_.reserve(count);
  }
  void add_tag(std::int64_t tag) { tags_.push_back(tag); }
  void add_point(const Point& point) { points_.push_back(point); }

  /// Sorts by tag; a repeated tag is an error at the current position of `numbers`.
  void finish(const MshNumbers& numbers) {
    if (std::is_sorted(tags_.begin(), tags_.end(), std::less_equal<>())) return;
    std::vector<std::size_t> order(tags_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return tags_[a] < tags_[b]; });
    MshNodes sorted;
    sorted.reserve(order.size());
    for (const std::size_t i : order) {
      if (!sorted.tags_.empty() && sorted.tags_.back() == tags_[i])
        numbers.fail("the node tag " + std::to_string(tags_[i]) + " occurs twice");
      sorted.add_tag(tags_[i]);
      sorted.add_point(points_[i]);
    }
    *this = std::move(sorted);
  }

  [[nodiscard]] Index index(const MshNumbers& numbers, std::int64_t tag) const {
    // Tags usually have no gaps; then no search is needed.
    if (!tags_.empty() && tag >= tags_.front() && tag <= tags_.back()) {
      // The difference may not fit 63 bits.
      const std::uint64_t guess = static_cast<std::uint64_t>(tag) - static_cast<std::uint64_t>(tags_.front());
      if (guess < tags_.size() && tags_[static_cast<std::size_t>(guess)] == tag)
        return static_cast<Index>(guess);
      const auto found = std::lower_bound(tags_.begin(), tags_.end(), tag);
      if (*found == tag) return static_cast<Index>(found - tags_.begin());
    }
    numbers.fail("the node " + std::to_string(tag) + " does not exist");
  }

  [[nodiscard]] std::size_t size() const { return tags_.size(); }
  [[nodiscard]] std::vector<Point> take_points() { return std::move(points_); }

 private:
  std::vector<std::int64_t> tags_;
  std::vector<Point> points_;
};

}  // namespace holdfast::io
