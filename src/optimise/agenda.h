// The elements that wait for improvement, the worst first, and those that nothing has helped.
#pragma once

#include <algorithm>
#include <queue>
#include <tuple>
#include <utility>
#include <vector>

#include "mesh/tet_mesh.h"
#include "optimise/tuning.h"

namespace holdfast {

/// An element as it was put down: its slot may have been given to another since.
struct WaitingElement {
  double quality;
  Tet tet;
  TetMesh::Corners corners;
  friend bool operator<(const WaitingElement& x, const WaitingElement& y) {
    return std::tie(x.quality, y.corners, y.tet) < std::tie(y.quality, x.corners, x.tet);
  }
};

class Agenda {
 public:
  void push(const WaitingElement& e) {
    if (takes_all_ || e.quality >= tuning::kBad)
      queue_.push(e);
    else
      rest_.push_back(e);
  }
  /// Whether an element waits. Those that are not bad stand beside the heap, which would hold most of the
  /// mesh with them, and mostly in vain: until the bad ones are done, and unless many have failed.
  [[nodiscard]] bool has_next() {
    if (!queue_.empty()) return true;
    if (rest_.empty() || has_failed_often()) return false;
    queue_ = std::priority_queue<WaitingElement>({}, std::exchange(rest_, {}));
    takes_all_ = true;
    return true;
  }
  [[nodiscard]] const WaitingElement& next() const { return queue_.top(); }
  WaitingElement take() {
    const WaitingElement worst = queue_.top();
    queue_.pop();
    return worst;
  }

  /// An element stays as it is. What is no bad element matters only as the worst of all, until that stays.
  void give_up(const WaitingElement& e) {
    worst_stuck_ = std::max(worst_stuck_, e.quality);
    if (e.quality < tuning::kBad) ++failures_;
    stuck_.push_back(e);
  }
  [[nodiscard]] bool has_failed_often() const { return failures_ >= tuning::kMostFailures; }
  /// The worst Q given up in this round.
  [[nodiscard]] double worst_stuck() const { return worst_stuck_; }
  /// The elements given up, but for those that were taken up again.
  [[nodiscard]] std::vector<WaitingElement>& stuck() { return stuck_; }

  /// Flat elements that stayed are tried again once no other waits: changes next to them may have made a way.
  template <typename IsCurrent>
  void try_flat_again(double flat, IsCurrent&& is_current) {
    if ((!queue_.empty() && queue_.top().quality >= flat) || round_ >= tuning::kRounds) return;
    ++round_;
    worst_stuck_ = 0;
    std::erase_if(stuck_, [&](const WaitingElement& e) {
      if (e.quality < flat) return false;
      if (is_current(e)) queue_.push(e);
      return true;
    });
  }
  /// All that were given up are tried again.
  template <typename IsCurrent>
  void try_all_again(IsCurrent&& is_current) {
    for (const WaitingElement& e : std::exchange(stuck_, {}))
      if (is_current(e)) queue_.push(e);
    worst_stuck_ = 0;
    round_ = failures_ = 0;
  }

  /// Drops what waits, and gives flat elements one round more: what comes next is of one place. Returns the
  /// agenda as it was.
  Agenda set_aside() {
    Agenda aside = std::move(*this);
    *this = {};
    stuck_ = aside.stuck_;
    worst_stuck_ = aside.worst_stuck_;
    round_ = tuning::kRounds - 1;
    return aside;
  }

 private:
  std::priority_queue<WaitingElement> queue_;
  std::vector<WaitingElement> rest_;
  bool takes_all_ = false;
  std::vector<WaitingElement> stuck_;
  double worst_stuck_ = 0;
  int round_ = 0, failures_ = 0;
};

}  // namespace holdfast
