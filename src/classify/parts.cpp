#include "classify/parts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "mesh/disjoint_sets.h"
#include "numbers/sorted.h"
#include "numbers/vector.h"
#include "surface/aabb_tree.h"
#include "surface/describe.h"
#include "text/decimal.h"

namespace holdfast {
namespace {

/// Regions as one part sees them: regions separated only by facets of other parts are one region.
class Alone {
 public:
  Alone(const Regions& regions, const PartsOfComplex& parts, Index part, const std::vector<Index>& facets,
        const std::vector<std::array<RegionId, 2>>& airs)
      : sets_(regions.count) {
    for (const auto& [front, back] : airs) sets_.unite(front, back);
    std::vector<RegionId> number(regions.count, kNone);
    number[sets_.root(0)] = 0;
    for (RegionId r = 0; r < regions.count; ++r) {
      RegionId& of_root = number[sets_.root(r)];
      if (of_root == kNone) of_root = seen_.count++;
    }
    of_region_.reserve(regions.count);
    for (RegionId r = 0; r < regions.count; ++r) of_region_.push_back(number[sets_.root(r)]);
    for (const Index f : facets)
      for (const PartWall& wall : parts.of_facet(f)) {
        if (wall.part != part) continue;
        const auto& [front, back] = regions.of_facet[f];
        facets_.push_back(f);
        seen_.of_facet.push_back(wall.is_turned ? std::array{of_region_[back], of_region_[front]}
                                                : std::array{of_region_[front], of_region_[back]});
      }
  }

  /// By region as the part sees it: whether the part holds it. Conflicts are reported to `holders`.
  [[nodiscard]] std::vector<bool> held(Keep keep, Holders& holders) const {
    std::vector<bool> held(seen_.count, true);
    held[0] = false;
    if (keep == Keep::bounded) return held;
    const Winding winding = winding_numbers(seen_);
    if (winding.conflict) {
      if (!holders.conflict)
        holders.conflict = {facets_[(*winding.conflict)[0]], facets_[(*winding.conflict)[1]]};
      for (const Index f : turned_facets(seen_)) holders.turned.push_back(facets_[f]);
      return held;
    }
    for (RegionId r = 1; r < seen_.count; ++r) held[r] = winding.number[r] != 0;
    return held;
  }

  /// The region as the part sees it.
  [[nodiscard]] RegionId operator[](RegionId r) const { return of_region_[r]; }

 private:
  DisjointSets sets_;
  Regions seen_;
  std::vector<RegionId> of_region_;  // by region
  std::vector<Index> facets_;        // by facet of seen_
};

/// Pairs of regions on the sides of some facet, with the parts that have a facet there, in ascending order.
using Between = std::map<std::array<RegionId, 2>, std::vector<Index>>;

/// The pairs of regions that are connected where a part has no facets.
class Airs {
 public:
  Airs(const Regions& regions, const PartsOfComplex& parts) {
    std::vector<Index> own;
    for (std::size_t f = 0; f < regions.of_facet.size(); ++f) {
      const auto& [front, back] = regions.of_facet[f];
      if (front == back) continue;
      own.clear();
      for (const PartWall& wall : parts.of_facet(f)) own.push_back(wall.part);
      sort_unique(own);
      const auto [at, is_new] = always_.try_emplace({std::min(front, back), std::max(front, back)}, own);
      if (is_new) continue;
      std::erase_if(at->second, [&](Index p) { return !std::binary_search(own.begin(), own.end(), p); });
    }
  }

  [[nodiscard]] std::vector<std::array<RegionId, 2>> of(Index part) const {
    std::vector<std::array<RegionId, 2>> airs;
    for (const auto& [pair, parts] : always_)
      if (!std::binary_search(parts.begin(), parts.end(), part)) airs.push_back(pair);
    return airs;
  }

