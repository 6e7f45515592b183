// Property tests of the search: the tree of boxes, hubs and oriented boxes miss no pair. Here the truth is
// the exact test of all pairs (contacts), which surface_diagnose_test.cpp checks against an oracle.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "surface/aabb_tree.h"
#include "surface/complex.h"
#include "surface/contacts.h"
#include "surface/diagnose.h"
#include "surface/hubs.h"
#include "surface/oriented_box.h"
#include "surface/round_triangle.h"
#include "surface/search.h"
#include "surface/sheet_pairs.h"

namespace holdfast::surface_search_test {
namespace {

using Random = std::mt19937_64;
using Pairs = std::set<std::pair<Index, Index>>;

double uniform(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

Index below(Random& random, std::size_t n) { return static_cast<Index>(random() % n); }

// --- Shapes that are hard for trees of boxes ----------------------------------------------------

// Rotated, so that nothing is parallel to an axis.
Point rotated(double x, double y, double z) {
  return {0.36 * x + 0.48 * y - 0.8 * z, -0.8 * x + 0.6 * y, 0.48 * x + 0.64 * y + 0.6 * z};
}

Surface soup(Random& random) {
  Surface s;
  for (int i = 0; i < 60; ++i)
    s.vertices.push_back({uniform(random, 0, 4), uniform(random, 0, 4), uniform(random, 0, 4)});
  for (int i = 0; i < 40; ++i) s.facets.push_back({below(random, 60), below(random, 60), below(random, 60)});
  for (int i = 0; i < 10; ++i) s.segments.push_back({below(random, 60), below(random, 60)});
  return s;
}

Surface parallel_needles(Random& random) {
  Surface s;
  for (int i = 0; i < 60; ++i) {
    const double y = uniform(random, 0, 1), z = uniform(random, 0, 1);
    const Index first = static_cast<Index>(s.vertices.size());
    s.vertices.push_back(rotated(0, y, z));
    s.vertices.push_back(rotated(100, y + uniform(random, 0, 0.05), z));
    s.vertices.push_back(rotated(uniform(random, 0, 100), y, z + uniform(random, 0, 0.05)));
    s.facets.push_back({first, first + 1, first + 2});
  }
  return s;
}

// A fan with some blades bent through their neighbours, and a second fan through the same points.
Surface fans(Random& random) {
  Surface s;
  s.vertices = {rotated(0, 0, 1), rotated(0, 0, -1)};
  const Index n = 70;
  for (Index i = 0; i < n; ++i) {
    const double angle = 6.283185307179586 * (i + uniform(random, -0.6, 0.6)) / n;
    s.vertices.push_back(rotated(std::cos(angle), std::sin(angle), uniform(random, -0.01, 0.01)));
  }
  for (Index i = 0; i < n; ++i) {
    s.facets.push_back({0, 2 + i, 2 + (i + 1) % n});
    if (i % 2 == 0) s.facets.push_back({1, 2 + (i + 1) % n, 2 + i});
    if (i % 7 == 0) s.segments.push_back({1, 2 + below(random, n)});
  }
  return s;
}

// The pages of a book: facets at one segment, some in one half-plane.
Surface book(Random& random) {
  Surface s;
  const auto add = [&s](double x, double y, double z) {
    s.vertices.push_back({x + 2 * y, 3 * y - z, x + 5 * z});
  };
  add(0, 0, 0);
  add(0, 0, 1);
  for (Index i = 0; i < 30; ++i) {
    add(below(random, 15) - 7.0, below(random, 15) - 7.0, below(random, 3) - 1.0);
    s.facets.push_back({0, 1, 2 + i});
  }
  return s;
}

// Points on a slanted plane except for rounding: nonzero signs that filters cannot tell from zero.
Surface almost_flat(Random& random) {
  Surface s;
  for (int i = 0; i < 40; ++i) {
    const double height = below(random, 4) == 0 ? uniform(random, -1, 1) : 0;
    s.vertices.push_back(rotated(uniform(random, 0, 4), uniform(random, 0, 4), height));
  }
  for (int i = 0; i < 40; ++i) s.facets.push_back({below(random, 40), below(random, 40), below(random, 40)});
  return s;
}

// Many magnitudes, including the ends of the range.
Surface graded(Random& random) {
  Surface s;
  for (int i = 0; i < 60; ++i) {
    Point p;
    for (double& x : p) x = std::ldexp(uniform(random, -1, 1), static_cast<int>(below(random, 2080)) - 1060);
    s.vertices.push_back(p);
  }
  for (int i = 0; i < 30; ++i) s.facets.push_back({below(random, 60), below(random, 60), below(random, 60)});
  return s;
}

Pairs all_pairs(const Complex& complex, const Elements& elements) {
  Pairs pairs;
  for (Index i = 0; i < elements.all.size(); ++i) {
    for (Index j = i + 1; j < elements.all.size(); ++j) {
      const Simplex a = Elements::simplex(elements.all[i], complex),
                    b = Elements::simplex(elements.all[j], complex);
      const Contacts found = contacts(a, b);
      const bool same = a.corners == 3 && b.corners == 3 && (found.common & Contacts::bit(7, 7)) != 0;
      const bool misfit = found.distinct != 0 || same;
      EXPECT_FALSE(misfit && surely_fit(a, b));
      EXPECT_FALSE(misfit && surely_fit(b, a));
      if (misfit) pairs.insert({i, j});
    }
  }
  return pairs;
}

void check_with_known(const Complex& complex, const Elements& elements, const Pairs& all_expected,
                      Random& random) {
  for (const double share : {0.3, 0.9, 0.98, 1.0}) {
    std::vector<std::uint8_t> known(elements.all.size());
    for (auto& k : known) k = uniform(random, 0, 1) < share;
    Pairs expected = all_expected, pairs;
    std::erase_if(expected, [&](const auto& pair) { return known[pair.first] && known[pair.second]; });
    const auto visit = [&](Index i, Index j, const Contacts&) { return pairs.insert({i, j}).second; };
    const auto step = [](double) {};
    for_each_offending_pair(complex, elements, visit, step, {3, 1000}, known);
    ASSERT_EQ(pairs, expected);
    for (const unsigned threads : {1u, 2u})
      ASSERT_EQ(all_fit(complex, elements, known, step, threads), expected.empty());
  }
  ASSERT_EQ(all_fit(complex, elements, {}, [](double) {}), all_expected.empty());
}

/// Facets that fit together may be a sheet; no pair is missed because of it.
void check_with_sheets(const Complex& complex, const Elements& elements, const Pairs& expected,
                       Random& random) {
  constexpr double kSheets = 3;
  std::vector<Index> sheet;
  for (const Element& e : elements.all)
    sheet.push_back(e.corners == 3 ? static_cast<Index>(uniform(random, 0, kSheets)) : no_index);
  for (const auto& [i, j] : expected)
    if (sheet[i] == sheet[j]) sheet[j] = no_index;
  Pairs pairs;
  const auto visit = [&](Index i, Index j, const Contacts&) {
    EXPECT_TRUE(pairs.insert({i, j}).second) << "visited twice";
    return true;
  };
  for_each_offending_pair(
      complex, elements, visit, [](double) {}, {3, 1000}, Known({}, sheet));
  ASSERT_EQ(pairs, expected);
  for (const double share : {0.5, 0.9, 1.0}) {
    std::vector<std::uint8_t> known(elements.all.size());
    for (auto& k : known) k = uniform(random, 0, 1) < share;
    Pairs not_known = expected;
    std::erase_if(not_known, [&](const auto& pair) { return known[pair.first] && known[pair.second]; });
    pairs.clear();
    for_each_offending_pair(
        complex, elements, visit, [](double) {}, {3, 1000}, Known(known, sheet));
    ASSERT_EQ(pairs, not_known);
  }
}

/// Every element of a pair is found if pairs of two elements found before are skipped, and none of these
/// pairs is visited.
void check_with_found(const Complex& complex, const Elements& elements, const Pairs& all_expected,
                      Random& random) {
  for (const double share : {0.0, 0.9}) {
    std::vector<std::uint8_t> known(elements.all.size()), found(elements.all.size(), 0), expected = found;
    for (auto& k : known) k = uniform(random, 0, 1) < share;
    for (const auto& [i, j] : all_expected)
      if (!known[i] || !known[j]) expected[i] = expected[j] = 1;
    const auto visit = [&](Index i, Index j, const Contacts&) {
      EXPECT_FALSE(found[i] && found[j]);
      found[i] = found[j] = 1;
      return true;
    };
    for_each_offending_pair(
        complex, elements, visit, [](double) {}, {}, Known(known, {}, found));
    ASSERT_EQ(found, expected);
  }
}

void check(Surface (*make)(Random&), unsigned seeds) {
  std::size_t found_some = 0;
  for (unsigned seed = 0; seed < seeds; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const Surface s = make(random);
    const Complex complex = s.view();
    const Elements elements = elements_of(complex);
    const Pairs expected = all_pairs(complex, elements);
    found_some += !expected.empty();
    for (const SearchTuning& tuning : {SearchTuning{}, {3, 1000}, {1000, 0}, {3, 0}, {20, 1}}) {
      Pairs pairs;
      const auto visit = [&](Index i, Index j, const Contacts&) {
        EXPECT_TRUE(pairs.insert({i, j}).second) << "visited twice";
        return true;
      };
      for_each_offending_pair(
          complex, elements, visit, [](double) {}, tuning);
      ASSERT_EQ(pairs, expected);
    }
    check_with_known(complex, elements, expected, random);
    check_with_sheets(complex, elements, expected, random);
    check_with_found(complex, elements, expected, random);
  }
  EXPECT_GT(found_some, seeds / 2);
}

TEST(SurfaceSearch, Soup) { check(soup, 40); }
TEST(SurfaceSearch, ParallelNeedles) { check(parallel_needles, 60); }
TEST(SurfaceSearch, Fans) { check(fans, 30); }
TEST(SurfaceSearch, Book) { check(book, 60); }
TEST(SurfaceSearch, AlmostFlat) { check(almost_flat, 40); }
TEST(SurfaceSearch, Graded) { check(graded, 4); }

// --- The parts ----------------------------------------------------------------------------------

TEST(AabbTree, FindsAllOverlaps) {
  for (unsigned seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const std::size_t n = seed < 10 ? seed : 20 + below(random, 300);
    const int grid = seed % 3 == 0 ? 3 : 12;  // coarse: many boxes with one centre, many that only touch
    const int exponent = seed % 4 == 1 ? 1000 : seed % 4 == 2 ? -1074 : 0;
    std::vector<Box> boxes(n);
    std::vector<Index> group(n, no_index);
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        const double a = below(random, static_cast<std::size_t>(grid)), b = a + below(random, 3);
        boxes[i].low[k] = std::ldexp(a, exponent);
        boxes[i].high[k] = std::ldexp(b, exponent);
      }
      if (seed % 2 == 0) group[i] = below(random, 6) < 4 ? below(random, 5) : no_index;
    }
    Pairs expected, found;
    for (Index i = 0; i < n; ++i) {
      for (Index j = i + 1; j < n; ++j) {
        if (boxes[i].overlaps(boxes[j])) expected.insert({i, j});
      }
    }
    const AabbTree tree(boxes, seed % 2 == 0 ? std::span<const Index>(group) : std::span<const Index>());
    const auto never = [](Index, Index) { return false; };
    const auto visit = [&](Index i, Index j) {
      return found.insert({std::min(i, j), std::max(i, j)}).second;
    };
    tree.for_each_overlap(visit, never, [](double) {});
    EXPECT_EQ(found, expected);
    std::size_t visited = 0;
    tree.for_each_overlap([&](Index, Index) { return ++visited < 3; }, never, [](double) {});
    EXPECT_EQ(visited, std::min<std::size_t>(3, expected.size()));
    for (std::size_t i = 0; i < n; ++i) {
      Box box = boxes[i];
      for (std::size_t k = 0; k < 3; ++k) box.low[k] = box.high[k];
      EXPECT_EQ(tree.overlaps_any(box), std::any_of(boxes.begin(), boxes.end(),
                                                    [&](const Box& other) { return other.overlaps(box); }));
    }
  }
}

// Facets on planes that nearly share a point near the origin, of all sizes, or far from it.
Surface crossing_sheets(Random& random, std::vector<Index>& sheet) {
  Surface s;
  const double far = below(random, 3) == 0 ? 100 : 0;
  for (Index k = 0; k < 6; ++k) {
    const Point u = rotated(uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1));
    const Point v = rotated(uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1));
    for (int f = 0; f < 12; ++f) {
      const auto first = static_cast<Index>(s.vertices.size());
      const double size = std::ldexp(1.0, -static_cast<int>(below(random, 60)));
      for (int i = 0; i < 3; ++i) {
        const double a = uniform(random, -1, 1) * size, b = uniform(random, -1, 1) * size;
        s.vertices.push_back({far + a * u[0] + b * v[0], a * u[1] + b * v[1], a * u[2] + b * v[2]});
      }
      s.facets.push_back({first, first + 1, first + 2});
      sheet.push_back(below(random, 12) == 0 ? no_index : k);
    }
  }
  return s;
}

