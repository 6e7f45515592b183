#include "api/bounds.h"

#include <algorithm>
#include <limits>
#include <map>
#include <mutex>

#include "exact/volume.h"
#include "mesh/quality.h"
#include "numbers/vector.h"
#include "refine/point_setter.h"
#include "text/decimal.h"

namespace holdfast {
namespace {

constexpr double kNoBound = std::numeric_limits<double>::infinity();

class Judge {
 public:
  Judge(const Options& options, const Volume& volume)
      : volume_(volume),
        everywhere_(bound_of(options.sizes->max_volume)),
        most_ratio_(options.sizes->max_ratio) {
    for (const RegionSeed& seed : options.regions) {
      double& bound = of_region_.try_emplace(seed.id, everywhere_).first->second;
      bound = std::min(bound, bound_of(seed.max_volume));
    }
  }

  [[nodiscard]] bool has_any() const {
    return most_ratio_ > 0 || everywhere_ < kNoBound ||
           std::any_of(of_region_.begin(), of_region_.end(),
                       [](const auto& r) { return r.second < kNoBound; });
  }

  struct Found {
    Report::Bounds report;
    Index large = no_entity;  ///< the first tetrahedron above its bound

    void add(const Found& other) {
      report.fullest = std::max(report.fullest, other.report.fullest);
      report.flat += other.report.flat;
      report.worst_ratio = std::max(report.worst_ratio, other.report.worst_ratio);
      report.above_ratio += other.report.above_ratio;
      large = std::min(large, other.large);
    }
  };
  void look_at(Index t, Found& found) const {
    const auto& [a, b, c, d] = volume_.tetrahedra[t];
    const Point &p = volume_.vertices[a], &q = volume_.vertices[b], &r = volume_.vertices[c],
                &s = volume_.vertices[d];
    if (most_ratio_ > 0) {
      const double ratio = radius_over_edge(p, q, r, s);
      found.report.worst_ratio = std::max(found.report.worst_ratio, ratio);
      if (ratio > most_ratio_) ++found.report.above_ratio;
    }
    const double bound = bound_at(t);
    if (!(bound < kNoBound)) return;
    if (exact::is_volume_above(p, q, r, s, bound)) found.large = std::min(found.large, t);
    found.report.fullest =
        std::max(found.report.fullest, std::min(dot(q - p, cross(r - p, s - p)) / 6 / bound, kNoBound));
    const std::array<double, 6> angles = dihedral_angles(p, q, r, s);
    if (!(*std::min_element(angles.begin(), angles.end()) >= kFlatDegrees)) ++found.report.flat;
  }
  [[nodiscard]] double bound_at(Index t) const {
    const auto at = of_region_.find(volume_.regions[t]);
    return at == of_region_.end() ? everywhere_ : at->second;
  }

 private:
  static constexpr double kFlatDegrees = 10;
  static double bound_of(double volume) { return volume > 0 ? volume : kNoBound; }

  const Volume& volume_;
  const double everywhere_, most_ratio_;
  std::map<int, double> of_region_;  // by id
};

}  // namespace

void judge_bounds(const Options& options, const Threads& threads, Result& result) {
  constexpr int kDigits = 6;
  const Judge judge(options, result.volume);
  if (!judge.has_any()) return;
  Judge::Found found;
  std::mutex mutex;
  parallel_ranges(threads, result.volume.tetrahedra.size(), [&](std::size_t first, std::size_t last) {
    Judge::Found own;
    for (std::size_t t = first; t < last; ++t) judge.look_at(static_cast<Index>(t), own);
    const std::scoped_lock lock(mutex);
    found.add(own);
  });
  Report::Bounds& report = result.report.bounds;
  found.report.points = report.points;
  found.report.ratio_points = report.ratio_points;
  report = found.report;
  if (found.large == no_entity) return;
  result.outcome = Outcome::not_representable;
  result.message = "tetrahedron " + std::to_string(found.large) + " is larger than " +
                   decimal(judge.bound_at(found.large), kDigits) +
                   ", and holds no point in double precision to part it";
}

}  // namespace holdfast
