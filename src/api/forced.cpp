#include "api/forced.h"

#include <algorithm>
#include <cmath>
#include <compare>
#include <numbers>
#include <span>

#include "mesh/anatomy.h"
#include "mesh/keys.h"
#include "mesh/quality.h"
#include "numbers/elementary.h"
#include "numbers/sorted.h"

namespace holdfast {
namespace {

constexpr double kSmall = 10;  // degrees
constexpr std::size_t kMostListed = 100;

std::uint64_t key_of(const Triangle& corners) {
  const Triangle t = ascending(corners);
  std::uint64_t h = t[0] * 0x9E3779B97F4A7C15ull;
  h = (h ^ (h >> 29) ^ t[1]) * 0xBF58476D1CE4E5B9ull;
  return (h ^ (h >> 31) ^ t[2]) * 0x94D049BB133111EBull;
}

double angle_at(const Point& p, const Point& q, const Point& r) {
  double uu = 0, vv = 0, uv = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    uu += (q[k] - p[k]) * (q[k] - p[k]);
    vv += (r[k] - p[k]) * (r[k] - p[k]);
    uv += (q[k] - p[k]) * (r[k] - p[k]);
  }
  return numbers::atan2(std::sqrt(std::max(0.0, uu * vv - uv * uv)), uv) * 180 / std::numbers::pi;
}

class ForcedElements {
 public:
  ForcedElements(const Volume& volume, std::size_t first_added, const std::function<void()>& tell)
      : volume_(volume), first_added_(first_added), tell_(tell) {}

  void find(Report::Field& report) {
    for (Index t = 0; t < volume_.tetrahedra.size(); ++t) {
      tell_();
      const Tetrahedron& c = volume_.tetrahedra[t];
      const auto& v = volume_.vertices;
      if (quality(v[c[0]], v[c[1]], v[c[2]], v[c[3]]) < kQualityOfSmall) continue;
      const std::array<double, 6> angles = dihedral_angles(v[c[0]], v[c[1]], v[c[2]], v[c[3]]);
      const auto least = std::min_element(angles.begin(), angles.end());
      if (*least >= kSmall) continue;
      ++report.below_10_deg;
      std::vector<Index> facets = to_blame(c, static_cast<int>(least - angles.begin()));
      if (facets.empty()) {
        if (std::all_of(c.begin(), c.end(), [&](Index x) { return x < first_added_; })) ++report.across;
        continue;
      }
      ++report.forced;
      report.worst_forced.push_back({t, *least, std::move(facets)});
    }
    std::sort(report.worst_forced.begin(), report.worst_forced.end(), [](const auto& x, const auto& y) {
      return x.min_dihedral_deg != y.min_dihedral_deg ? x.min_dihedral_deg < y.min_dihedral_deg
                                                      : x.tetrahedron < y.tetrahedron;
    });
    if (report.worst_forced.size() > kMostListed) report.worst_forced.resize(kMostListed);
  }

 private:
  // An angle of 10 degrees makes Q larger than this: the inscribed ball is flat between the two faces. Saves
  // most elements from having their angles computed.
  static constexpr double kQualityOfSmall = 2;

  // The faces at an edge are those opposite the other two corners.
  std::vector<Index> to_blame(const Tetrahedron& c, int edge) {
    std::vector<Index> both, small;
    const auto& ends = kEdgeVertex[static_cast<std::size_t>(edge)];
    for (int i = 0; i < 4; ++i) {
      const auto& f = kFaceVertex[static_cast<std::size_t>(i)];
      const Triangle face{c[static_cast<std::size_t>(f[0])], c[static_cast<std::size_t>(f[1])],
                          c[static_cast<std::size_t>(f[2])]};
      const std::optional<Index> facet = facet_at(face);
      if (!facet) continue;
      if (i != ends[0] && i != ends[1]) both.push_back(*facet);
      if (has_small_angle(face)) small.push_back(*facet);
    }
    if (both.size() == 2) return both;
    if (!small.empty()) return small;
    return wedge_at(c[static_cast<std::size_t>(ends[0])], c[static_cast<std::size_t>(ends[1])]);
  }