/// The pairs that SheetPairs visits, each once and of two sheets.
Pairs pairs_of(const Complex& complex, const Elements& elements, const std::vector<Index>& sheet,
               std::size_t block = 1'000'000) {
  SheetPairs sheets(complex, elements, sheet, {}, block);
  Pairs found;
  for (const SheetPairs::Batch& batch : sheets.batches()) {
    sheets.prepare(batch, 1);
    for (std::size_t k = batch.first; k < batch.last; ++k)
      sheets.for_each(sheets.all()[k], [&](Index i, Index j) {
        EXPECT_NE(sheet[i], sheet[j]);
        EXPECT_TRUE(found.insert({std::min(i, j), std::max(i, j)}).second) << "visited twice";
        return true;
      });
  }
  return found;
}

TEST(SheetPairs, LoseNoPairThatMeets) {
  std::size_t visited = 0, boxes = 0;
  for (unsigned seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    std::vector<Index> sheet;
    const Surface s = crossing_sheets(random, sheet);
    const Complex complex = s.view();
    const Elements elements = elements_of(complex);
    ASSERT_EQ(elements.all.size(), sheet.size());
    const Pairs found = pairs_of(complex, elements, sheet);
    EXPECT_EQ(found, pairs_of(complex, elements, sheet, 5)) << "parts that are prepared in blocks";
    visited += found.size();
    for (const auto& [i, j] : all_pairs(complex, elements)) {
      const bool is_asked = sheet[i] != no_index && sheet[j] != no_index && sheet[i] != sheet[j];
      EXPECT_TRUE(!is_asked || found.contains({i, j}));
    }
    const auto box = [&](Index e) {
      const Triangle& t = elements.all[e].vertex;
      Box round{s.vertices[t[0]], s.vertices[t[0]]};
      for (const Index v : t) round.extend({s.vertices[v], s.vertices[v]});
      return round;
    };
    for (Index i = 0; i < sheet.size(); ++i)
      for (Index j = 0; j < i; ++j) boxes += sheet[i] != sheet[j] && box(i).overlaps(box(j));
  }
  EXPECT_LT(visited, boxes * 9 / 10) << "planes tell some apart that boxes do not";
}

