// Elements that come too near to each other for rounding to leave them apart: what lies within a distance of
// each other is joined, by bending facets rather than by moving vertices.
#pragma once

#include <cstdint>

#include "mesh/parallel.h"
#include "repair/state.h"
#include "surface/search.h"

namespace holdfast::repairing {

/// What the elements of a state that do not fit together are made of.
struct Trouble {
  std::vector<Index> facets, segments;  ///< ascending
  bool is_all = true;                   ///< else the search has stopped, and there may be more
  [[nodiscard]] std::size_t size() const { return facets.size() + segments.size(); }
  [[nodiscard]] bool none() const { return size() == 0; }
};

/// Stops once there are more than `most` of them; else the state knows the other facets from then on.
[[nodiscard]] Trouble trouble_of(State& state, const Step& step, const Threads& threads,
                                 std::size_t most = SIZE_MAX);

/// Vertices that were compared with a side or a facet, and how many of them may be. A few facets may be led
/// to and fro through each other's vertices for minutes.
struct Work {
  std::size_t most = SIZE_MAX;
  std::size_t done = 0;
  [[nodiscard]] bool is_spent() const { return done >= most; }
  [[nodiscard]] std::size_t left() const { return is_spent() ? 0 : most - done; }
};

/// Sides between which a vertex is put where they pass each other. Free ones have one facet.
enum class Passings { none, free, all };

struct Settle {
  double gap = 0;
  double most = 0;           ///< nothing is moved or bent further in all; 0: no limit but some gaps
  bool moves_input = false;  ///< vertices of the input may move, too
  Passings passings = Passings::all;
  /// Ends early where there are more facets than that.
  std::size_t most_facets = SIZE_MAX;
};

/// Round the facets and segments in trouble,
///   1. vertices that are new, or all, become one with another of lower number that is at most `gap` away;
///   2. where two of the sides in question pass each other at most `gap` away, a new vertex is put between
///   them;
///   3. sides that pass a vertex at most `gap` away are led through it, in all facets that have them;
///   4. facets that pass a vertex so are led through it.
/// Afterwards facets may still cross, or be of no area. Returns the largest distance by which anything was
/// moved or bent, rounded up. Bending ends early when the work is spent.
double settle(State& state, const Trouble& trouble, const Settle& how, Work& work, const Step& step);

}  // namespace holdfast::repairing
