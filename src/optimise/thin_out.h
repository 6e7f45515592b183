// Removes free vertices that do not pay, those of the least cost first: field points that facets make
// useless, and points beside elements that would be better without them.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <queue>
#include <span>
#include <utility>
#include <vector>

#include "optimise/contraction.h"
#include "optimise/small_angles.h"
#include "optimise/volume.h"

namespace holdfast {

class Thinner {
 public:
  /// Vertices that `fresh` does not mark stay, unless they are higher than it tells of; none is marked where
  /// it is empty, and all may go. `poll` is called now and then.
  Thinner(ImprovedVolume& volume, std::span<const std::uint8_t> fresh, std::function<void()> poll)
      : volume_(volume), contraction_(volume), fresh_(fresh), poll_(std::move(poll)) {}

  /// Contracts vertices onto neighbours, as long as more than `least_tets` tetrahedra, ghosts included, are
  /// left in the mesh. A contraction costs what the elements there weigh more than before (small_angles.h),
  /// for each that goes. None is made that costs more than `most_cost`, or leaves an element below 1 degree
  /// that is as bad as the worst was. Of sizes, those that the user allows are heeded. What has cost too much
  /// is not looked at again where nothing has changed: later calls must not allow more. Returns how many
  /// vertices went.
  std::size_t run(double least_tets, double most_cost);

  /// All tetrahedra, if of those at vertices that may go only that part is left.
  [[nodiscard]] double tets_where_left(double part) const;

 private:
  struct Entry {
    double cost;
    Vertex v;
    friend bool operator<(const Entry& x, const Entry& y) {
      return x.cost != y.cost ? x.cost > y.cost : x.v > y.v;
    }
  };

  [[nodiscard]] bool may_go(Vertex v) const {
    return volume_.may_move(v) && (v >= fresh_.size() || fresh_[v] != 0);
  }
  void push(Vertex v, double most_cost);
  [[nodiscard]] double cost_of(Vertex v, double most);
  [[nodiscard]] double longest_at(Vertex v, Tet t) const;
  [[nodiscard]] double burden_of(double energy) const;
  [[nodiscard]] double burden_of_listed(double worst, double limit) const;

  ImprovedVolume& volume_;
  Contraction contraction_;
  std::span<const std::uint8_t> fresh_;
  std::function<void()> poll_;
  std::optional<SmallAngles> small_;
  std::priority_queue<Entry> queue_;
  std::vector<std::uint8_t> is_queued_;  // by vertex
  std::vector<Vertex> link_;
};

}  // namespace holdfast