// The boxes of long strips that lie side by side across all axes overlap, strips do not.
TEST(SheetPairs, StripsSideBySideAreNoPairs) {
  constexpr Index kStrips = 60;
  Surface s;
  std::vector<Index> sheet;
  for (Index k = 0; k < kStrips; ++k) {
    const auto first = static_cast<Index>(s.vertices.size());
    for (int i = 0; i < 4; ++i) {
      const double across = 4e-3 * k + 5e-4 * (i % 2), along = i / 2;
      s.vertices.push_back({along + across, along - across, along});
    }
    for (const Triangle& t : {Triangle{0, 1, 2}, Triangle{1, 3, 2}}) {
      s.facets.push_back({first + t[0], first + t[1], first + t[2]});
      sheet.push_back(k);
    }
  }
  const Complex complex = s.view();
  const Elements elements = elements_of(complex);
  const SheetPairs sheets(complex, elements, sheet, {});
  EXPECT_FALSE(sheets.are_too_many());
  EXPECT_TRUE(sheets.all().empty());
}

// Nor are triangles that face each other across a slit: boxes round them, oriented ones too, overlap.
TEST(SheetPairs, TrianglesThatFaceEachOtherAreNoPairs) {
  constexpr Index kPairs = 20;
  Surface s;
  std::vector<Index> sheet;
  for (Index k = 0; k < kPairs; ++k) {
    const double slit = 1e-6, z = 10.0 * k;
    const auto add = [&](const Point& a, const Point& b, const Point& c) {  // as two facets
      const auto first = static_cast<Index>(s.vertices.size());
      const Point middle{a[0] / 2 + b[0] / 2, a[1] / 2 + b[1] / 2, a[2] / 2 + b[2] / 2};
      for (const Point& p : {a, middle, b, c}) s.vertices.push_back(rotated(p[0], p[1], p[2]));
      for (const Triangle& t : {Triangle{0, 1, 3}, Triangle{1, 2, 3}}) {
        s.facets.push_back({first + t[0], first + t[1], first + t[2]});
        sheet.push_back(static_cast<Index>(s.vertices.size() / 4));
      }
    };
    add({0, 0, z}, {1, 0, z}, {-2, -3, z + 1e-3 * (k % 2)});
    add({0, slit, z}, {1, slit, z}, {3, 4, z - 1e-3 * (k % 3)});
  }
  const Complex complex = s.view();
  const Elements elements = elements_of(complex);
  const SheetPairs sheets(complex, elements, sheet, {});
  EXPECT_TRUE(sheets.all().empty());
}

