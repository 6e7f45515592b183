// Check of repairs: facets of the output and their parents in the input lie near each other. This proves the
// largest distance in both directions.
#include <algorithm>
#include <set>

#include "check/findings.h"
#include "check_repair/cover.h"
#include "check_repair/examination.h"
#include "text/count.h"
#include "text/decimal.h"

namespace holdfast::checking {
namespace {

constexpr const char* kCannotFollow = "the output or its parents cannot be followed, or there is no distance";

bool is_ready(const RepairExamination& on) { return on.can_follow && on.has_distance && on.parents_follow; }

std::set<Index> dropped(const RepairExamination& on) {
  std::set<Index> facets;
  for (const RepairResult::Dropped& entry : on.claims.dropped) facets.insert(entry.facet);
  return facets;
}

std::string facet_words(const char* whose, const Complex& surface, std::size_t f) {
  return words(std::string(whose) + " triangle", f, surface.facets[f], surface.vertices);
}

/// For input vertices, their places among the vertices of the output.
std::array<Index, 3> places_of(const RepairExamination& on, const Triangle& t) {
  return {on.place[t[0]], on.place[t[1]], on.place[t[2]]};
}

/// Corners of the children of an input facet that are out of its reach. Each corner is tested once.
std::set<Index> far_corners(const RepairExamination& on, std::size_t parent, const Reach& reach) {
  std::vector<Index> corners;
  for (const Index f : on.children[parent])
    corners.insert(corners.end(), on.output.facets[f].begin(), on.output.facets[f].end());
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  const std::array<Point, 3> triangle = on.corners_in(static_cast<Index>(parent));
  std::set<Index> far;
  for (const Index v : corners) {
    on.pulse();
    if (!reach.of_triangle(on.output.vertices[v], triangle)) far.insert(v);
  }
  return far;
}

}  // namespace

RepairRule parents_named(RepairExamination& on) {
  Violations violations = on.violations(RepairRuleKind::parents_named);
  const IndexLists& parents = on.claims.parents;
  const std::size_t facets = on.output.facets.size();
  const bool lists_fit = !parents.first.empty() && parents.first.back() <= parents.all.size();
  if (!lists_fit || parents.size() != facets)
    violations.add([&] {
      return "there are parents for " + std::to_string(lists_fit ? parents.size() : 0) +
             " triangles, and the output has " + std::to_string(facets);
    });
  if (!violations.none()) return violations.rule({});
  std::set<Index> filling;
  if (on.claims.filled)
    for (const RepairResult::Filled& hole : *on.claims.filled)
      filling.insert(hole.facets.begin(), hole.facets.end());
  bool follows = true;
  on.children.resize(on.input.facets.size());
  for (std::size_t f = 0; f < facets; ++f) {
    on.pulse();
    std::set<Index> seen;
    for (const Index p : parents[f]) {
      if (p >= on.input.facets.size()) {
        follows = false;
        violations.add([&] {
          return facet_words("output", on.output, f) + " names the parent " + std::to_string(p) +
                 ", and the input has " + counted(on.input.facets.size(), "triangle");
        });
        continue;
      }
      if (!seen.insert(p).second)
        violations.add([&] {
          return facet_words("output", on.output, f) + " names the parent " + std::to_string(p) + " twice";
        });
      else
        on.children[p].push_back(static_cast<Index>(f));
      if (!on.is_finite(on.input.facets[p])) {
        follows = false;
        violations.add([&] {
          return facet_words("output", on.output, f) + " names the parent " + std::to_string(p) +
                 ", which is not finite";
        });
      }
    }
    const bool is_filling = filling.contains(static_cast<Index>(f));
    if (parents[f].empty() && on.claims.filled && !is_filling)
      violations.add([&] {
        return facet_words("output", on.output, f) + " has no parent and fills no hole that is listed";
      });
    if (!parents[f].empty() && is_filling)
      violations.add([&] {
        return facet_words("output", on.output, f) + " is listed as filling a hole and has parents";
      });
  }
  on.parents_follow = follows;
  return violations.rule(std::to_string(parents.all.size()) + " parents of " + std::to_string(facets) +
                         " triangles");
}

void find_places(RepairExamination& on) {
  if (!on.can_follow) return;
  const std::span<const Point> vertices = on.output.vertices;
  std::vector<std::uint8_t> used(vertices.size(), 0);
  for (const Triangle& t : on.output.facets)
    for (const Index v : t) used[v] = 1;
  for (const Segment& s : on.output.segments)
    for (const Index v : s) used[v] = 1;
  std::vector<Index> order;
  for (Index v = 0; v < vertices.size(); ++v)
    if (used[v] != 0) order.push_back(v);
  std::sort(order.begin(), order.end(),
            [&](Index a, Index b) { return std::tie(vertices[a], a) < std::tie(vertices[b], b); });
  on.place.assign(on.input.vertices.size(), no_entity);
  for (Index v = 0; v < on.place.size() && v < vertices.size(); ++v) {
    if (used[v] != 0) {
      on.place[v] = v;
      continue;
    }
    if (!finite(vertices[v])) continue;
    const auto at = std::lower_bound(order.begin(), order.end(), vertices[v],
                                     [&](Index a, const Point& p) { return vertices[a] < p; });
    if (at != order.end() && vertices[*at] == vertices[v]) on.place[v] = *at;
  }
}

RepairRule children_near(const RepairExamination& on) {
  constexpr RepairRuleKind kind = RepairRuleKind::children_near;
  if (!is_ready(on)) return not_examined(kind, kCannotFollow);
  Violations violations = on.violations(kind);
  const Reach reach(on.claims.max_displacement);
  for (std::size_t p = 0; p < on.children.size(); ++p) {
    if (on.children[p].empty()) continue;
    const std::array<Point, 3> parent = on.corners_in(static_cast<Index>(p));
    const std::set<Index> far = far_corners(on, p, reach);
    if (far.empty()) continue;
    for (const Index f : on.children[p])
      for (const Index v : on.output.facets[f]) {
        if (!far.contains(v)) continue;
        violations.add([&] {
          return facet_words("output", on.output, f) + ": vertex " + std::to_string(v) + " is " +
                 decimal(rough_distance(on.output.vertices[v], parent)) + " away from its parent " +
                 std::to_string(p) + "; the largest distance is said to be " + decimal(reach.distance());
        });
      }
  }
  return violations.rule("no triangle is further than " + decimal(reach.distance()) +
                         " from any of its parents");
}

RepairRule parents_covered(const RepairExamination& on) {
  constexpr RepairRuleKind kind = RepairRuleKind::parents_covered;
  if (!is_ready(on)) return not_examined(kind, kCannotFollow);
  Violations violations = on.violations(kind);
  const Reach reach(on.claims.max_displacement);
  CoverTest test(on.output.vertices, on.output.facets, reach);
  const std::set<Index> lost = dropped(on);
  std::size_t covered = 0, trimmed = 0;  // the latter: parts removed in a union
  for (std::size_t p = 0; p < on.children.size(); ++p) {
    on.pulse();
    if (on.children[p].empty() || lost.contains(static_cast<Index>(p))) continue;  // another rule
    const auto gap =
        test.gap(on.corners_in(static_cast<Index>(p)), places_of(on, on.input.facets[p]), on.children[p]);
    if (!gap)
      ++covered;
    else if (on.claims.unite.value_or(false))
      ++trimmed;
    else
      violations.add([&] { return facet_words("input", on.input, p) + " is not covered: " + *gap; });
  }
  return violations.rule(
      counted(covered, "input triangle") + ", each within " + decimal(reach.distance()) + " of its children" +
      (trimmed > 0 ? "; of " + std::to_string(trimmed) + (trimmed == 1 ? " a part" : " parts") +
                         " went in the union, which is not examined"
                   : ""));
}

RepairRule segments_covered(const RepairExamination& on) {
  constexpr RepairRuleKind kind = RepairRuleKind::segments_covered;
  if (!is_ready(on)) return not_examined(kind, kCannotFollow);
  Violations violations = on.violations(kind);
  if (!on.claims.segment_parents) return violations.rule("the parents of segments are not told");
  const IndexLists& parents = *on.claims.segment_parents;
  if (on.output.segments.empty() && parents.size() > 0) return violations.rule("the file holds no segments");
  if (parents.size() != on.output.segments.size()) {
    violations.add([&] {
      return "there are parents for " + counted(parents.size(), "segment") + ", and the output has " +
             std::to_string(on.output.segments.size());
    });
    return violations.rule({});
  }
  const Reach reach(on.claims.max_displacement);
  std::vector<std::vector<Segment>> children(on.input.segments.size());
  for (std::size_t s = 0; s < parents.size(); ++s)
    for (const Index p : parents[s]) {
      if (p >= children.size() || !on.is_finite(on.input.segments[p])) {
        violations.add([&] {
          return "output segment " + std::to_string(s) + " names the parent " + std::to_string(p) +
                 ", which is no finite segment of the input";
        });
        continue;
      }
      children[p].push_back(on.output.segments[s]);
      const Point &a = on.input.vertices[on.input.segments[p][0]],
                  &b = on.input.vertices[on.input.segments[p][1]];
      for (const Index v : on.output.segments[s])
        if (!reach.of_segment(on.output.vertices[v], a, b))
          violations.add([&] {
            return "output segment " + std::to_string(s) + ": vertex " + std::to_string(v) + " is " +
                   decimal(rough_distance(on.output.vertices[v], {a, b, a})) + " away from its parent " +
                   std::to_string(p);
          });
    }
  CoverTest test(on.output.vertices, on.output.facets, reach);
  for (std::size_t p = 0; p < children.size(); ++p) {
    on.pulse();
    const Segment& segment = on.input.segments[p];
    if (!on.is_finite(segment)) continue;
    const Point &a = on.input.vertices[segment[0]], &b = on.input.vertices[segment[1]];
    if (children[p].empty() && (a == b || reach.of_point(a, b))) continue;
    if (const auto gap = test.gap({a, b}, {on.place[segment[0]], on.place[segment[1]]}, children[p]))
      violations.add(
          [&] { return words("input segment", p, segment, on.input.vertices) + " is not covered: " + *gap; });
  }
  return violations.rule(counted(children.size(), "input segment"));
}

}  // namespace holdfast::checking
