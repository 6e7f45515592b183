// A surface under repair: what it is by now, and where all of it came from.
#pragma once

#include <vector>

#include "arrange/arrange.h"
#include "holdfast/repair.h"
#include "holdfast/types.h"
#include "surface/aabb_tree.h"
#include "surface/elements.h"
#include "surface/search.h"

namespace holdfast::repairing {

using arrange::Parents;

/// Each its own parent.
[[nodiscard]] Parents identity(std::size_t count);
/// Parents of parents, each once, ascending.
[[nodiscard]] Parents composed(const Parents& before, const Parents& now);
/// As they are told to the caller.
[[nodiscard]] IndexLists lists_of(const Parents& parents);

struct State {
  std::size_t input_vertices = 0;  ///< the first vertices are the input's
  std::vector<Point> vertices;
  std::vector<Triangle> facets;
  Parents facet_parents;  ///< facets of the input
  std::vector<Segment> segments;
  Parents segment_parents;
  /// For each facet whether it is known to fit together with all others of which that is known.
  std::vector<std::uint8_t> known;
  bool knows_vertices = true;  ///< the same holds for vertices that nothing uses
  /// For each facet the sheet of an arrangement that it is a part of, if all parts of that are known to fit
  /// together, else `no_index`; empty where there are none.
  std::vector<Index> sheet;

  [[nodiscard]] Complex complex() const { return {vertices, facets, segments, {}, {}}; }
  /// Nothing is known of a facet from now on.
  void doubt(std::size_t facet) {
    if (!known.empty()) known[facet] = 0;
    if (!sheet.empty()) sheet[facet] = no_index;
  }
  /// Nor of any.
  void doubt_all() {
    known.clear();
    sheet.clear();
  }
};

/// `State::known` and `State::sheet` for the elements of its complex.
struct KnownElements {
  KnownElements(const State& state, const Elements& elements);
  [[nodiscard]] Known known() const { return {each_, sheet_}; }

 private:
  std::vector<std::uint8_t> each_;
  std::vector<Index> sheet_;
};

/// The box of some vertices, wider by a margin on all sides.
[[nodiscard]] Box box_round(const State& state, std::span<const Index> corners, double margin);

/// Takes out vertices that are not the input's and that nothing uses. Returns the new numbers, `no_index` of
/// what went.
std::vector<Index> drop_unused(State& state);

/// The input as it came.
[[nodiscard]] State state_of(const Complex& complex);

/// The exact arrangement of a state.
[[nodiscard]] arrange::Arrangement arrangement_of(const State& state, std::size_t most_points,
                                                  const Step& step, const Threads& threads);

/// What an arrangement makes of a state; vertices that nothing uses go, but for the input's. New points stand
/// at their nearest doubles, which are `distances` away, one each. An arrangement is a complex, so facets
/// whose corners are not rounded fit together.
[[nodiscard]] State arranged(const State& before, const arrange::Arrangement& arrangement,
                             std::span<const double> distances);

}  // namespace holdfast::repairing
