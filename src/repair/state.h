// A surface under repair: its present state and the origin of each element.
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

/// Each entity is its own parent.
[[nodiscard]] Parents identity(std::size_t count);
/// Parents of parents, each once, ascending; the lists of `now` are so, too.
[[nodiscard]] Parents composed(const Parents& before, Parents now);
/// In the form that the caller gets.
[[nodiscard]] IndexLists lists_of(const Parents& parents);

struct State {
  std::size_t input_vertices = 0;  ///< the first vertices are those of the input
  std::vector<Point> vertices;
  std::vector<Triangle> facets;
  Parents facet_parents;  ///< facets of the input
  std::vector<Segment> segments;
  Parents segment_parents;
  /// For each facet, whether it is known to fit together with all other known facets.
  std::vector<std::uint8_t> known;
  bool knows_vertices = true;  ///< the same for unused vertices
  /// For each facet, its sheet in an arrangement if all parts of the sheet are known to fit together, else
  /// `no_index`. Empty if there are no sheets.
  std::vector<Index> sheet;

  [[nodiscard]] Complex complex() const { return {vertices, facets, segments, {}, {}}; }
  /// Forgets what is known of a facet.
  void doubt(std::size_t facet) {
    if (!known.empty()) known[facet] = 0;
    if (!sheet.empty()) sheet[facet] = no_index;
  }
  /// Forgets what is known of all facets.
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

/// The box of some vertices, with a margin on all sides.
[[nodiscard]] Box box_round(const State& state, std::span<const Index> corners, double margin);

/// Removes unused vertices that are not of the input. Returns the new numbers, `no_index` for removed
/// vertices.
std::vector<Index> drop_unused(State& state);

/// The state of the unchanged input.
[[nodiscard]] State state_of(const Complex& complex);

/// The exact arrangement of a state. `options` say how, but for what the state knows.
[[nodiscard]] arrange::Arrangement arrangement_of(const State& state, const Step& step,
                                                  arrange::ArrangeOptions options);

/// The state after an arrangement. Unused vertices are removed, except those of the input. New points stand
/// at their nearest doubles. An arrangement is a complex, so facets whose corners are not rounded fit
/// together.
[[nodiscard]] State arranged(const State& before, arrange::Arrangement arrangement);

}  // namespace holdfast::repairing
