// A cache of arranged and rounded plane surfaces.
#pragma once

#include <limits>
#include <map>
#include <tuple>
#include <vector>

#include "repair/flatten.h"

namespace holdfast::repairing {

/// While some sheets change, others return again and again, and so do their projections.
class RoundedPlanes {
 public:
  /// Rounds by `round` each surface that is not in the cache.
  [[nodiscard]] RoundPlane rounding(RoundPlane round) {
    return [this, round = std::move(round)](State plane, double most) {
      const auto [at, is_new] = all_.try_emplace({plane.vertices, plane.facets, plane.segments});
      Known& known = at->second;
      if (is_new || (!known.rounded.is_valid && known.most < most)) {
        known.rounded = round(std::move(plane), most);
        // A result that did not move further is invalid for another reason.
        constexpr double kAny = std::numeric_limits<double>::infinity();
        known.most = known.rounded.displacement > most ? most : kAny;
      }
      return known.rounded;
    };
  }

 private:
  struct Known {
    Rounded rounded;
    double most = 0;  // that points were to move
  };
  std::map<std::tuple<std::vector<Point>, std::vector<Triangle>, std::vector<Segment>>, Known> all_;
};

}  // namespace holdfast::repairing
