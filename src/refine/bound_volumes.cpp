#include "refine/bound_volumes.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <queue>
#include <stdexcept>
#include <string>

#include "exact/volume.h"
#include "mesh/kernel.h"
#include "mesh/measure.h"
#include "refine/elements_of_function.h"
#include "refine/point_setter.h"
#include "refine/regular_elements.h"

namespace holdfast {
namespace {

// An entry for a tetrahedron; its slot may have been given to another one since.
struct Waiting {
  double value;  // larger values come first
  Tet tet;
  TetMesh::Corners corners;
  friend bool operator<(const Waiting& x, const Waiting& y) {
    return x.value != y.value ? x.value < y.value : x.tet > y.tet;
  }
};

class Queue {
 public:
  explicit Queue(const VolumeData& volume) : volume_(volume) {}

  void push(double value, Tet t) { queue_.push({value, t, volume_.mesh.corners(t)}); }
  /// Takes the tetrahedron with the largest value that still exists, or kNone.
  Tet take() {
    while (!queue_.empty()) {
      const Waiting next = queue_.top();
      queue_.pop();
      if (volume_.is_inside(next.tet) && volume_.mesh.corners(next.tet) == next.corners) return next.tet;
    }
    return kNone;
  }

 private:
  const VolumeData& volume_;
  std::priority_queue<Waiting> queue_;
};

using Rims = std::span<const RimFace>;

class VolumeBounder {
 public:
  VolumeBounder(const VolumeData& volume, Monitor& monitor)
      : volume_(volume), mesh_(volume.mesh), monitor_(monitor), setter_(volume), queue_(volume) {}

  BoundStats run() {
    for (Tet t = 0; t < mesh_.slot_count(); ++t)
      if (volume_.is_inside(t)) push_if_large(t);
    for (Tet t = queue_.take(); t != kNone; t = queue_.take()) {
      monitor_.poll_again();
      part(t);
    }
    return stats_;
  }

 private:
  // The ratio of the levels in the proof.
  static constexpr double kLevel = 0.75;

  void push_if_large(Tet t) {
    const TetMesh::Corners& c = mesh_.corners(t);
    const double most = volume_.most_volume(volume_.region_of[t]);
    if (!std::isfinite(most)) return;
    if (exact::is_volume_above(mesh_.position(c[0]), mesh_.position(c[1]), mesh_.position(c[2]),
                               mesh_.position(c[3]), most))
      queue_.push(six_volumes(mesh_, c), t);
  }

  struct Place {
    Point at{};
    bool alone = false;
    double thinnest = -1;
  };

  void part(Tet t) {
    Place best;
    const Point middle = centroid(mesh_, t);
    if (const auto centre = setter_.centre_of(t)) try_at(*centre, t, false, best);
    try_at(middle, t, false, best);
    if (best.thinnest < 0) try_at(middle, t, true, best);
    if (best.thinnest < 0) {
      if (const auto inside = deepest(t)) try_at(*inside, t, true, best);
    }
    if (best.thinnest < 0) {
      ++stats_.stuck;
      return;
    }
    for (const Tet made : setter_.make(best.at, t, best.alone)) push_if_large(made);
    ++stats_.points;
  }

  // Takes the place at which every new tetrahedron is of a lower level and the thinnest new one is fattest.
  void try_at(const Point& x, Tet t, bool alone, Place& best) {
    const double limit = kLevel * six_volumes(mesh_, mesh_.corners(t));
    const std::optional<double> thinnest = setter_.try_at(
        x, t, alone, [&](std::span<const Tet> old, Rims rim, Vertex p) -> std::optional<double> {
          if (std::find(old.begin(), old.end(), t) == old.end()) return std::nullopt;
          double least = 1;
          for (const RimFace& face : rim) {
            const TetMesh::Corners made{face.v[0], face.v[1], face.v[2], p};
            if (!(six_volumes(mesh_, made) <= limit)) return std::nullopt;
            least = std::min(least, fatness_of(mesh_.position(made[0]), mesh_.position(made[1]),
                                               mesh_.position(made[2]), mesh_.position(p)));
          }
          return least;
        });
    if (thinnest && *thinnest > best.thinnest) best = {x, alone, *thinnest};
  }

  // The double that is farthest inside, if the centroid is rounded to the outside.
  [[nodiscard]] std::optional<Point> deepest(Tet t) const {
    const Point middle = centroid(mesh_, t);
    Kernel kernel(mesh_);
    for (int i = 0; i < 4; ++i) {
      const auto f = mesh_.face_vertices(face_code(t, i));
      kernel.add(f[0], f[1], f[2]);
    }
    const exact::PointRef origin{middle.data(), nullptr};
    return kernel.double_at(origin, kernel.centre(origin));
  }

