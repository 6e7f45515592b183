#include "repair/sheet_parts.h"

#include <algorithm>
#include <utility>

#include "arrange/index_table.h"
#include "numbers/sorted.h"
#include "repair/near.h"

namespace holdfast::repairing {
namespace {

class Delivery {
 public:
  Delivery(State& state, const SharedSides& sides) : state_(state), sides_(sides) {}

  Delivered run(const SheetParts& sheet_parts, const InSheets& in_sheets) {
    std::vector<Triangle> facets;
    Parents parents;
    std::vector<std::uint8_t> known, changed;
    std::vector<Index> sheet;
    for (Index f = 0; f < state_.facets.size(); ++f) {
      if (const auto found = sheet_parts.find(f); found != sheet_parts.end())
        for (const SheetPart& part : found->second) {
          const std::vector<Triangle> parts = cut(part.corners);
          const bool is_whole = parts.size() == 1 && parts[0] == part.corners;
          for (const Triangle& t : parts) {
            facets.push_back(t);
            parents.add(part.parents);
            known.push_back(0);
            sheet.push_back(is_whole ? part.sheet : no_index);
            changed.push_back(1);
            if (is_whole) continue;
            for (const Index parent : part.facets)
              for (const Index v : t) delivered_.moved = std::max(delivered_.moved, distance(v, parent));
          }
        }
      if (in_sheets.are_parted[f] != 0) continue;
      const auto add = [&](const Triangle& t) {
        facets.push_back(t);
        parents.add(state_.facet_parents.of(f));
        known.push_back(t != state_.facets[f] || state_.known.empty() ? 0 : state_.known[f]);
        sheet.push_back(t != state_.facets[f] || state_.sheet.empty() ? no_index : state_.sheet[f]);
        changed.push_back(t != state_.facets[f] ? 1 : in_sheets.overlap[f]);
      };
      if (stays_whole(state_.facets[f]))
        add(state_.facets[f]);
      else
        for (const Triangle& t : cut(state_.facets[f])) add(t);
    }
    if (state_.known.empty()) known.clear();
    deliver_facets(facets, parents, known, sheet, changed);
    deliver_segments();
    return std::move(delivered_);
  }

 private:
  [[nodiscard]] double distance(Index v, Index facet) const {
    const auto& [a, b, c] = state_.facets[facet];
    return distance_above(state_.vertices[v], state_.vertices[a], state_.vertices[b], state_.vertices[c]);
  }

  /// Facets with the same corners become one. Its parents are those that have an odd number of these facets
  /// as parts: otherwise a folded sheet would end at its folds.
  void deliver_facets(std::span<const Triangle> facets, const Parents& parents,
                      std::span<const std::uint8_t> known, std::span<const Index> sheet,
                      std::span<const std::uint8_t> changed) {
    arrange::IndexTable<3> first_with;
    std::vector<std::uint8_t> is_first(facets.size(), 0);
    std::map<Index, std::vector<Index>> of_several;  // by the first of them
    for (Index f = 0; f < facets.size(); ++f) {
      const Index first = first_with.find_or_add(ascending(facets[f]), f);
      is_first[f] = first == f ? 1 : 0;
      if (first == f) continue;
      const auto [found, is_new] = of_several.try_emplace(first);
      std::vector<Index>& list = found->second;
      if (is_new) list.assign(parents.of(first).begin(), parents.of(first).end());
      list.insert(list.end(), parents.of(f).begin(), parents.of(f).end());
    }
    state_.facets.clear();
    state_.facet_parents = {};
    state_.known.clear();
    state_.sheet.clear();
    for (Index f = 0; f < facets.size(); ++f) {
      if (is_first[f] == 0) continue;
      std::span<const Index> list = parents.of(f);
      if (const auto found = of_several.find(f); found != of_several.end()) {
        sort_odd(found->second);
        list = found->second;
      }
      if (list.empty()) continue;
      if (changed[f] != 0 || of_several.contains(f))
        delivered_.changed.push_back(static_cast<Index>(state_.facets.size()));
      state_.facets.push_back(facets[f]);
      state_.facet_parents.add(list);
      if (!known.empty()) state_.known.push_back(known[f]);
      state_.sheet.push_back(sheet[f]);
    }
  }

  void deliver_segments() {
    std::vector<Segment> segments;
    Parents parents;
    for (std::size_t s = 0; s < state_.segments.size(); ++s) {
      const Index end = sides_.root(state_.segments[s][1]);
      Index before = sides_.root(state_.segments[s][0]);
      std::vector<Index> chain = sides_.chain(before, end);
      chain.push_back(end);
      for (const Index v : chain) {
        if (before == v) continue;
        segments.push_back({before, v});
        parents.add(state_.segment_parents.of(s));
        before = v;
      }
    }
    state_.segments = std::move(segments);
    state_.segment_parents = std::move(parents);
  }

  [[nodiscard]] bool stays_whole(const Triangle& t) const {
    for (std::size_t i = 0; i < 3; ++i) {
      const Index a = t[i], b = t[(i + 1) % 3];
      if (a == b || sides_.root(a) != a || sides_.is_led(a, b)) return false;
    }
    return true;
  }

  /// Cuts one side after the other: each fan keeps the other two sides whole.
  [[nodiscard]] std::vector<Triangle> cut(Triangle facet) const {
    for (Index& v : facet) v = sides_.root(v);
    std::vector<Triangle> parts{facet};
    for (std::size_t i = 0; i < 3; ++i) {
      const Index a = facet[i], b = facet[(i + 1) % 3];
      const std::vector<Index> chain = sides_.chain(a, b);
      if (chain.empty()) continue;
      std::vector<Triangle> now;
      for (const Triangle& t : parts) {
        const auto at_a = static_cast<std::size_t>(std::find(t.begin(), t.end(), a) - t.begin());
        if (at_a == 3 || t[(at_a + 1) % 3] != b) {
          now.push_back(t);
          continue;
        }
        const Index apex = t[(at_a + 2) % 3];
        Index before = a;
        for (const Index v : chain) {
          if (v != apex) now.push_back({before, v, apex});
          before = v;
        }
        now.push_back({before, b, apex});
      }
      parts = std::move(now);
    }
    std::erase_if(parts, [](const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
    return parts;
  }

  State& state_;
  const SharedSides& sides_;
  Delivered delivered_;
};

}  // namespace

Delivered deliver_sheets(State& state, const SharedSides& sides, const SheetParts& parts,
                         const InSheets& in_sheets) {
  return Delivery(state, sides).run(parts, in_sheets);
}

}  // namespace holdfast::repairing
