#include "api/part_details.h"

#include <algorithm>
#include <optional>
#include <span>
#include <vector>

#include "numbers/sorted.h"
#include "repair/near.h"
#include "surface/aabb_tree.h"
#include "surface/describe.h"
#include "text/decimal.h"

namespace holdfast {
namespace {

struct Detail {
  Index vertex, facet;
  double distance;  // in floating point; 0 is ignored
};

bool is_sound(const Complex& joined, const Triangle& t) {
  return std::all_of(t.begin(), t.end(), [&](Index v) {
    return v < joined.vertices.size() && holdfast::is_finite(joined.vertices[v]);
  });
}

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
  std::vector<Box> boxes;
  for (const Index v : vertices) {
    Box box{at(v), at(v)};
    for (std::size_t k = 0; k < 3; ++k) {
      box.low[k] -= most;
      box.high[k] += most;
    }
    boxes.push_back(box);
  }
  for (const Index f : facets) {
    const Triangle& t = joined.facets[f];
    Box box{at(t[0]), at(t[0])};
    for (const Index v : t) box.extend({at(v), at(v)});
    boxes.push_back(box);
  }
  const auto first = static_cast<Index>(vertices.size());
  std::size_t left = 1'000'000 + 64 * facets.size();
  std::optional<Detail> finest;
  AabbTree(boxes).for_each_overlap(
      [&](Index i, Index j) {
        if (i > j) std::swap(i, j);
        if (i >= first || j < first) return true;
        const Index v = vertices[i], f = facets[j - first];
        const Triangle& t = joined.facets[f];
        if (part[f] != part_of_vertex[v] || v == t[0] || v == t[1] || v == t[2]) return true;
        const double distance = repairing::distance_to(at(v), at(t[0]), at(t[1]), at(t[2]));
        if (distance > 0 && distance <= most && (!finest || distance < finest->distance))
          finest = Detail{v, f, distance};
        return --left > 0;
      },
      [](Index, Index) { return false; }, step);
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
