#include "repair/opened.h"

#include <algorithm>
#include <array>
#include <utility>

#include "numbers/sorted.h"
#include "repair/near.h"
#include "surface/complex.h"
#include "surface/places.h"

namespace holdfast::repairing {
namespace {

struct Parts {
  std::vector<Index> all, open;  // in ascending order
};

/// Facets with the same corners become one when parts are joined. So they are one here, too.
struct Sheet {
  Triangle corners;  ///< places, in ascending order
  Index facet;
};

/// In ascending order of their corners.
std::vector<Sheet> sheets_of(const State& state) {
  const std::vector<Index> first = first_at_places(state.vertices);
  std::vector<Sheet> sheets;
  for (Index f = 0; f < state.facets.size(); ++f) {
    const Triangle& t = state.facets[f];
    if (std::any_of(t.begin(), t.end(),
                    [&](Index v) { return v >= first.size() || !is_finite(state.vertices[v]); }))
      continue;
    sheets.push_back({ascending(Triangle{first[t[0]], first[t[1]], first[t[2]]}), f});
  }
  std::sort(sheets.begin(), sheets.end(), [](const Sheet& a, const Sheet& b) {
    return std::pair(a.corners, a.facet) < std::pair(b.corners, b.facet);
  });
  return sheets;
}

/// Parts with facets, and parts with a facet that is alone at one of its sides. A facet that stands for two
/// facets of a part, as where a thin place was pressed flat, leaves no crack in the part.
Parts parts_of(const State& state, std::span<const Index> part) {
  const std::vector<Sheet> sheets = sheets_of(state);
  struct Side {
    std::array<Index, 2> ends;
    std::size_t begin, end;  // of the facets with the same corners
  };
  std::vector<Side> sides;
  Parts parts;
  for (std::size_t begin = 0, end = 0; begin < sheets.size(); begin = end) {
    const Triangle& t = sheets[begin].corners;
    while (end < sheets.size() && sheets[end].corners == t) ++end;
    for (std::size_t i = 0; i < 3; ++i)
      sides.push_back({ascending(std::array{t[i], t[(i + 1) % 3]}), begin, end});
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::pair(a.ends, a.begin) < std::pair(b.ends, b.begin);
  });
  const auto same = [&](std::size_t i, std::size_t j) { return sides[i].ends == sides[j].ends; };
  std::vector<Index> of;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    of.clear();
    for (std::size_t k = sides[i].begin; k < sides[i].end; ++k)
      for (const Index parent : state.facet_parents.of(sheets[k].facet)) of.push_back(part[parent]);
    parts.all.insert(parts.all.end(), of.begin(), of.end());
    if ((i > 0 && same(i, i - 1)) || (i + 1 < sides.size() && same(i, i + 1))) continue;
    sort_odd(of);
    parts.open.insert(parts.open.end(), of.begin(), of.end());
  }
  sort_unique(parts.all);
  sort_unique(parts.open);
  return parts;
}

}  // namespace

Index opened_part(const State& before, const State& after, std::span<const Index> part) {
  const Parts given = parts_of(before, part), now = parts_of(after, part);
  const auto has = [](const std::vector<Index>& parts, Index p) {
    return std::binary_search(parts.begin(), parts.end(), p);
  };
  for (const Index p : given.all)
    if (!has(given.open, p) && (has(now.open, p) || !has(now.all, p))) return p;
  return no_index;
}

}  // namespace holdfast::repairing
