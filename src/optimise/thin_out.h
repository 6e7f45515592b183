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
  /// Vertices that `fresh` does not mark stay, unless their number is beyond the end of `fresh`. An empty
  /// `fresh` marks no vertex, and all may be removed. `poll` is called from time to time.
  Thinner(ImprovedVolume& volume, std::span<const std::uint8_t> fresh, std::function<void()> poll)
      : volume_(volume), contraction_(volume), fresh_(fresh), poll_(std::move(poll)) {}

  /// Contracts vertices onto neighbours while the mesh has more than `least_tets` tetrahedra, ghosts
  /// included. The cost of a contraction is the increase in the weight of the elements there
  /// (small_angles.h), for each element removed. No contraction costs more than `most_cost`, or leaves an
  /// element below 1 degree that is as bad as the worst was. Of sizes, only the user's limits are respected.
  /// A vertex that cost too much is not tried again until something changes there, so later calls must not
  /// allow more. Returns the number of removed vertices.
  std::size_t run(double least_tets, double most_cost);

  /// The number of all tetrahedra when only this part of the tetrahedra at removable vertices is left.
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
