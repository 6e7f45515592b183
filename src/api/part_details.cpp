#include "api/part_details.h"

#include <algorithm>
#include <optional>
#include <span>
#include <vector>

#include "numbers/sorted.h"
#include "repair/near.h"
#include "surface/box_pairs.h"
#include "surface/describe.h"
#include "text/decimal.h"

namespace holdfast {
namespace {

// Pairs of a vertex and a facet that are compared at most: more would take long for advice.
constexpr std::size_t kLeastPairs = 1'000'000, kPairsAFacet = 64;

struct Detail {
  Index vertex, facet;
  double distance;  // in floating point; 0 is ignored
};

bool is_sound(const Complex& joined, const Triangle& t) {
  return std::all_of(t.begin(), t.end(), [&](Index v) {
    return v < joined.vertices.size() && holdfast::is_finite(joined.vertices[v]);
  });
}

Box box_round(const Point& p, double margin) {
  Box box{p, p};
  for (std::size_t k = 0; k < 3; ++k) {
    box.low[k] -= margin;
    box.high[k] += margin;
  }
  return box;
}

// The nearest vertex of a part to a facet of the same part, at most `most` apart; the first of those compared
// if there are very many pairs.
std::optional<Detail> finest_detail(const Complex& joined, std::span<const Index> part, double most,
                                    const Step& step) {
  std::vector<Index> facets, vertices, part_of_vertex(joined.vertices.size(), no_index);
  for (Index f = 0; f < joined.facets.size(); ++f) {
    if (!is_sound(joined, joined.facets[f])) continue;
    facets.push_back(f);
    for (const Index v : joined.facets[f]) {
      vertices.push_back(v);
      part_of_vertex[v] = part[f];
    }
  }
  sort_unique(vertices);
  const auto at = [&](Index v) -> const Point& { return joined.vertices[v]; };
  std::vector<Box> round_vertices, round_facets;
  for (const Index v : vertices) round_vertices.push_back(box_round(at(v), most));
  for (const Index f : facets) {
    const Triangle& t = joined.facets[f];
    Box box{at(t[0]), at(t[0])};
    for (const Index v : t) box.extend({at(v), at(v)});
    round_facets.push_back(box);
  }
  std::size_t left = kLeastPairs + kPairsAFacet * facets.size();
  std::optional<Detail> finest;
  const auto compare = [&](Index i, Index j) {
    const Index v = vertices[i], f = facets[j];
    const Triangle& t = joined.facets[f];
    if (part[f] != part_of_vertex[v] || v == t[0] || v == t[1] || v == t[2]) return true;
    const double distance = repairing::distance_to(at(v), at(t[0]), at(t[1]), at(t[2]));
    if (distance > 0 && distance <= most && (!finest || distance < finest->distance))
      finest = Detail{v, f, distance};
    return --left > 0;
  };
  for_each_overlap_between(std::move(round_vertices), round_facets, compare, step);
  return finest;
}

}  // namespace

std::string advice_on_tolerance(const Complex& joined, const PasteResult& of_parts, double tolerance,
                                const Step& step) {
  const std::optional<Detail> detail = finest_detail(joined, of_parts.part_of_facet, tolerance, step);
  if (!detail) return {};
  const PastedPart& part = of_parts.parts[of_parts.part_of_facet[detail->facet]];
  return part.name + " has details smaller than the tolerance, which take one below " +
         decimal(detail->distance, 3) + ": so far is its vertex " +
         std::to_string(detail->vertex - part.first_vertex) + ", at " +
         place(joined.vertices[detail->vertex]) + ", from its triangle " +
         std::to_string(detail->facet - part.first_facet);
}

std::string opened_text(const PastedPart& part, double tolerance, double gap) {
  const std::string text = part.name + " was closed, and is not once it is brought together within ";
  if (tolerance > 0) return text + decimal(tolerance) + " of the others";
  return text + decimal(gap, 3) +
         " of the others, as near as coordinates are rounded; coordinates of more digits, or nearer to the "
         "origin, may help";
}

}  // namespace holdfast
