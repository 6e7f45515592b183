// How much work elements may have, so that the time of the optimisation is proportional to the mesh.
#pragma once

#include <algorithm>
#include <cstddef>

#include "optimise/tuning.h"

namespace holdfast {

/// Work is counted in exchanges tried, some 10 microseconds each.
class Budget {
 public:
  /// For a mesh of so many tetrahedra, or for so many of a mesh of `all`.
  explicit Budget(std::size_t tets) : Budget(tets, tets) {}
  Budget(std::size_t tets, std::size_t all)
      : parts_(std::max<std::size_t>(1, all / std::max<std::size_t>(1, tets))),
        most_(std::min(tuning::kMostWork, proportional(tets))),
        usual_(std::min(proportional(tets) / tuning::kUsualShare, tuning::kMostUsual / parts_)) {}

  void spend(std::size_t work) { spent_ += work; }
  void note_gain() { at_gain_ = spent_; }

  /// Elements worth a point come first and may use most of the budget, and several times as much if they
  /// would improve the worst of all, or if something helped recently: clusters are removed one by one.
  [[nodiscard]] bool is_spent(bool worth_a_point, bool betters_the_worst) const {
    if (is_fixed_) return spent_ >= most_;
    const std::size_t budget = worth_a_point ? most_ : usual_;
    const bool is_promising = betters_the_worst || spent_ < at_gain_ + tuning::kIdle;
    return spent_ >=
           (is_promising ? std::min(tuning::kPromisingTimes * budget, tuning::kMostPromising) : budget);
  }
  [[nodiscard]] bool is_half_spent() const { return spent_ >= most_ / 2; }
  [[nodiscard]] double fraction() const { return static_cast<double>(spent_) / static_cast<double>(most_); }

  /// For another search of the same mesh.
  void begin_again() {
    usual_ = std::min(usual_, tuning::kMostUsualAgain / parts_);
    spent_ = at_gain_ = 0;
  }
  /// From now on so much is left, for all elements alike.
  void fix(std::size_t left) {
    most_ = spent_ + left;
    is_fixed_ = true;
  }
  /// The work done after which nothing is done any more, even if the budget is spent now.
  [[nodiscard]] std::size_t end_with(std::size_t more) const { return std::max(most_, spent_) + more; }
  [[nodiscard]] std::size_t spent() const { return spent_; }

 private:
  static std::size_t proportional(std::size_t tets) {
    return tuning::kLeastWork + tuning::kWorkPerTet * tets;
  }

  std::size_t parts_;         // like this one, in the mesh
  std::size_t most_, usual_;  // for elements worth a point, and for the rest
  std::size_t spent_ = 0, at_gain_ = 0;
  bool is_fixed_ = false;
};

}  // namespace holdfast