  struct Wing {
    std::uint64_t key;
    Index facet, apex;  // the corner that is not on the edge
    friend auto operator<=>(const Wing&, const Wing&) = default;
  };
  static std::span<const Wing> with_key(const std::vector<Wing>& wings, std::uint64_t key) {
    const auto first = std::lower_bound(wings.begin(), wings.end(), Wing{key, 0, 0});
    auto last = first;
    while (last != wings.end() && last->key == key) ++last;
    return std::span(wings).subspan(static_cast<std::size_t>(first - wings.begin()),
                                    static_cast<std::size_t>(last - first));
  }

  // Two facets at an edge with a small angle between them: whatever lies there has no larger one.
  std::vector<Index> wedge_at(Index a, Index b) {
    if (by_edge_.empty()) list_edges();
    const auto wings = with_key(by_edge_, edge_key(a, b));
    for (auto i = wings.begin(); i != wings.end(); ++i)
      for (auto j = wings.begin(); j != i; ++j)
        if (angle_between(a, b, i->apex, j->apex) < kSmall) return {j->facet, i->facet};
    return {};
  }

  void list_edges() {
    for (Index f = 0; f < volume_.facets.size(); ++f) {
      tell_();
      const Triangle& c = volume_.facets[f];
      for (std::size_t k = 0; k < 3; ++k)
        by_edge_.push_back({edge_key(c[(k + 1) % 3], c[(k + 2) % 3]), f, c[k]});
    }
    std::sort(by_edge_.begin(), by_edge_.end());
  }

  // Of the half-planes from the line ab through p and through q, in degrees.
  [[nodiscard]] double angle_between(Index a, Index b, Index p, Index q) const {
    const auto& v = volume_.vertices;
    Point axis, to_p, to_q;
    double length2 = 0, along_p = 0, along_q = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      axis[k] = v[b][k] - v[a][k];
      to_p[k] = v[p][k] - v[a][k];
      to_q[k] = v[q][k] - v[a][k];
      length2 += axis[k] * axis[k];
      along_p += axis[k] * to_p[k];
      along_q += axis[k] * to_q[k];
    }
    for (std::size_t k = 0; k < 3; ++k) {
      to_p[k] -= along_p / length2 * axis[k];
      to_q[k] -= along_q / length2 * axis[k];
    }
    return angle_at({0, 0, 0}, to_p, to_q);
  }

  [[nodiscard]] bool has_small_angle(const Triangle& t) const {
    const auto& v = volume_.vertices;
    return std::min({angle_at(v[t[0]], v[t[1]], v[t[2]]), angle_at(v[t[1]], v[t[2]], v[t[0]]),
                     angle_at(v[t[2]], v[t[0]], v[t[1]])}) < kSmall;
  }

  // The table is built when first asked: most volumes have no such element.
  std::optional<Index> facet_at(Triangle face) {
    if (by_key_.empty()) {
      for (Index f = 0; f < volume_.facets.size(); ++f) {
        tell_();
        by_key_.push_back({key_of(volume_.facets[f]), f, 0});
      }
      std::sort(by_key_.begin(), by_key_.end());
    }
    for (const Wing& found : with_key(by_key_, key_of(face)))
      if (std::is_permutation(face.begin(), face.end(), volume_.facets[found.facet].begin()))
        return found.facet;
    return std::nullopt;
  }

  const Volume& volume_;
  const std::size_t first_added_;
  const std::function<void()>& tell_;
  std::vector<Wing> by_key_, by_edge_;  // in their order
};

}  // namespace

void find_forced(const Volume& volume, std::size_t first_added, Report::Field& report,
                 const std::function<void()>& tell) {
  ForcedElements(volume, first_added, tell).find(report);
}

}  // namespace holdfast
