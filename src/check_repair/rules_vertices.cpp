// Check of repairs: vertices of the input, and the reported distances.
#include <bit>
#include <set>

#include "check/findings.h"
#include "check_repair/examination.h"
#include "text/count.h"
#include "text/decimal.h"

namespace holdfast::checking {
namespace {

/// All NaNs are equal: a file does not keep their bits.
bool same_bits(const Point& x, const Point& y) {
  for (std::size_t k = 0; k < 3; ++k)
    if (std::bit_cast<std::uint64_t>(x[k]) != std::bit_cast<std::uint64_t>(y[k]) &&
        !(std::isnan(x[k]) && std::isnan(y[k])))
      return false;
  return true;
}

/// What rounding up may add to a reported distance.
constexpr double kRoundedUp = 1 + 0x1p-48;

}  // namespace

RepairRule vertices_kept(const RepairExamination& on) {
  Violations violations = on.violations(RepairRuleKind::vertices_kept);
  std::set<Index> moved;
  for (const auto& [vertex, distance] : on.claims.moved)
    if (!moved.insert(vertex).second)
      violations.add([&, v = vertex] { return "vertex " + std::to_string(v) + " is listed twice as moved"; });
  const std::size_t all = on.input.vertices.size();
  for (std::size_t v = 0; v < all; ++v) {
    on.pulse();
    const Point& before = on.input.vertices[v];
    if (v >= on.output.vertices.size()) {
      violations.add([&] { return "vertex " + std::to_string(v) + " " + words(before) + " is missing"; });
      continue;
    }
    const Point& after = on.output.vertices[v];
    if (same_bits(before, after) || moved.contains(static_cast<Index>(v))) continue;
    violations.add([&] {
      return "vertex " + std::to_string(v) + " " + words(before) + " became " + words(after) + ", " +
             decimal(rough_distance(before, after)) + " away, and is not listed as moved";
    });
  }
  return violations.rule(counted(all - std::min(all, moved.size()), "vertex", "vertices") + " bit for bit, " +
                         std::to_string(moved.size()) + " listed as moved");
}

RepairRule distances_right(RepairExamination& on) {
  Violations violations = on.violations(RepairRuleKind::distances_right);
  const double most = on.claims.max_displacement;
  on.has_distance = std::isfinite(most) && most >= 0;
  if (!on.has_distance)
    violations.add([&] { return "the largest distance, " + decimal(most) + ", is no distance"; });
  double farthest = 0;
  for (const auto& [vertex, distance] : on.claims.moved) {
    on.pulse();
    const Index v = vertex;
    const double told = distance;
    const auto name = [&] { return "vertex " + std::to_string(v); };
    if (v >= on.input.vertices.size() || v >= on.output.vertices.size() || !finite(on.input.vertices[v]) ||
        !finite(on.output.vertices[v])) {
      violations.add([&] { return name() + ", listed as moved, is no finite vertex of input and output"; });
      continue;
    }
    const Point &before = on.input.vertices[v], &after = on.output.vertices[v];
    const auto found = [&] {
      return name() + " moved from " + words(before) + " to " + words(after) + ", which is " +
             decimal(rough_distance(before, after));
    };
    if (!std::isfinite(told) || told < 0 || compare_distance(before, after, told) > 0 ||
        compare_distance(before, after, told / kRoundedUp) < 0)
      violations.add([&] { return found() + "; the list says " + decimal(told); });
    else if (told == 0)
      violations.add([&] { return name() + " is listed as moved and did not move"; });
    else if (told > most)
      violations.add([&] { return found() + "; the largest distance is said to be " + decimal(most); });
    farthest = std::max(farthest, told);
  }
  if (on.claims.weld && *on.claims.weld > 0 && on.claims.max_displacement > *on.claims.weld &&
      farthest > *on.claims.weld)
    violations.add([&] {
      return "a vertex moved by " + decimal(farthest) + ", further than the tolerance " +
             decimal(*on.claims.weld);
    });
  return violations.rule("at most " + decimal(most) + " is claimed; vertices moved by at most " +
                         decimal(farthest));
}

}  // namespace holdfast::checking
