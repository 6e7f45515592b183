// Check: rules on mid-edge nodes, for volumes that have them.
#include <algorithm>
#include <cmath>
#include <string>

#include "check/examination.h"
#include "check/findings.h"
#include "exact/jacobian.h"
#include "numbers/finite.h"
#include "text/count.h"

namespace holdfast::checking {
namespace {

constexpr std::array<std::array<std::size_t, 2>, 6> kTetEdges{
    {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}}};
constexpr std::array<std::array<std::size_t, 2>, 3> kTriangleEdges{{{0, 1}, {1, 2}, {0, 2}}};

/// The use of a node by an element.
struct Use {
  Index a, b;  // the ends of its edge, a < b
  Index node;
  bool on_facet;

  friend bool operator<(const Use& x, const Use& y) {
    return x.a != y.a ? x.a < y.a : x.b != y.b ? x.b < y.b : x.node < y.node;
  }
};

/// All uses of nodes, sorted by edges, and whether their indices are in range.
class Uses {
 public:
  Uses(const Volume& volume, Findings& findings, Pulse& pulse)
      : volume_(volume), findings_(findings), pulse_(pulse) {
    const MidNodes& mid = volume.mid_nodes;
    add<6>("tetrahedron", volume.tetrahedra, mid.tetrahedra, kTetEdges, false);
    add<3>("facet", volume.facets, mid.facets, kTriangleEdges, true);
    std::vector<std::array<Index, 1>> of_segments(mid.segments.size());
    for (std::size_t i = 0; i < of_segments.size(); ++i) of_segments[i] = {mid.segments[i]};
    add<1>("segment", volume.segments, of_segments, std::array<std::array<std::size_t, 2>, 1>{{{0, 1}}},
           true);
    std::sort(uses_.begin(), uses_.end());
  }
  [[nodiscard]] const std::vector<Use>& sorted() const { return uses_; }
  [[nodiscard]] bool sound() const { return sound_; }

 private:
  template <std::size_t N, typename Entity>
  void add(const char* kind, const std::vector<Entity>& entities,
           const std::vector<std::array<Index, N>>& nodes,
           const std::array<std::array<std::size_t, 2>, N>& edges, bool on_facet) {
    const auto bad = [&](const std::string& text) {
      sound_ = false;
      findings_.add([&] { return text; });
    };
    if (entities.size() != nodes.size())
      return bad(std::to_string(nodes.size()) + " of " + std::to_string(entities.size()) + " " + kind +
                 "s have mid-edge nodes");
    const std::size_t first = volume_.vertices.size(), end = first + volume_.mid_nodes.points.size();
    for (std::size_t i = 0; i < entities.size(); ++i)
      for (std::size_t e = 0; e < N; ++e) {
        pulse_();
        const Index a = entities[i][edges[e][0]], b = entities[i][edges[e][1]], node = nodes[i][e];
        if (node < first || node >= end) {
          bad(std::string(kind) + " " + std::to_string(i) + " names the node " + std::to_string(node) +
              ", which is none on an edge");
          continue;
        }
        uses_.push_back({std::min(a, b), std::max(a, b), node, on_facet});
      }
  }

  const Volume& volume_;
  Findings& findings_;
  Pulse& pulse_;
  std::vector<Use> uses_;
  bool sound_ = true;
};

bool is_middle(const Point& p, const Point& a, const Point& b) {
  constexpr double kRounding = 0x1p-50;
  for (std::size_t k = 0; k < 3; ++k)
    if (!(std::abs(p[k] - (0.5 * a[k] + 0.5 * b[k])) <= kRounding * (std::abs(a[k]) + std::abs(b[k]))))
      return false;
  return true;
}

std::string edge_words(const Use& use) {
  return "the edge " + std::to_string(use.a) + "-" + std::to_string(use.b);
}

Rule mid_nodes_placed(const Examination& on, const Uses& uses, Findings& findings) {
  const Volume& volume = on.volume;
  std::vector<bool> used(volume.mid_nodes.points.size(), false);
  std::size_t edges = 0, curved = 0;
  const std::vector<Use>& all = uses.sorted();
  for (std::size_t first = 0, end = 0; first < all.size(); first = end, ++edges) {
    on.pulse();
    const Use& use = all[first];
    bool on_facet = false;
    for (end = first; end < all.size() && all[end].a == use.a && all[end].b == use.b; ++end) {
      on_facet |= all[end].on_facet;
      if (all[end].node != use.node && all[end].node != all[end - 1].node)
        findings.add([&] {
          return edge_words(use) + " has the nodes " + std::to_string(use.node) + " and " +
                 std::to_string(all[end].node);
        });
    }
    const std::size_t node = use.node - volume.vertices.size();
    const Point& p = volume.mid_nodes.points[node];
    if (used[node])
      findings.add([&] {
        return "the node " + std::to_string(use.node) + " lies on several edges, such as " + edge_words(use);
      });
    used[node] = true;
    if (is_middle(p, volume.vertices[use.a], volume.vertices[use.b])) continue;
    ++curved;
    if (!on_facet)
      findings.add([&] {
        return "the node " + std::to_string(use.node) + " " + words(p) + " is not in the middle of " +
               edge_words(use) + ", which is on no facet";
      });
  }
  const auto unused = static_cast<std::size_t>(std::count(used.begin(), used.end(), false));
  if (uses.sound() && unused > 0)
    findings.add([&] { return counted(unused, "node is", "nodes are") + " on no edge"; });
  return judge(
      RuleKind::mid_nodes_placed, findings, "mid-edge nodes misplaced",
      counted(edges, "edge") + " with a node each, " + std::to_string(curved) + " of them curved on facets");
}

Rule jacobians_positive(const Examination& on) {
  const Volume& volume = on.volume;
  Findings findings;
  for (std::size_t t = 0; t < volume.tetrahedra.size(); ++t) {
    on.pulse();
    std::array<Point, 10> nodes;
    for (std::size_t i = 0; i < 4; ++i) nodes[i] = volume.vertices[volume.tetrahedra[t][i]];
    for (std::size_t e = 0; e < 6; ++e)
      nodes[4 + e] = volume.mid_nodes.points[volume.mid_nodes.tetrahedra[t][e] - volume.vertices.size()];
    const bool all_finite = std::all_of(nodes.begin(), nodes.end(), is_finite);
    const exact::Jacobian sign = all_finite ? exact::jacobian_of(nodes) : exact::Jacobian::unknown;
    if (sign == exact::Jacobian::positive) continue;
    findings.add([&] {
      return words("tetrahedron", t, volume.tetrahedra[t], volume.vertices) +
             (sign == exact::Jacobian::unknown ? " is not proven positive" : " is not positive everywhere");
    });
  }
  return judge(RuleKind::jacobians_positive, findings, "elements whose Jacobian is not positive",
               std::to_string(volume.tetrahedra.size()) + " elements, everywhere");
}

}  // namespace

std::array<Rule, 2> second_order(const Examination& on) {
  if (!on.well_formed)
    return {not_examined(RuleKind::mid_nodes_placed, not_well_formed),
            not_examined(RuleKind::jacobians_positive, not_well_formed)};
  Findings findings;
  const Uses uses(on.volume, findings, on.pulse);
  Rule placed = mid_nodes_placed(on, uses, findings);
  if (!uses.sound())
    return {std::move(placed),
            not_examined(RuleKind::jacobians_positive, "the mid-edge nodes are not well formed")};
  return {std::move(placed), jacobians_positive(on)};
}

}  // namespace holdfast::checking
