// Check of repairs: what the rules of one examination share.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "check/pulse.h"
#include "check_repair/reach.h"
#include "holdfast/check_repair.h"

namespace holdfast::checking {

/// The violations of one rule: all are counted, the first ones described.
class Violations {
 public:
  Violations(RepairRuleKind kind, std::size_t most) : most_(most) { rule_.kind = kind; }
  /// `describe` gives a sentence, and is called for the first few only.
  template <class Describe>
  void add(Describe&& describe) {
    if (rule_.violations++ < most_) rule_.first.push_back(std::forward<Describe>(describe)());
  }
  [[nodiscard]] bool none() const { return rule_.violations == 0; }
  [[nodiscard]] RepairRule rule(std::string detail) {
    rule_.detail = std::move(detail);
    return std::move(rule_);
  }

 private:
  RepairRule rule_{};
  std::size_t most_;
};

inline bool finite(const Point& p) {
  return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
}

struct RepairExamination {
  const Complex& input;
  const Complex& output;
  const RepairClaims& claims;
  std::size_t most;  ///< of RepairCheckOptions
  Pulse& pulse;

  // Established by the rules, in this order.
  bool can_follow = false;      ///< indices of the output exist, and the coordinates that they use are finite
  bool has_distance = false;    ///< `max_displacement` is a number
  bool parents_follow = false;  ///< as many lists as facets, all indices of which exist
  std::vector<Index> place{};   ///< by vertex of the input, the used one of the output at its place, or none
  std::vector<std::vector<Index>> children{};  ///< by facet of the input

  [[nodiscard]] Violations violations(RepairRuleKind kind) const { return {kind, most}; }
  [[nodiscard]] std::array<Point, 3> corners_in(Index facet) const {
    const Triangle& t = input.facets[facet];
    return {input.vertices[t[0]], input.vertices[t[1]], input.vertices[t[2]]};
  }
  /// Whether the indices of an input facet or segment exist and its corners are finite.
  [[nodiscard]] bool is_finite(std::span<const Index> corners) const {
    return std::all_of(corners.begin(), corners.end(),
                       [&](Index v) { return v < input.vertices.size() && finite(input.vertices[v]); });
  }
};

/// A rule that others must hold for: it counts as broken.
[[nodiscard]] RepairRule not_examined(RepairRuleKind kind, const std::string& reason);

// rules_surface.cpp
void find_whether_followed(RepairExamination& on);  ///< is a part of the next
[[nodiscard]] RepairRule output_valid(RepairExamination& on);
[[nodiscard]] RepairRule valid_unchanged(const RepairExamination& on);
// rules_vertices.cpp
[[nodiscard]] RepairRule vertices_kept(const RepairExamination& on);
[[nodiscard]] RepairRule distances_right(RepairExamination& on);
// rules_parents.cpp
[[nodiscard]] RepairRule parents_named(RepairExamination& on);
void find_places(RepairExamination& on);
[[nodiscard]] RepairRule children_near(const RepairExamination& on);
[[nodiscard]] RepairRule parents_covered(const RepairExamination& on);
[[nodiscard]] RepairRule segments_covered(const RepairExamination& on);
// rules_lists.cpp
[[nodiscard]] RepairRule losses_listed(const RepairExamination& on);
[[nodiscard]] RepairRule repeats_listed(const RepairExamination& on);
[[nodiscard]] RepairRule fillings_bounded(const RepairExamination& on);
[[nodiscard]] RepairRule markers_kept(const RepairExamination& on);

}  // namespace holdfast::checking