TEST(RoundTriangle, SeparatesNoFacetsThatMeet) {
  std::size_t apart = 0, meet = 0;
  for (unsigned seed = 0; seed < 4000; ++seed) {
    Random random(seed);
    const double size = std::ldexp(1.0, -static_cast<int>(below(random, 12)));
    Surface s;
    const bool is_flat = seed % 3 == 0, is_shared = seed % 5 == 0;
    for (int i = 0; i < 6; ++i) {
      const double x = uniform(random, -size, size) / 2, y = uniform(random, -0.5, 0.5);
      const Point p = is_flat ? Point{x, y, 0} : rotated(x, y, uniform(random, -0.1, 0.1) * size);
      s.vertices.push_back(is_shared && i == 3 ? s.vertices[0] : p);
    }
    s.facets = {{0, 1, 2}, {3, 4, 5}};
    const auto round = [&](Index f) {
      const Triangle& t = s.facets[f];
      return RoundTriangle({{s.vertices[t[0]], s.vertices[t[1]], s.vertices[t[2]]}});
    };
    const Complex complex = s.view();
    const bool is_apart = surely_apart(round(0), round(1));
    const bool does_meet = !offending_pairs(complex, 1, [](double) {}).empty();
    apart += is_apart ? 1 : 0;
    meet += does_meet ? 1 : 0;
    EXPECT_FALSE(is_apart && does_meet) << seed;
    EXPECT_TRUE(is_apart || does_meet || is_shared) << seed << ": an axis is missing";
  }
  EXPECT_GT(apart, 500u);
  EXPECT_GT(meet, 500u);
}

