// Whether a small integer complex is valid, pair by pair, by the oracle of surface_oracle.h.
#pragma once

#include <map>
#include <set>
#include <utility>
#include <vector>

#include "property/surface_oracle.h"

namespace holdfast::oracle {

using ElementKey = std::pair<unsigned, Index>;  // 3 - corners (facets first), id
using PairKey = std::pair<ElementKey, ElementKey>;

struct Sample {
  std::vector<IntPoint> points;
  std::vector<Triangle> facets;
  std::vector<Segment> segments;
};

struct Truth {
  /// For each vertex the one that stands for its place: the first that is used, or else the first.
  std::vector<Index> representative;
  std::map<ElementKey, std::vector<Index>> elements;
  std::set<Index> flat_facets, flat_segments;
  std::set<PairKey> pairs;

  [[nodiscard]] bool valid() const { return flat_facets.empty() && flat_segments.empty() && pairs.empty(); }
};

inline bool collinear(const IntPoint& a, const IntPoint& b, const IntPoint& c) {
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t x = (k + 1) % 3, y = (k + 2) % 3;
    if ((b[x] - a[x]) * (c[y] - a[y]) != (b[y] - a[y]) * (c[x] - a[x])) return false;
  }
  return true;
}

inline Truth truth_of(const Sample& sample) {
  Truth truth;
  std::set<Index> named;
  for (const Triangle& f : sample.facets) named.insert(f.begin(), f.end());
  for (const Segment& e : sample.segments) named.insert(e.begin(), e.end());
  std::map<IntPoint, Index> first;
  for (const Index v : named) first.try_emplace(sample.points[v], v);
  for (Index v = 0; v < sample.points.size(); ++v)
    truth.representative.push_back(first.try_emplace(sample.points[v], v).first->second);
  const auto& same = truth.representative;
  std::set<std::set<Index>> edges;  // sides of facets and segments so far
  std::set<Index> used;
  for (Index f = 0; f < sample.facets.size(); ++f) {
    const auto [a, b, c] = sample.facets[f];
    if (collinear(sample.points[a], sample.points[b], sample.points[c])) {
      truth.flat_facets.insert(f);
      continue;
    }
    truth.elements[{0, f}] = {same[a], same[b], same[c]};
    edges.insert({{same[a], same[b]}, {same[b], same[c]}, {same[c], same[a]}});
    used.insert({same[a], same[b], same[c]});
  }
  for (Index s = 0; s < sample.segments.size(); ++s) {
    const auto [a, b] = sample.segments[s];
    if (same[a] == same[b]) {
      truth.flat_segments.insert(s);
    } else if (edges.insert({same[a], same[b]}).second) {
      truth.elements[{1, s}] = {same[a], same[b]};
      used.insert({same[a], same[b]});
    }
  }
  for (Index v = 0; v < sample.points.size(); ++v) {
    if (same[v] == v && used.count(v) == 0) truth.elements[{2, v}] = {v};
  }
  for (auto p = truth.elements.begin(); p != truth.elements.end(); ++p) {
    for (auto q = std::next(p); q != truth.elements.end(); ++q) {
      const std::set<Index> a(p->second.begin(), p->second.end()), b(q->second.begin(), q->second.end());
      if (a == b || misfit(sample.points, p->second, q->second)) truth.pairs.insert({p->first, q->first});
    }
  }
  return truth;
}

}  // namespace holdfast::oracle
