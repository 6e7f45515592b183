// The data of a page: a header and the arrays of its parts.
#pragma once

#include <string>

#include "holdfast/view.h"
#include "io/watch.h"

namespace holdfast::view {

/// Entries of the lists of a page, in the order of its text: causes, gaps, defects, part by part.
struct Entry {
  std::size_t part;
  std::string message;
  enum class Kind { cause, gap, defect } kind;
  std::span<const Index> vertices, facets, segments;
  std::span<const Point> where;
};

/// Nobody reads more entries of one part than this; the text says how many are left out.
inline constexpr std::size_t kMostEntries = 20'000;

[[nodiscard]] std::vector<Entry> entries_of(const Page& page);

/// The header and the arrays, packed. Throws std::invalid_argument if the numbers of tags and entities
/// differ.
[[nodiscard]] std::string packed(const Page& page, const std::vector<Entry>& entries,
                                 std::size_t most_tetrahedra, io::Watch& watch);

}  // namespace holdfast::view
