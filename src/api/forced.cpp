#include "api/forced.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <span>

#include "mesh/anatomy.h"
#include "mesh/quality.h"
#include "mesh/quality_below.h"
#include "numbers/elementary.h"

namespace holdfast {
namespace {

constexpr double kSmall = 10;  // degrees
constexpr std::size_t kMostListed = 100;

double angle_at(const Point& p, const Point& q, const Point& r) {
  double uu = 0, vv = 0, uv = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    uu += (q[k] - p[k]) * (q[k] - p[k]);
    vv += (r[k] - p[k]) * (r[k] - p[k]);
    uv += (q[k] - p[k]) * (r[k] - p[k]);
  }
  return numbers::atan2(std::sqrt(std::max(0.0, uu * vv - uv * uv)), uv) * 180 / std::numbers::pi;
}

// The facets at each vertex, in ascending order.
class FacetsAtVertices {
 public:
  FacetsAtVertices(const std::vector<Triangle>& facets, std::size_t vertices,
                   const std::function<void()>& tell)
      : first_(vertices + 1, 0), facets_(3 * facets.size()) {
    for (const Triangle& t : facets) {
      tell();
      for (const Index v : t) ++first_[v + 1];
    }
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    for (Index f = 0; f < facets.size(); ++f) {
      tell();
      for (const Index v : facets[f]) facets_[next[v]++] = f;
    }
  }

  /// The facets at the vertex that has the fewest of them: some vertices have thousands.
  template <std::size_t N>
  [[nodiscard]] std::span<const Index> at_least_of(const std::array<Index, N>& vertices) const {
    return at(*std::min_element(vertices.begin(), vertices.end(),
                                [this](Index v, Index w) { return at(v).size() < at(w).size(); }));
  }

 private:
  [[nodiscard]] std::span<const Index> at(Index v) const {
    return std::span(facets_).subspan(first_[v], first_[v + 1] - first_[v]);
  }

  std::vector<std::size_t> first_;  // in facets_, by vertex
  std::vector<Index> facets_;
};

// An element with an angle of 10 degrees has a Q above this, because its inscribed ball is flat between the
// two faces. This avoids computing the angles of most elements.
constexpr double kQualityOfSmall = 2;

struct SmallAngle {
  Index tetrahedron;
  double degrees;
  int edge;
};

void note_small_angle(const Volume& volume, Index t, std::vector<SmallAngle>& small) {
  const auto& v = volume.vertices;
  const auto& [a, b, c, d] = volume.tetrahedra[t];
  if (is_quality_below(v[a], v[b], v[c], v[d], kQualityOfSmall)) return;
  const std::array<double, 6> angles = dihedral_angles(v[a], v[b], v[c], v[d]);
  const auto least = std::min_element(angles.begin(), angles.end());
  if (*least < kSmall) small.push_back({t, *least, static_cast<int>(least - angles.begin())});
}

// In the order of the tetrahedra.
std::vector<SmallAngle> small_angles(const Volume& volume, const Threads& threads) {
  constexpr std::size_t kBlock = 16384;
  const std::size_t count = volume.tetrahedra.size();
  std::vector<std::vector<SmallAngle>> blocks((count + kBlock - 1) / kBlock);
  parallel(threads, blocks.size(), [&](std::size_t k) {
    for (std::size_t t = k * kBlock; t < std::min(count, (k + 1) * kBlock); ++t)
      note_small_angle(volume, static_cast<Index>(t), blocks[k]);
  });
  std::vector<SmallAngle> all;
  for (const auto& own : blocks) all.insert(all.end(), own.begin(), own.end());
  return all;
}

class ForcedElements {
 public:
  ForcedElements(const Volume& volume, std::size_t first_added, const std::function<void()>& tell)
      : volume_(volume), first_added_(first_added), tell_(tell) {}

  void find(const std::vector<SmallAngle>& all, Report::Field& report) {
    for (const SmallAngle& small : all) {
      tell_();
      const Tetrahedron& c = volume_.tetrahedra[small.tetrahedron];
      ++report.below_10_deg;
      std::vector<Index> facets = to_blame(c, small.edge);
      if (facets.empty()) {
        if (std::all_of(c.begin(), c.end(), [&](Index x) { return x < first_added_; })) ++report.across;
        continue;
      }
      ++report.forced;
      report.worst_forced.push_back({small.tetrahedron, small.degrees, std::move(facets)});
    }
    std::sort(report.worst_forced.begin(), report.worst_forced.end(), [](const auto& x, const auto& y) {
      return x.min_dihedral_deg != y.min_dihedral_deg ? x.min_dihedral_deg < y.min_dihedral_deg
                                                      : x.tetrahedron < y.tetrahedron;
    });
    if (report.worst_forced.size() > kMostListed) report.worst_forced.resize(kMostListed);
  }

 private:
  // The faces at an edge are opposite the other two corners.
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

  // A facet at an edge, and its corner that is not on it.
  struct Wing {
    Index facet, apex;
  };
  // Two facets at an edge with a small angle between them, which bounds the angle of every element in
  // between.
  std::vector<Index> wedge_at(Index a, Index b) {
    std::vector<Wing> wings;
    for (const Index f : facets_at().at_least_of(std::array{a, b})) {
      const Triangle& t = volume_.facets[f];
      const auto is_on = [&](Index v) { return v == a || v == b; };
      if (std::count_if(t.begin(), t.end(), is_on) == 2)
        wings.push_back({f, *std::find_if_not(t.begin(), t.end(), is_on)});
    }
    for (auto i = wings.begin(); i != wings.end(); ++i)
      for (auto j = wings.begin(); j != i; ++j)
        if (angle_between(a, b, i->apex, j->apex) < kSmall) return {j->facet, i->facet};
    return {};
  }

  // The angle between the half-planes from the line ab through p and through q, in degrees.
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

  [[nodiscard]] std::optional<Index> facet_at(const Triangle& face) {
    for (const Index f : facets_at().at_least_of(face))
      if (std::is_permutation(face.begin(), face.end(), volume_.facets[f].begin())) return f;
    return std::nullopt;
  }

  // Built on first use, because most volumes have no such element.
  const FacetsAtVertices& facets_at() {
    if (!facets_at_) facets_at_.emplace(volume_.facets, volume_.vertices.size(), tell_);
    return *facets_at_;
  }

  const Volume& volume_;
  const std::size_t first_added_;
  const std::function<void()>& tell_;
  std::optional<FacetsAtVertices> facets_at_;
};

}  // namespace

void find_forced(const Volume& volume, std::size_t first_added, Report::Field& report, const Threads& threads,
                 const std::function<void()>& tell) {
  ForcedElements(volume, first_added, tell).find(small_angles(volume, threads), report);
}

}  // namespace holdfast