// Facets on planes through one line, with vertices on the line; planes may be nearly the same, facets nearly
// flat, and some corners off their plane by rounding or by more.
Surface sheets_at_a_line(Random& random, bool are_flat, std::vector<Index>& sheet) {
  Surface s;
  constexpr Index kOnLine = 6;
  for (Index i = 0; i < kOnLine; ++i) s.vertices.push_back(rotated(i + uniform(random, 0, 1), 0, 0));
  const double least = std::ldexp(1.0, -static_cast<int>(below(random, are_flat ? 8 : 52)));
  for (Index k = 0; k < 4; ++k) {
    const double angle = least * k, c = std::cos(angle), sine = std::sin(angle);
    for (int f = 0; f < 24; ++f) {
      const double size = std::ldexp(1.0, -static_cast<int>(below(random, 30))),
                   middle = below(random, kOnLine);
      const double side = below(random, 2) == 0 ? 1 : -1, least_y = are_flat ? 0.1 : -1;
      const auto corner = [&] {
        const int bits = are_flat ? 52 : static_cast<int>(below(random, 55));
        const double beside = below(random, 6) == 0 ? std::ldexp(uniform(random, -1, 1), -bits) : 0;
        const double x = middle + uniform(random, -1, 1) * size,
                     y = uniform(random, least_y, 1) * side * size;
        s.vertices.push_back(rotated(x, c * y - sine * beside, sine * y + c * beside));
        return static_cast<Index>(s.vertices.size() - 1);
      };
      const Index a = below(random, kOnLine), b = below(random, 3) == 0 ? (a + 1) % kOnLine : corner();
      s.facets.push_back({a, b, corner()});
      sheet.push_back(k);
    }
  }
  return s;
}

