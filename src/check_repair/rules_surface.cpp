// Check of repairs: the output is a complex, and a valid input is left unchanged.
#include <bit>

#include "check/findings.h"
#include "check_repair/examination.h"
#include "check_repair/validity.h"
#include "text/count.h"

namespace holdfast::checking {
namespace {

bool is_complex(const Complex& surface, Pulse& pulse) {
  bool valid = true;
  examine_complex(
      surface, true, {}, [&](const auto&) { return valid = false; }, pulse);
  return valid;
}

/// The first parent of each output triangle; the parts of a parent lie near its plane.
std::vector<Index> first_parents(const IndexLists& parents) {
  std::vector<Index> first;
  if (parents.first.empty() || parents.first.back() > parents.all.size())
    return first;  // checked by another rule
  first.reserve(parents.size());
  for (std::size_t f = 0; f < parents.size(); ++f)
    first.push_back(parents[f].empty() ? no_entity : parents[f][0]);
  return first;
}

}  // namespace

void find_whether_followed(RepairExamination& on) {
  const auto follows = [&](std::span<const Index> corners) {
    return std::all_of(corners.begin(), corners.end(), [&](Index v) {
      return v < on.output.vertices.size() && finite(on.output.vertices[v]);
    });
  };
  on.can_follow = std::all_of(on.output.facets.begin(), on.output.facets.end(),
                              [&](const Triangle& t) { return follows(t); }) &&
                  std::all_of(on.output.segments.begin(), on.output.segments.end(),
                              [&](const Segment& s) { return follows(s); });
}

RepairRule output_valid(RepairExamination& on) {
  Violations violations = on.violations(RepairRuleKind::output_valid);
  examine_complex(
      on.output, false, first_parents(on.claims.parents),
      [&](const std::function<std::string()>& sentence) {
        violations.add(sentence);
        return true;
      },
      on.pulse);
  find_whether_followed(on);
  return violations.rule(counted(on.output.facets.size(), "triangle") + ", " +
                         counted(on.output.vertices.size(), "vertex", "vertices") + ": a simplicial complex");
}

/// Another rule compares the vertices.
RepairRule valid_unchanged(const RepairExamination& on) {
  Violations violations = on.violations(RepairRuleKind::valid_unchanged);
  const bool asked = on.claims.weld.value_or(on.claims.max_displacement) > 0 ||
                     on.claims.join.value_or(0) > 0 || on.claims.unite.value_or(false);
  if (asked) return violations.rule("a tolerance or a union changes valid surfaces, too");
  std::vector<Index> parents;
  std::size_t kept = on.output.facets.size();
  while (kept > 0 && kept <= on.claims.parents.size() && on.claims.parents[kept - 1].empty()) --kept;
  const auto same = [&](std::size_t f) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Index a = on.output.facets[f][k], b = on.input.facets[f][k];
      if (a >= on.output.vertices.size() || b >= on.input.vertices.size() ||
          on.output.vertices[a] != on.input.vertices[b])
        return false;
    }
    return true;
  };
  std::size_t first = 0;
  while (first < std::min(kept, on.input.facets.size()) && same(first)) ++first;
  const bool identical =
      kept == on.input.facets.size() && first == kept &&
      (on.input.vertices.size() == on.output.vertices.size() || kept < on.output.facets.size());
  if (identical) return violations.rule("the triangles are as they were");
  if (!is_complex(on.input, on.pulse)) return violations.rule("the input is not valid");
  violations.add([&] {
    return "the input is valid; it has " + counted(on.input.facets.size(), "triangle") + " and " +
           counted(on.input.vertices.size(), "vertex", "vertices") + ", the output " +
           std::to_string(on.output.facets.size()) + " and " + std::to_string(on.output.vertices.size()) +
           "; triangle " + std::to_string(first) + " is the first that differs";
  });
  return violations.rule({});
}

}  // namespace holdfast::checking
