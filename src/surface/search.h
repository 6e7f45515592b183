// Surface layer: the search for elements of a complex that do not fit together.
//
// Candidate pairs come from the tree of boxes, nearly all pass the certificates, and the rest is decided
// by its contacts. Each violation is reported by its root cause, once:
//   - a vertex inside a side or segment (T-junction) or inside a facet: one finding, however many elements
//     meet there;
//   - two elements whose own interiors meet: one finding for the pair;
//   - if neither applies, two sides that cross, or a side that passes through a facet's interior.
// Every pair of elements that does not fit follows from some finding: one element has the first of the
// finding's two simplices as a face (or is it), the other one the second. And every pair that follows so
// does not fit: a point of two interiors is in no common face.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "holdfast/types.h"
#include "mesh/parallel.h"
#include "surface/contacts.h"
#include "surface/elements.h"

namespace holdfast {

/// Vertices of a vertex, side, segment or facet in ascending order; unused places hold `no_index`.
using Corners = std::array<Index, 3>;

[[nodiscard]] inline unsigned count_of(const Corners& corners) {
  return corners[1] == no_index ? 1 : corners[2] == no_index ? 2 : 3;
}

/// Two simplices whose interiors meet.
struct Finding {
  DefectKind kind;
  Corners first, second;  ///< the simplex with fewer corners first, else the lexicographically lesser
  /// The first offending pair of elements that follows from it, as indices of Elements::all.
  std::array<Index, 2> pair;
  /// The two simplices are the elements of `pair`, and the finding says nothing of other elements.
  bool is_pair;
};

/// Called for each pair i < j of Elements::all that does not fit; returns false to stop.
using VisitPair = std::function<bool(Index i, Index j, const Contacts& contacts)>;
/// Called now and then with the finished share of the work; throws to stop.
using Step = std::function<void(double fraction)>;

/// When the search switches to methods that do not pay off on good surfaces. They change its speed and its
/// order, never its result.
struct SearchTuning {
  std::size_t hub_degree = 64;  ///< facets and segments at a vertex that make it a hub (hubs.h)
  /// Oriented boxes (oriented_box.h) are used after this many tests of two nodes of the tree an element. Good
  /// surfaces need about 5 to 10.
  std::size_t patience = 20;
  /// The same if there are sheets (Known::sheet) with too many pairs to visit them one by one
  /// (sheet_pairs.h): a pair of facets of sheets is decided by fewer signs than two oriented boxes.
  std::size_t sheet_patience = 100;
  Threads threads = 1;
};

/// Which elements are known to fit together; empty lists if nothing is known.
struct Known {
  Known() = default;
  Known(const std::vector<std::uint8_t>& of_all) : each(of_all) {}  // NOLINT(*-explicit-*): the usual case
  Known(std::span<const std::uint8_t> of_all, std::span<const Index> of_sheet,
        std::span<const std::uint8_t> found_before = {})
      : each(of_all), sheet(of_sheet), found(found_before) {}

  /// For each element, whether it fits together with all other elements marked so, as the faces of one
  /// triangulation do.
  std::span<const std::uint8_t> each;
  /// The number of its sheet, or `no_index`: facets of one sheet lie in a plane except for rounding and fit
  /// together.
  std::span<const Index> sheet;
  /// For each element, whether the visitor has already found it: pairs of two such elements are skipped. The
  /// visitor may change this from visit to visit.
  std::span<const std::uint8_t> found;
};

/// Visits every pair of elements that neither meet in a common face nor are disjoint, in no useful order;
/// pairs of known elements are left out. If few elements are not known, this takes little more than a look at
/// each element.
void for_each_offending_pair(const Complex& complex, const Elements& elements, const VisitPair& visit,
                             const Step& step, const SearchTuning& tuning = {}, Known known = {});

/// Whether there is no such pair.
[[nodiscard]] bool all_fit(const Complex& complex, const Elements& elements, Known known, const Step& step,
                           const Threads& threads = 1);

/// Root causes, ordered by `pair`; at most `most` of them, the first that are found.
[[nodiscard]] std::vector<Finding> find_root_causes(const Complex& complex, const Elements& elements,
                                                    std::size_t most, const Step& step,
                                                    const Threads& threads = 1);

}  // namespace holdfast
