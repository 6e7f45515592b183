// The elements that wait for improvement, the worst first, and those that nothing has helped.
#pragma once

#include <algorithm>
#include <iterator>
#include <tuple>
#include <utility>
#include <vector>

#include "mesh/tet_mesh.h"
#include "numbers/release.h"
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
  /// From this Q on elements are flat.
  explicit Agenda(double flat) : flat_(flat), floor_(flat) {}

  void push(const WaitingElement& e) {
    if (e.quality >= floor_)
      put(e);
    else
      below_.front().push_back({e.quality, e.tet});
  }
  /// Whether an element waits. Elements that are not flat stay outside the heap until the flat ones are done,
  /// and those that are not bad until the bad ones are; if many have failed, the latter are skipped.
  /// Otherwise the heap would hold most of the mesh, mostly for nothing. `corners_of(quality, tet)` is
  /// nothing if the tetrahedron has changed.
  template <typename CornersOf>
  [[nodiscard]] bool has_next(CornersOf&& corners_of) {
    while (heap_.empty()) {
      if (floor_ == 0 || (floor_ == tuning::kBad && has_failed_often())) return false;
      floor_ = floor_ > tuning::kBad ? tuning::kBad : 0;
      lift(corners_of);
    }
    return true;
  }
  [[nodiscard]] const WaitingElement& next() const { return heap_.front(); }
  WaitingElement take() {
    std::pop_heap(heap_.begin(), heap_.end());
    const WaitingElement worst = heap_.back();
    heap_.pop_back();
    return worst;
  }

  /// Leaves an element unchanged. One that is not bad matters only as the worst of all, until the worst is
  /// given up.
  void give_up(const WaitingElement& e) {
    worst_stuck_ = std::max(worst_stuck_, e.quality);
    if (e.quality < tuning::kBad) ++failures_;
    stuck_.push_back(e);
  }
  [[nodiscard]] bool has_failed_often() const { return failures_ >= tuning::kMostFailures; }
  /// The worst Q given up in this round.
  [[nodiscard]] double worst_stuck() const { return worst_stuck_; }
  /// The elements given up and not resumed since.
  [[nodiscard]] std::vector<WaitingElement>& stuck() { return stuck_; }

  /// Flat elements that stayed are tried again once no other waits: changes next to them may have made a way.
  template <typename IsCurrent>
  void try_flat_again(double flat, IsCurrent&& is_current) {
    if ((!heap_.empty() && heap_.front().quality >= flat) || round_ >= tuning::kRounds) return;
    ++round_;
    worst_stuck_ = 0;
    std::erase_if(stuck_, [&](const WaitingElement& e) {
      if (e.quality < flat) return false;
      if (is_current(e)) put(e);
      return true;
    });
  }
  /// All that were given up are tried again.
  template <typename IsCurrent>
  void try_all_again(IsCurrent&& is_current) {
    try_again_from(0, is_current);
  }
  /// Those whose Q is no less than this.
  template <typename IsCurrent>
  void try_again_from(double least, IsCurrent&& is_current) {
    for (const WaitingElement& e : std::exchange(stuck_, {}))
      if (e.quality < least)
        stuck_.push_back(e);
      else if (is_current(e))
        push(e);
    worst_stuck_ = 0;
    round_ = failures_ = 0;
  }

  /// Drops waiting and given-up elements for which `is_wanted` is false.
  template <typename IsWanted>
  void keep(IsWanted&& is_wanted) {
    std::erase_if(heap_, [&](const WaitingElement& e) { return !is_wanted(e.tet); });
    std::make_heap(heap_.begin(), heap_.end());
    for (std::vector<Below>& list : below_)
      std::erase_if(list, [&](const Below& b) { return !is_wanted(b.tet); });
    std::erase_if(stuck_, [&](const WaitingElement& e) { return !is_wanted(e.tet); });
  }
  /// The worst of those that were given up, so many, are tried once more.
  void try_worst_again(std::size_t most) {
    const auto count = static_cast<std::ptrdiff_t>(std::min(most, stuck_.size()));
    std::partial_sort(stuck_.begin(), stuck_.begin() + count, stuck_.end(),
                      [](const WaitingElement& x, const WaitingElement& y) { return y < x; });
    for (std::ptrdiff_t k = 0; k < count; ++k) put(stuck_[static_cast<std::size_t>(k)]);
    stuck_.erase(stuck_.begin(), stuck_.begin() + count);
    worst_stuck_ = 0;
  }
  /// Takes over what waits in others, and what was given up there.
  void take_over(std::vector<Agenda>&& others) {
    floor_ = flat_;
    std::vector<WaitingElement> own = std::exchange(heap_, {});
    std::size_t waiting = own.size();
    for (const Agenda& other : others) waiting += other.heap_.size();
    heap_.reserve(waiting);
    take_all(own);
    for (Agenda& other : others) {
      take_all(other.heap_);
      std::move(other.below_.begin(), other.below_.end(), std::back_inserter(below_));
      stuck_.insert(stuck_.end(), other.stuck_.begin(), other.stuck_.end());
      worst_stuck_ = std::max(worst_stuck_, other.worst_stuck_);
      failures_ += other.failures_;
    }
    std::make_heap(heap_.begin(), heap_.end());
  }

  /// Drops what waits, and gives flat elements one round more: what comes next is of one place. Returns the
  /// agenda as it was.
  Agenda set_aside() {
    Agenda aside = std::move(*this);
    *this = Agenda(aside.flat_);
    stuck_ = aside.stuck_;
    worst_stuck_ = aside.worst_stuck_;
    round_ = tuning::kRounds - 1;
    return aside;
  }

 private:
  // An element that is better than those in the heap.
  struct Below {
    double quality;
    Tet tet;
  };

  // Leaves the heap without order, and the list empty.
  void take_all(std::vector<WaitingElement>& waiting) {
    for (const WaitingElement& e : waiting)
      if (e.quality >= floor_)
        heap_.push_back(e);
      else
        below_.front().push_back({e.quality, e.tet});
    release(waiting);
  }
  void put(const WaitingElement& e) {
    heap_.push_back(e);
    std::push_heap(heap_.begin(), heap_.end());
  }

  // Puts elements that are no longer below the floor into the heap.
  template <typename CornersOf>
  void lift(CornersOf&& corners_of) {
    std::vector<WaitingElement> lifted;
    for (std::vector<Below>& list : below_)
      std::erase_if(list, [&](const Below& b) {
        if (b.quality < floor_) return false;
        if (const auto corners = corners_of(b.quality, b.tet)) lifted.push_back({b.quality, b.tet, *corners});
        return true;
      });
    heap_ = std::move(lifted);
    std::make_heap(heap_.begin(), heap_.end());
  }

  double flat_, floor_;               // of the Q in the heap
  std::vector<WaitingElement> heap_;  // the worst first
  // Most of a mesh, so lists that are taken over stay separate; the first one is for new elements.
  std::vector<std::vector<Below>> below_{1};
  std::vector<WaitingElement> stuck_;
  double worst_stuck_ = 0;
  int round_ = 0, failures_ = 0;
};

}  // namespace holdfast