 private:
  Between always_;  // by pair of regions: parts of all facets between them
};

struct ByPart {
  std::vector<std::vector<Index>> facets;
  explicit ByPart(const PartsOfComplex& parts) : facets(parts.parts.size()) {
    for (Index f = 0; f + 1 < parts.first.size(); ++f)
      for (const PartWall& wall : parts.of_facet(f))
        if (auto& list = facets[wall.part]; list.empty() || list.back() != f) list.push_back(f);
  }
};

}  // namespace

Holders find_holders(const Regions& regions, const PartsOfComplex& parts, Keep keep, const FindRegion& find) {
  Holders holders;
  holders.of_region.resize(regions.count);
  const Airs airs(regions, parts);
  const ByPart by_part(parts);
  for (Index p = 0; p < parts.parts.size(); ++p) {
    const PastedPart& part = parts.parts[p];
    const Alone alone(regions, parts, p, by_part.facets[p], airs.of(p));
    std::vector<bool> held = alone.held(keep, holders);
    std::vector<std::optional<int>> ids(held.size());
    for (const RegionSeed& seed : part.seeds) {
      const RegionId r = alone[find(seed.where, "region seed")];
      ids[r] = seed.id;
      if (keep == Keep::automatic && r != 0) held[r] = true;
    }
    for (const Point& hole : part.holes) held[alone[find(hole, "hole")]] = false;
    for (RegionId r = 1; r < regions.count; ++r)
      if (held[alone[r]]) holders.of_region[r].push_back({p, ids[alone[r]]});
  }
  sort_unique(holders.turned);
  return holders;
}

std::vector<double> thickness_of_common(const Regions& regions, const Holders& holders,
                                        const Complex& complex, int scale) {
  struct Measures {
    std::optional<Point> origin;
    double volume = 0, area = 0;
  };
  std::vector<Measures> measures(regions.count);
  const auto scaled = [&](Index v) {
    Point p = complex.vertices[v];
    for (double& x : p) x = std::ldexp(x, scale);
    return p;
  };
  for (std::size_t f = 0; f < regions.of_facet.size(); ++f) {
    const auto& [front, back] = regions.of_facet[f];
    if (front == back) continue;
    const auto& [a, b, c] = complex.facets[f];
    for (const RegionId r : {front, back}) {
      if (holders.of_region[r].size() < 2) continue;
      Measures& of = measures[r];
      const Point p = scaled(a);
      if (!of.origin) of.origin = p;
      const Vector n = cross(scaled(b) - p, scaled(c) - p);
      const double six_volumes = dot(p - *of.origin, n);
      of.volume += (r == front ? six_volumes : -six_volumes) / 6;
      of.area += length(n) / 2;
    }
  }
  std::vector<double> thickness(regions.count, 0);
  for (RegionId r = 0; r < regions.count; ++r)
    if (const Measures& of = measures[r]; of.area > 0)
      thickness[r] = std::ldexp(2 * std::fabs(of.volume) / of.area, -scale);
  return thickness;
}

void settle_thin_regions(const std::vector<double>& thickness, const PartsOfComplex& parts,
                         Holders& holders) {
  for (RegionId r = 0; r < thickness.size(); ++r) {
    auto& claims = holders.of_region[r];
    if (claims.size() < 2 || !(thickness[r] <= parts.gap)) continue;
    claims = {parts.overlap == Overlap::last ? claims.back() : claims.front()};
  }
}

std::vector<PartOverlap> find_overlaps(const Regions& regions, const Holders& holders, const Complex& complex,
                                       const std::vector<double>& thickness) {
  struct Common {
    Box box;
    double thickness = 0;
  };
  std::map<std::array<Index, 2>, Common> all;
  for (std::size_t f = 0; f < regions.of_facet.size(); ++f)
    for (const RegionId r : regions.of_facet[f]) {
      const auto& claims = holders.of_region[r];
      for (std::size_t i = 0; i < claims.size(); ++i)
        for (std::size_t j = i + 1; j < claims.size(); ++j)
          for (const Index v : complex.facets[f]) {
            const Box corner{complex.vertices[v], complex.vertices[v]};
            Common& common = all.try_emplace({claims[i].part, claims[j].part}, Common{corner}).first->second;
            common.box.extend(corner);
            common.thickness = std::max(common.thickness, thickness[r]);
          }
    }
  std::vector<PartOverlap> overlaps;
  for (const auto& [pair, common] : all) {
    PartOverlap overlap{pair[0], pair[1], std::numeric_limits<double>::infinity(), common.thickness, {}};
    for (std::size_t k = 0; k < 3; ++k) {
      overlap.depth = std::min(overlap.depth, common.box.high[k] - common.box.low[k]);
      overlap.where[k] = common.box.centre(k);
    }
    overlaps.push_back(overlap);
  }
  std::stable_sort(overlaps.begin(), overlaps.end(),
                   [](const PartOverlap& a, const PartOverlap& b) { return a.depth > b.depth; });
  return overlaps;
}

std::string overlap_message(const PartsOfComplex& parts) {
  const PartOverlap& worst = parts.overlaps.front();
  // The box round a thin sheet is as deep as the sheet is wide, unless it is parallel to an axis.
  constexpr double kMuchThinner = 16;
  const std::string thin = worst.depth > kMuchThinner * worst.thickness
                               ? ", where their common space is " + decimal(worst.thickness, 3) + " thick"
                               : "";
  const std::string others =
      parts.overlaps.size() == 1
          ? ""
          : "; so do " + std::to_string(parts.overlaps.size() - 1) + " other pairs of parts";
  return parts.parts[worst.first].name + " and " + parts.parts[worst.second].name + " overlap by " +
         decimal(worst.depth, 6) + " at " + place(worst.where) + thin + others;
}

std::vector<std::optional<int>> ids_of_held(const Holders& holders, const PartsOfComplex& parts) {
  std::set<int> taken;
  for (const PastedPart& part : parts.parts) {
    taken.insert(part.id);
    for (const RegionSeed& seed : part.seeds) taken.insert(seed.id);
  }
  const auto next_free = [&] {
    int id = 1;
    while (!taken.insert(id).second) ++id;
    return id;
  };
  std::map<std::vector<Index>, int> fresh;  // by the parts that hold a region
  std::vector<std::optional<int>> ids;
  for (const std::vector<Holders::Claim>& claims : holders.of_region) {
    ids.emplace_back();
    if (claims.empty()) continue;
    if (claims.size() > 1 && parts.overlap == Overlap::fresh) {
      std::vector<Index> of;
      for (const Holders::Claim& claim : claims) of.push_back(claim.part);
      const auto [at, is_new] = fresh.try_emplace(std::move(of), 0);
      if (is_new) at->second = next_free();
      ids.back() = at->second;
      continue;
    }
    const Holders::Claim& claim = parts.overlap == Overlap::last ? claims.back() : claims.front();
    ids.back() = claim.id.value_or(parts.parts[claim.part].id);
  }
  return ids;
}

}  // namespace holdfast