TEST(SheetPairs, FansAtACommonVertexAreToldApartAsAWhole) {
  std::size_t at_a_vertex = 0, visited = 0, meet = 0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    std::vector<Index> sheet;
    const bool are_flat = seed % 2 == 0;
    const Surface s = sheets_at_a_line(random, are_flat, sheet);
    const Complex complex = s.view();
    const Elements elements = elements_of(complex);
    ASSERT_EQ(elements.all.size(), sheet.size());
    const Pairs found = pairs_of(complex, elements, sheet);
    for (const auto& [i, j] : all_pairs(complex, elements)) {
      if (sheet[i] == sheet[j]) continue;
      EXPECT_TRUE(found.contains({i, j})) << i << ' ' << j;
      ++meet;
    }
    const auto share_one = [&](Index i, Index j) {
      const Triangle &t = elements.all[i].vertex, &u = elements.all[j].vertex;
      return std::count_if(t.begin(), t.end(),
                           [&](Index v) { return std::find(u.begin(), u.end(), v) != u.end(); }) == 1;
    };
    for (Index i = 0; i < sheet.size(); ++i)
      for (Index j = 0; j < i; ++j)
        if (are_flat && sheet[i] != sheet[j] && share_one(i, j)) {
          ++at_a_vertex;
          visited += found.contains({j, i});
        }
  }
  EXPECT_GT(meet, 1000u);
  EXPECT_LT(visited, at_a_vertex * 2 / 3);
}

TEST(OrientedBox, ApartMeansDisjoint) {
  std::size_t apart = 0;
  for (unsigned seed = 0; seed < 4000; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const double thin = std::ldexp(1.0, -static_cast<int>(below(random, 50))),
                 gap = seed % 2 == 0 ? 0 : 3 * thin;
    std::vector<Point> points;
    for (int i = 0; i < 6; ++i) {
      points.push_back(rotated(uniform(random, -1, 1), uniform(random, 0, thin) + (i < 3 ? 0 : gap),
                               uniform(random, 0, thin)));
    }
    if (seed % 3 == 0) points[3] = points[0];
    const auto simplex = [&](std::size_t first) {
      Simplex s;
      s.corners = 3;
      for (std::size_t i = 0; i < 3; ++i) {
        s.vertex[i] = static_cast<Index>(first + i);
        s.point[i] = points[first + i].data();
      }
      EXPECT_TRUE(set_projection(s));
      return s;
    };
    const Contacts found = contacts(simplex(0), simplex(3));
    const UnitFrame frame(Box{{-2, -2, -2}, {2, 2, 2}});
    const auto unit = [&](std::size_t i) { return frame(points[i].data()); };
    const bool sure = surely_apart(oriented_box({{unit(0), unit(1), unit(2)}}),
                                   oriented_box({{unit(3), unit(4), unit(5)}}));
    EXPECT_FALSE(sure && (found.distinct | found.common) != 0);
    apart += sure;
  }
  EXPECT_GT(apart, 1000u) << "needles side by side are told apart";
}

TEST(Hubs, DirectionsOfMeetingElementsOverlap) {
  Random random(5);
  const Surface s = fans(random);
  const Complex complex = s.view();
  const Elements elements = elements_of(complex);
  const Hubs hubs(complex, elements, 20);
  ASSERT_EQ(hubs.all().size(), 2u);
  EXPECT_EQ(hubs.all()[0].vertex, 0u);
  std::size_t told_apart = 0, pairs = 0;
  for (const Hub& hub : hubs.all()) {
    const std::vector<Box> boxes = hubs.directions(hub);
    for (Index i = 0; i < boxes.size(); ++i) {
      for (Index j = i + 1; j < boxes.size(); ++j) {
        const Simplex a = Elements::simplex(elements.all[hub.elements[i]], complex);
        const Simplex b = Elements::simplex(elements.all[hub.elements[j]], complex);
        ++pairs;
        if (boxes[i].overlaps(boxes[j])) continue;
        ++told_apart;
        EXPECT_EQ(contacts(a, b).distinct, 0u);
      }
    }
  }
  EXPECT_GT(told_apart, pairs * 9 / 10);
}

}  // namespace
}  // namespace holdfast::surface_search_test
