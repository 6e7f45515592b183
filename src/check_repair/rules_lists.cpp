// Check of repairs: exactly the dropped, merged and filled entities are listed as such; and markers.
#include <map>
#include <set>

#include "check/findings.h"
#include "check_repair/examination.h"
#include "holdfast/names.h"
#include "text/count.h"
#include "text/decimal.h"

namespace holdfast::checking {
namespace {

constexpr const char* kNoParents = "the parents cannot be followed";

std::string input_facet(const RepairExamination& on, std::size_t f) {
  return words("input triangle", f, on.input.facets[f], on.input.vertices);
}

bool has_area(const std::array<Point, 3>& t) { return !collinear(t[0].data(), t[1].data(), t[2].data()); }

/// Why the reason given for a facet without children is false; empty if it is true.
std::string objection(const RepairExamination& on, Index f, DropReason reason) {
  const bool is_finite = on.is_finite(on.input.facets[f]);
  if (reason == DropReason::not_finite) return is_finite ? "all of its corners are finite" : "";
  if (!is_finite) return "it has a corner that is not finite";
  const std::array<Point, 3> t = on.corners_in(f);
  if (reason == DropReason::no_area) return has_area(t) ? "it has an area" : "";
  if (reason == DropReason::inner)
    return on.claims.unite && !*on.claims.unite ? "no union was asked for" : "";
  if (on.has_distance && !inscribed_at_most(t, on.claims.max_displacement))
    return "it cannot vanish where no point moves further than " + decimal(on.claims.max_displacement);
  return "";
}

/// For each input vertex, the first one at its place.
std::vector<Index> first_at_place(std::span<const Point> vertices) {
  std::map<Point, Index> first;
  std::vector<Index> at(vertices.size());
  for (Index v = 0; v < vertices.size(); ++v)
    at[v] = finite(vertices[v]) ? first.try_emplace(vertices[v], v).first->second : v;
  return at;
}

Triangle sorted(Triangle t) {
  std::sort(t.begin(), t.end());
  return t;
}

}  // namespace

RepairRule losses_listed(const RepairExamination& on) {
  constexpr RepairRuleKind kind = RepairRuleKind::losses_listed;
  if (!on.parents_follow) return not_examined(kind, kNoParents);
  Violations violations = on.violations(kind);
  std::set<Index> listed;
  for (const auto& [facet, reason] : on.claims.dropped) {
    const Index f = facet;
    const auto said = [&, why = reason] {
      return input_facet(on, f) + " is listed as dropped (" + name(why) + "), but ";
    };
    if (f >= on.input.facets.size()) {
      violations.add(
          [&] { return "triangle " + std::to_string(f) + ", listed as dropped, is none of the input"; });
      continue;
    }
    if (!listed.insert(f).second)
      violations.add([&] { return input_facet(on, f) + " is listed as dropped twice"; });
    if (!on.children[f].empty() && !(reason == DropReason::inner && on.claims.unite.value_or(true)))
      violations.add(
          [&] { return said() + "output triangle " + std::to_string(on.children[f][0]) + " names it"; });
    if (const std::string why_not = objection(on, f, reason); !why_not.empty())
      violations.add([&] { return said() + why_not; });
  }
  for (std::size_t f = 0; f < on.children.size(); ++f)
    if (on.children[f].empty() && !listed.contains(static_cast<Index>(f)))
      violations.add([&] { return input_facet(on, f) + " has no children and is not listed as dropped"; });
  return violations.rule(counted(listed.size(), "triangle") + " dropped");
}

RepairRule repeats_listed(const RepairExamination& on) {
  constexpr RepairRuleKind kind = RepairRuleKind::repeats_listed;
  if (!on.parents_follow) return not_examined(kind, kNoParents);
  Violations violations = on.violations(kind);
  if (!on.claims.merged) return violations.rule("what was merged is not told");
  std::map<Index, Index> into;
  for (const auto& [facet, other] : *on.claims.merged) into[facet] = other;
  const std::vector<Index> place = first_at_place(on.input.vertices);
  std::map<Triangle, Index> first;
  std::size_t repeats = 0;
  for (Index f = 0; f < on.children.size(); ++f) {
    on.pulse();
    if (on.children[f].empty()) {
      if (into.contains(f))
        violations.add([&] { return input_facet(on, f) + " is listed as merged and has no children"; });
      continue;
    }
    const Triangle& t = on.input.facets[f];
    const auto [at, is_new] = first.try_emplace(sorted({place[t[0]], place[t[1]], place[t[2]]}), f);
    const auto listed = into.find(f);
    if (is_new) {
      if (listed != into.end())
        violations.add(
            [&] { return input_facet(on, f) + " is listed as merged and repeats none before it"; });
      continue;
    }
    ++repeats;
    const Index other = at->second;
    if (listed == into.end() || listed->second != other)
      violations.add([&] {
        return input_facet(on, f) + " repeats " + std::to_string(other) +
               " and is not listed as merged into it";
      });
    if (on.children[f] != on.children[other])
      violations.add([&] {
        return input_facet(on, f) + " repeats " + std::to_string(other) + " and has other children";
      });
  }
  return violations.rule(counted(repeats, "triangle") + " merged");
}

RepairRule fillings_bounded(const RepairExamination& on) {
  constexpr RepairRuleKind kind = RepairRuleKind::fillings_bounded;
  if (!on.parents_follow || !on.can_follow) return not_examined(kind, kNoParents);
  Violations violations = on.violations(kind);
  if (!on.claims.filled) return violations.rule("what was filled is not told");
  std::set<Index> taken;
  for (std::size_t h = 0; h < on.claims.filled->size(); ++h) {
    const RepairResult::Filled& hole = (*on.claims.filled)[h];
    const auto hole_words = [&] { return "filled hole " + std::to_string(h); };
    std::set<Segment> odd;
    const auto flip = [&](Index a, Index b) {
      const Segment edge{std::min(a, b), std::max(a, b)};
      if (!odd.insert(edge).second) odd.erase(edge);
    };
    for (std::size_t i = 0; i < hole.border.size(); ++i)
      flip(hole.border[i], hole.border[(i + 1) % hole.border.size()]);
    for (const Index f : hole.facets) {
      if (f >= on.output.facets.size() || !taken.insert(f).second) {
        violations.add([&] {
          return hole_words() + " names triangle " + std::to_string(f) + ", which is none, or another's";
        });
        continue;
      }
      const Triangle& t = on.output.facets[f];
      for (std::size_t i = 0; i < 3; ++i) flip(t[i], t[(i + 1) % 3]);
    }
    if (!odd.empty())
      violations.add([&] {
        return hole_words() + ": its triangles and its border do not end at the same edges, at " +
               words("edge", *odd.begin(), on.output.vertices);
      });
  }
  return violations.rule(std::to_string(on.claims.filled->size()) + " holes filled");
}

RepairRule markers_kept(const RepairExamination& on) {
  constexpr RepairRuleKind kind = RepairRuleKind::markers_kept;
  if (!on.parents_follow) return not_examined(kind, kNoParents);
  Violations violations = on.violations(kind);
  const std::span<const int> before = on.input.facet_markers, after = on.output.facet_markers;
  if (before.empty()) return violations.rule("the input has no markers");
  if (after.size() != on.output.facets.size()) return violations.rule("the file holds no markers");
  const std::set<int> known(before.begin(), before.end());
  for (const auto& [marker, members] : on.claims.marker_sets)
    if (known.contains(marker))
      violations.add([&, m = marker] {
        return "marker " + std::to_string(m) + " stands for several and is one of the input's";
      });
  const auto list = [](const std::set<int>& markers) {
    std::string text;
    for (const int m : markers) text += (text.empty() ? "" : ", ") + std::to_string(m);
    return text;
  };
  for (std::size_t f = 0; f < after.size(); ++f) {
    on.pulse();
    std::set<int> wanted;
    for (const Index p : on.claims.parents[f]) wanted.insert(before[p]);
    if (wanted.empty()) continue;
    const auto of = on.claims.marker_sets.find(after[f]);
    const std::set<int> carried = of == on.claims.marker_sets.end()
                                      ? std::set<int>{after[f]}
                                      : std::set<int>(of->second.begin(), of->second.end());
    if (carried != wanted)
      violations.add([&] {
        return words("output triangle", f, on.output.facets[f], on.output.vertices) + " carries " +
               list(carried) + ", and its parents " + list(wanted);
      });
  }
  return violations.rule(std::to_string(after.size()) + " markers, " +
                         std::to_string(on.claims.marker_sets.size()) + " of which stand for several");
}

}  // namespace holdfast::checking
