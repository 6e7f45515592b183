#include "api/parts_apart.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "api/part_distance.h"
#include "mesh/disjoint_sets.h"
#include "numbers/elementary.h"
#include "surface/aabb_tree.h"
#include "surface/describe.h"
#include "surface/places.h"
#include "text/decimal.h"

namespace holdfast {
namespace {

class Finder {
 public:
  Finder(const PasteResult& pasted, const std::function<void()>& step)
      : pasted_(pasted), step_(step), facets_(pasted.parts.size()), sets_(pasted.parts.size()) {
    list_facets();
    unite_touching();
    for (const std::vector<Triangle>& facets : facets_) boxes_.push_back(box_of(facets));
  }

  std::vector<PartApart> run() {
    std::vector<PartApart> apart;
    for (Index set = 0; set < facets_.size(); ++set) {
      if (sets_.root(set) != set || facets_[set].empty()) continue;
      const std::optional<PartApart> found = nearest_to(set);
      if (!found) continue;
      const bool is_known = std::any_of(apart.begin(), apart.end(), [&](const PartApart& other) {
        return std::minmax(other.part, other.nearest) == std::minmax(found->part, found->nearest);
      });
      if (!is_known) apart.push_back(*found);
    }
    return apart;
  }

 private:
  [[nodiscard]] Index part_of(Index facet) const { return pasted_.part_of_facet[facet]; }

  void list_facets() {
    for (std::size_t f = 0; f < pasted_.parents.size(); ++f) {
      const Triangle& t = pasted_.surface.facets[f];
      if (!std::all_of(t.begin(), t.end(), [&](Index v) { return is_finite(v); })) continue;
      Index last = no_entity;
      for (const Index p : pasted_.parents[f])
        if (const Index part = part_of(p); part != last) facets_[last = part].push_back(t);
    }
  }

  [[nodiscard]] bool is_finite(Index v) const {
    const auto& vertices = pasted_.surface.vertices;
    return v < vertices.size() && std::isfinite(vertices[v][0]) && std::isfinite(vertices[v][1]) &&
           std::isfinite(vertices[v][2]);
  }

  void unite_touching() {
    const std::vector<Index> first = first_at_places(pasted_.surface.vertices);
    std::vector<Index> part_at(first.size(), no_entity);
    for (Index part = 0; part < facets_.size(); ++part)
      for (const Triangle& t : facets_[part])
        for (const Index v : t) {
          Index& other = part_at[first[v]];
          if (other == no_entity)
            other = part;
          else
            sets_.unite(part, other);
        }
  }

  [[nodiscard]] Box box_of(const std::vector<Triangle>& facets) const {
    constexpr double kNone = std::numeric_limits<double>::infinity();
    Box box{{kNone, kNone, kNone}, {-kNone, -kNone, -kNone}};
    for (const Triangle& t : facets)
      for (const Index v : t) box.extend({pasted_.surface.vertices[v], pasted_.surface.vertices[v]});
    return box;
  }

  [[nodiscard]] double least(Index part, Index other) const {
    double gap[3];
    for (std::size_t k = 0; k < 3; ++k)
      gap[k] = std::max(
          {0.0, boxes_[part].low[k] - boxes_[other].high[k], boxes_[other].low[k] - boxes_[part].high[k]});
    return numbers::hypot(gap[0], gap[1], gap[2]);
  }

  /// Tests pairs of parts in the order of their boxes' distances, which are lower bounds.
  std::optional<PartApart> nearest_to(Index set) {
    std::vector<std::tuple<double, Index, Index>> pairs;
    for (Index part = 0; part < facets_.size(); ++part)
      for (Index other = 0; other < facets_.size(); ++other)
        if (sets_.root(part) == set && sets_.root(other) != set && !facets_[other].empty() &&
            !facets_[part].empty())
          pairs.emplace_back(least(part, other), part, other);
    std::sort(pairs.begin(), pairs.end());
    std::optional<PartApart> best;
    for (const auto& [bound, part, other] : pairs) {
      if (best && bound >= best->distance) break;
      const NearestPoints found =
          nearest_points(pasted_.surface.vertices, facets_[part], facets_[other], step_);
      if (!best || found.distance < best->distance) best = {part, other, found.distance, found.points};
    }
    return best;
  }

  const PasteResult& pasted_;
  const std::function<void()>& step_;
  std::vector<std::vector<Triangle>> facets_;  // by part
  DisjointSets sets_;                          // of touching parts
  std::vector<Box> boxes_;
};

}  // namespace

std::vector<PartApart> find_apart(const PasteResult& pasted, const std::function<void()>& step) {
  return Finder(pasted, step).run();
}

Warning warn_of_apart(const PasteResult& pasted, const PartApart& apart) {
  return {WarningKind::parts_apart,
          {},
          {},
          {apart.where[0], apart.where[1]},
          pasted.parts[apart.part].name + " and " + pasted.parts[apart.nearest].name +
              " do not touch: they are " + decimal(apart.distance, 6) + " apart, at " +
              place(apart.where[0])};
}

}  // namespace holdfast