  const VolumeData& volume_;
  TetMesh& mesh_;
  Monitor& monitor_;
  PointSetter setter_;
  Queue queue_;
  BoundStats stats_;
};

class RatioLowerer {
 public:
  RatioLowerer(const VolumeData& volume, double most, Monitor& monitor)
      : volume_(volume),
        mesh_(volume.mesh),
        most_(most),
        monitor_(monitor),
        setter_(volume),
        queue_(volume) {}

  RatioStats run() {
    for (Tet t = 0; t < mesh_.slot_count(); ++t)
      if (volume_.is_inside(t)) push_if_bad(t);
    for (Tet t = queue_.take(); t != kNone; t = queue_.take()) {
      monitor_.poll_again();
      for (const std::optional<Point>& place : {setter_.centre_of(t), std::optional(centroid(mesh_, t))})
        if (place && try_at(*place, t)) break;
    }
    return stats_;
  }

 private:
  // New elements may be as flat as this, or as the flattest that goes.
  static constexpr double kLeastFatness = 0.05;

  [[nodiscard]] double ratio(const TetMesh::Corners& c) const {
    return radius_over_edge(mesh_.position(c[0]), mesh_.position(c[1]), mesh_.position(c[2]),
                            mesh_.position(c[3]));
  }
  [[nodiscard]] double fatness(const TetMesh::Corners& c) const {
    return fatness_of(mesh_.position(c[0]), mesh_.position(c[1]), mesh_.position(c[2]), mesh_.position(c[3]));
  }
  void push_if_bad(Tet t) {
    if (const double r = ratio(mesh_.corners(t)); r > most_) queue_.push(r, t);
  }

  bool try_at(const Point& x, Tet t) {
    const double largest = 6 * volume_.most_volume(volume_.region_of[t]);
    const auto found = setter_.try_at(
        x, t, false, [&](std::span<const Tet> old, Rims rim, Vertex p) -> std::optional<double> {
          std::size_t bad = 0;
          double thinnest = kLeastFatness;
          for (const Tet gone : old) {
            if (ratio(mesh_.corners(gone)) > most_) ++bad;
            thinnest = std::min(thinnest, fatness(mesh_.corners(gone)));
          }
          for (const RimFace& face : rim) {
            const TetMesh::Corners made{face.v[0], face.v[1], face.v[2], p};
            const bool is_bad = ratio(made) > most_;
            if ((is_bad && bad-- <= 1) || fatness(made) < thinnest || six_volumes(mesh_, made) > largest)
              return std::nullopt;
          }
          return bad > 0 ? std::optional(1.0) : std::nullopt;
        });
    if (!found) return false;
    for (const Tet made : setter_.make(x, t, false)) push_if_bad(made);
    ++stats_.points;
    return true;
  }

  const VolumeData& volume_;
  TetMesh& mesh_;
  const double most_;
  Monitor& monitor_;
  PointSetter setter_;
  Queue queue_;
  RatioStats stats_;
};

}  // namespace

BoundStats bound_volumes(const VolumeData& volume, Monitor& monitor) {
  if (volume.most_volumes == nullptr) return {};
  return VolumeBounder(volume, monitor).run();
}

void require_few_enough(const VolumeData& volume, const SizeFunction& sizes) {
  constexpr double kMostTets = 1u << 30;
  // Part of the number of regular tetrahedra of a size. Where facets are large compared to the size, fewer
  // are made: at least a fifth in those measured (docs/field.md).
  constexpr double kPartOfRegular = 0.1;
  double for_volumes = 0;  // the least number of tetrahedra that they take
  for (Tet t = 0; volume.most_volumes != nullptr && t < volume.mesh.slot_count(); ++t) {
    if (!volume.is_inside(t)) continue;
    const double six = six_volumes(volume.mesh, volume.mesh.corners(t));
    if (std::isfinite(six)) for_volumes += six / 6 / volume.most_volume(volume.region_of[t]);
  }
  const std::vector<double> regular = regular_elements(volume);
  const auto require = [](bool few, const char* what) {
    if (!few)
      throw std::length_error(std::string("the ") + what +
                              " asked for takes more than 2^30 tetrahedra; a larger one, or another unit of "
                              "length, is needed");
  };
  require(for_volumes < kMostTets, "largest volume");
  require(kPartOfRegular * std::accumulate(regular.begin(), regular.end(), 0.0) < kMostTets, "size");
  require(!asks_for_more_than(kMostTets / kPartOfRegular, sizes, volume),
          sizes.has_metric() ? "size in the metric" : "size field");
}

RatioStats lower_ratios(const VolumeData& volume, double most, Monitor& monitor) {
  return RatioLowerer(volume, most, monitor).run();
}

}  // namespace holdfast
