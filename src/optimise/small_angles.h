// What elements with small angles weigh, where their shares are to become less.
#pragma once

#include <array>
#include <cstddef>

#include "optimise/tuning.h"
#include "optimise/volume.h"

namespace holdfast {

class SmallAngles {
 public:
  explicit SmallAngles(const ImprovedVolume& judge) {
    for (std::size_t k = 0; k < from_.size(); ++k)
      from_[k] = judge.energy_of_sine(tuning::kWeightBelow[k].sine);
  }
  /// Of an element with that energy: 0 where its least angle is 30 degrees or more.
  [[nodiscard]] double weight(double energy) const {
    double sum = 0;
    for (std::size_t k = 0; k < from_.size(); ++k)
      sum += energy > from_[k] ? tuning::kWeightBelow[k].weight : 0.0;  // branchless: it is unpredictable
    return sum;
  }

 private:
  std::array<double, tuning::kWeightBelow.size()> from_{};
};

}  // namespace holdfast
