// What came of plane surfaces.
#pragma once

#include <limits>
#include <map>
#include <tuple>
#include <vector>

#include "repair/flatten.h"

namespace holdfast::repairing {

/// The same sheets come again and again while others change, and so do what they are in a projection.
class RoundedPlanes {
 public:
  /// Rounds by `round` what has not come before.
  [[nodiscard]] RoundPlane rounding(RoundPlane round) {
    return [this, round = std::move(round)](State plane, double most) {
      const auto [at, is_new] = all_.try_emplace({plane.vertices, plane.facets, plane.segments});
      Known& known = at->second;
      if (is_new || (!known.rounded.is_valid && known.most < most)) {
        known.rounded = round(std::move(plane), most);
        // What did not move further is not valid for another reason.
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
