// Conditions on the result of a call, and a surface that takes long enough to be interrupted.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <random>
#include <set>
#include <string>

#include "holdfast/check.h"
#include "holdfast/holdfast.h"

namespace holdfast::testing {

// The broken rules, one a line.
std::string broken_rules(const Surface& surface, const Result& result, const CheckOptions& options = {}) {
  std::string text;
  for (const Rule& rule : check(surface.view(), result.volume, options).rules)
    if (!rule.holds) text += rule.name + ": " + rule.detail + "\n";
  return text;
}

void expect_done(const Surface& surface, const Result& result, const CheckOptions& options = {}) {
  EXPECT_EQ(result.outcome, Outcome::done) << result.message;
  for (const Defect& defect : result.defects) ADD_FAILURE() << defect.message;
  EXPECT_EQ(broken_rules(surface, result, options), "");
  EXPECT_TRUE(result.exact_vertices.empty());
  EXPECT_EQ(result.message, "");
}

inline void expect_empty(const Volume& volume) {
  EXPECT_TRUE(volume.vertices.empty());
  EXPECT_TRUE(volume.tetrahedra.empty());
  EXPECT_TRUE(volume.regions.empty());
  EXPECT_TRUE(volume.facets.empty());
  EXPECT_TRUE(volume.segments.empty());
}

inline bool same_bits(const Point& p, const Point& q) {
  return std::equal(p.begin(), p.end(), q.begin(), [](double x, double y) {
    return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
  });
}

inline bool same(const Volume& a, const Volume& b) {
  return std::equal(a.vertices.begin(), a.vertices.end(), b.vertices.begin(), b.vertices.end(), same_bits) &&
         a.tetrahedra == b.tetrahedra && a.regions == b.regions && a.facets == b.facets &&
         a.segments == b.segments && a.facet_markers == b.facet_markers &&
         a.segment_markers == b.segment_markers && a.vertex_markers == b.vertex_markers;
}

inline std::set<int> ids(const Volume& volume) { return {volume.regions.begin(), volume.regions.end()}; }

// The regions on the sides of every facet, computed only from the tetrahedra.
inline std::vector<FacetRegions> sides(const Volume& volume) {
  std::vector<FacetRegions> found(volume.facets.size());
  const auto turned = [](Triangle t) {  // least corner first, the orientation kept
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    return t;
  };
  for (std::size_t t = 0; t < volume.tetrahedra.size(); ++t) {
    const auto [a, b, c, d] = volume.tetrahedra[t];
    for (const Triangle& face : {Triangle{b, d, c}, Triangle{a, c, d}, Triangle{a, d, b}, Triangle{a, b, c}})
      for (std::size_t f = 0; f < volume.facets.size(); ++f) {
        const auto [u, v, w] = volume.facets[f];
        if (turned(face) == turned({u, v, w}))
          found[f][0] = volume.regions[t];  // it sees them counterclockwise
        if (turned(face) == turned({u, w, v})) found[f][1] = volume.regions[t];
      }
  }
  return found;
}

// A sphere of bumps: `rings` x `around` quadrilaterals and two caps, enough work to interrupt.
inline Surface bumpy(unsigned rings, unsigned around) {
  Surface surface;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> bump(0.9, 1.1);
  surface.vertices.push_back({0, 0, -1});
  for (unsigned i = 1; i < rings; ++i)
    for (unsigned j = 0; j < around; ++j) {
      const double u = 3.141592653589793 * i / rings;
      const double v = 6.283185307179586 * j / around;
      const double r = bump(random);
      surface.vertices.push_back(
          {r * std::sin(u) * std::cos(v), r * std::sin(u) * std::sin(v), -r * std::cos(u)});
    }
  const auto last = static_cast<Index>(surface.vertices.size());
  surface.vertices.push_back({0, 0, 1});
  const auto at = [&](unsigned i, unsigned j) { return 1 + (i - 1) * around + j % around; };
  for (unsigned j = 0; j < around; ++j) {
    surface.facets.push_back({0, at(1, j + 1), at(1, j)});
    for (unsigned i = 1; i + 1 < rings; ++i) {
      surface.facets.push_back({at(i, j), at(i, j + 1), at(i + 1, j + 1)});
      surface.facets.push_back({at(i, j), at(i + 1, j + 1), at(i + 1, j)});
    }
    surface.facets.push_back({last, at(rings - 1, j), at(rings - 1, j + 1)});
  }
  return surface;
}

}  // namespace holdfast::testing
