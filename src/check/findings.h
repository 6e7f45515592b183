// Check: the findings of a rule. All offending entities are counted, and the first ones are described in
// words.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "holdfast/check.h"

namespace holdfast::checking {

/// The offending entities of one rule: all are counted, the first ones are described.
class Findings {
 public:
  /// Counts one entity. `describe` returns its description and is called for the first few only.
  template <class Describe>
  void add(Describe&& describe) {
    if (count_++ < most_described) append(std::forward<Describe>(describe)());
  }
  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] bool empty() const { return count_ == 0; }
  /// "COUNT WHAT: first; second; third; and N more".
  [[nodiscard]] std::string text(std::string_view what) const;

 private:
  static constexpr std::size_t most_described = 3;
  void append(const std::string& words);

  std::size_t count_ = 0;
  std::string described_;
};

/// A rule that holds if there are no findings; then `good` is its detail.
[[nodiscard]] Rule judge(RuleKind kind, const Findings& findings, std::string_view what, std::string good);
/// A rule that cannot be decided, for this `reason`. It counts as broken.
[[nodiscard]] Rule not_examined(RuleKind kind, const std::string& reason);

/// "(x, y, z)", in the fewest digits that give the same doubles.
[[nodiscard]] std::string words(const Point& point);
/// "facet 7 (1, 2, 3)" with the coordinates of its corners; an index out of range has no coordinates.
[[nodiscard]] std::string words(std::string_view kind, std::size_t index, std::span<const Index> corners,
                                std::span<const Point> vertices);
/// The same for an entity that has no index of its own.
[[nodiscard]] std::string words(std::string_view kind, std::span<const Index> corners,
                                std::span<const Point> vertices);

}  // namespace holdfast::checking
