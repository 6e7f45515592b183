// Nodes and elements with arbitrary numbers in a file, found by these numbers.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "holdfast/types.h"

namespace holdfast::io {

/// Numbers in the order of the file, then the position of each.
class Numbered {
 public:
  void add(std::int64_t number) {
    sorted_ = sorted_ && (entries_.empty() || entries_.back().first < number);
    entries_.emplace_back(number, static_cast<Index>(entries_.size()));
  }
  /// A number that occurs twice, if any. To be called before `find`.
  [[nodiscard]] std::optional<std::int64_t> finish() {
    if (!sorted_) std::sort(entries_.begin(), entries_.end());
    sorted_ = true;
    const auto twice = std::adjacent_find(entries_.begin(), entries_.end(),
                                          [](const auto& a, const auto& b) { return a.first == b.first; });
    if (twice == entries_.end()) return std::nullopt;
    return twice->first;
  }
  [[nodiscard]] std::optional<Index> find(std::int64_t number) const {
    if (entries_.empty()) return std::nullopt;
    // Numbers usually have no gaps; then no search is needed.
    const std::uint64_t guess =
        static_cast<std::uint64_t>(number) - static_cast<std::uint64_t>(entries_.front().first);
    if (guess < entries_.size())
      if (const auto& [known, index] = entries_[static_cast<std::size_t>(guess)]; known == number)
        return index;
    const auto found = std::lower_bound(entries_.begin(), entries_.end(), number,
                                        [](const auto& entry, std::int64_t n) { return entry.first < n; });
    if (found == entries_.end() || found->first != number) return std::nullopt;
    return found->second;
  }
  [[nodiscard]] std::size_t size() const { return entries_.size(); }

 private:
  std::vector<std::pair<std::int64_t, Index>> entries_;
  bool sorted_ = true;
};

}  // namespace holdfast::io
