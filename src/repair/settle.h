// Joins elements that are too near to each other to stay apart when rounded. Facets bend rather than vertices
// move.
#pragma once

#include <cstdint>

#include "mesh/parallel.h"
#include "repair/state.h"
#include "surface/search.h"

namespace holdfast::repairing {

/// The facets and segments of a state that do not fit together.
struct Trouble {
  std::vector<Index> facets, segments;  ///< ascending
  bool is_all = true;                   ///< false: the search has stopped, and there may be more
  [[nodiscard]] std::size_t size() const { return facets.size() + segments.size(); }
  [[nodiscard]] bool none() const { return size() == 0; }
};

/// Finds the elements in trouble. Stops once there are more than `most`; otherwise the state then knows that
/// all other facets fit together.
[[nodiscard]] Trouble trouble_of(State& state, const Step& step, const Threads& threads,
                                 std::size_t most = SIZE_MAX);

/// All facets and segments whose corners exist and are finite.
[[nodiscard]] Trouble everything(const State& state);

/// Number of comparisons of a vertex with a side or facet, and its limit. Without a limit, a few facets may
/// be led to and fro through each other's vertices for minutes.
struct Work {
  std::size_t most = SIZE_MAX;
  std::size_t done = 0;
  [[nodiscard]] bool is_spent() const { return done >= most; }
  [[nodiscard]] std::size_t left() const { return is_spent() ? 0 : most - done; }
};

/// Which sides get a vertex where they pass each other.
enum class Passings {
  none,
  bodies,  ///< free sides, which have one facet; and sides of two bodies, if no facet of one lies in the
           ///< other
  edges,   ///< free sides; and other sides, if no facet of one lies in a facet of the other
  all
};

/// What vertices do to a side or facet if all that are near lie exactly on it. A cut makes them common
/// vertices, too, but in all facets of a plane at once, so that they have common triangles there.
enum class Touching { bends, is_left };

struct Settle {
  double gap = 0;
  double most = 0;           ///< limit of moving and bending in all; 0: only the limit of some gaps
  bool moves_input = false;  ///< vertices of the input may move, too
  Passings passings = Passings::all;
  /// Ends early with more facets than this.
  std::size_t most_facets = SIZE_MAX;
  Touching touching = Touching::bends;
};

/// Round the facets and segments in trouble,
///   1. new vertices, or all, become one with a vertex of lower number at most `gap` away;
///   2. where two sides of the kind `passings` pass each other at most `gap` away, a new vertex is put
///   between them;
///   3. a side that passes a vertex at most `gap` away is led through it, in all facets of the side;
///   4. a facet that passes a vertex at most `gap` away is led through it.
/// Afterwards facets may still cross, or have no area. Returns the largest distance by which anything was
/// moved or bent, rounded up. Bending ends early when the work is spent.
double settle(State& state, const Trouble& trouble, const Settle& how, Work& work, const Step& step);

}  // namespace holdfast::repairing
