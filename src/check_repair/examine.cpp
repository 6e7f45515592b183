#include "check_repair/examine.h"

#include "check_repair/examination.h"

namespace holdfast::checking {

RepairRule not_examined(RepairRuleKind kind, const std::string& reason) {
  RepairRule rule;
  rule.kind = kind;
  rule.violations = 1;
  rule.first = {"not examined: " + reason};
  return rule;
}

RepairCheckResult examine_repair(const Complex& input, const Complex& output, const RepairClaims& claims,
                                 std::size_t most, const std::function<void(double)>& step) {
  Pulse pulse(step);
  RepairExamination on{input, output, claims, most, pulse};
  RepairCheckResult result;
  const auto take = [&](RepairRule rule, double share) {
    result.rules.push_back(std::move(rule));
    pulse.reach(share);
  };
  // The order of these calls is the order in which rules establish facts for later ones.
  take(output_valid(on), 0.4);
  take(vertices_kept(on), 0.45);
  take(distances_right(on), 0.5);
  take(parents_named(on), 0.55);
  find_places(on);
  take(children_near(on), 0.7);
  take(parents_covered(on), 0.85);
  take(segments_covered(on), 0.88);
  take(losses_listed(on), 0.9);
  take(repeats_listed(on), 0.92);
  take(fillings_bounded(on), 0.93);
  take(markers_kept(on), 0.95);
  take(valid_unchanged(on), 1);
  return result;
}

bool is_within_distance(const Complex& input, const Complex& output, const RepairClaims& claims,
                        const std::function<void(double)>& step) {
  Pulse pulse(step);
  RepairExamination on{input, output, claims, 0, pulse};
  find_whether_followed(on);
  if (!distances_right(on).holds() || !parents_named(on).holds()) return false;
  find_places(on);
  return children_near(on).holds() && parents_covered(on).holds() && segments_covered(on).holds() &&
         losses_listed(on).holds();
}

}  // namespace holdfast::checking
