// The check of repairs: which parts of sheets are compared with each other.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "check/intersect.h"
#include "check_repair/sheets.h"
#include "numbers/random.h"

namespace holdfast::checking::check_sheets_test {
namespace {

struct Soup {
  std::vector<Point> vertices;
  std::vector<Part> parts;
  std::vector<Index> sheet;

  /// Unless it has no area.
  void add(const std::array<Point, 3>& t, Index of) {
    if (collinear(t[0].data(), t[1].data(), t[2].data())) return;
    const auto v = static_cast<Index>(vertices.size());
    vertices.insert(vertices.end(), t.begin(), t.end());
    parts.push_back({{v, v + 1, v + 2}, 3, parts.size()});
    sheet.push_back(of);
  }
};

/// Sheets in planes through a point, each a fan of needles around it with a grid of `rings`, whose sizes
/// decrease to `least`. Corners are rounded, so parts of one sheet are not exactly in its plane.
Soup pencil(std::uint64_t seed, std::size_t sheets, const Point& centre, double least) {
  numbers::Random random(seed);
  const auto uniform = [&] { return static_cast<double>(numbers::below(1U << 20, random)) / (1U << 19) - 1; };
  Soup soup;
  for (Index s = 0; s < sheets; ++s) {
    const Point u{uniform(), uniform(), uniform()}, v{uniform(), uniform(), uniform()};
    constexpr int kSectors = 12;
    const auto at = [&](double r, int sector) {
      const double a = r * (sector % 4 < 2 ? 1 : -1) * (1 + sector % 3), b = r * (sector - 5.5);
      Point p{};
      for (std::size_t k = 0; k < 3; ++k) p[k] = centre[k] + a * u[k] + b * v[k];
      return p;
    };
    for (int sector = 0; sector < kSectors; ++sector) {
      for (double r = 0.1; r > least; r /= 16)
        soup.add({at(r, sector), at(r / 16, sector + 1), at(r / 16, sector)}, s);
      soup.add({at(0.1, sector), at(0.1, sector + 1), at(least, sector)}, s);
    }
  }
  return soup;
}

/// Every pair that meets is visited, and none twice; returns their number.
std::size_t expect_all_found(const Soup& soup, std::span<const Index> sheet) {
  std::map<std::array<Index, 2>, int> visited;
  for_each_near_pair(soup.vertices, soup.parts, sheet, [&](Index i, Index j) {
    ++visited[{std::min(i, j), std::max(i, j)}];
  });
  const auto corners = [&](Index i) {
    const auto& c = soup.parts[i].corners;
    return Corners{soup.vertices[c[0]].data(), soup.vertices[c[1]].data(), soup.vertices[c[2]].data()};
  };
  std::size_t meetings = 0;
  for (Index i = 0; i < soup.parts.size(); ++i)
    for (Index j = i + 1; j < soup.parts.size(); ++j) {
      if (!meet_badly(soup.parts[i].corners, corners(i), soup.parts[j].corners, corners(j))) continue;
      ++meetings;
      EXPECT_TRUE(visited.contains({i, j}))
          << i << " and " << j << " of sheets " << soup.sheet[i] << " and " << soup.sheet[j];
    }
  EXPECT_GT(meetings, 0U);
  for (const auto& [pair, times] : visited) EXPECT_EQ(times, 1);
  return visited.size();
}

TEST(CheckSheets, NoMeetingIsLeftOut) {
  for (const Point& centre : {Point{}, Point{1e-17, -1e-17, 3e-17}, Point{1, 2, 3}, Point{1e6, 0, -1e6}})
    for (const double least : {1e-2, 1e-17})
      for (std::uint64_t seed = 1; seed <= 2; ++seed) {
        const Soup soup = pencil(seed, 6, centre, least);
        const std::size_t near = expect_all_found(soup, soup.sheet);
        EXPECT_LE(near, expect_all_found(soup, {}));
      }
}

TEST(CheckSheets, WrongNumbersCostTimeOnly) {
  Soup soup = pencil(7, 6, {0.5, 0, 0}, 1e-6);
  for (Index i = 0; i < soup.sheet.size(); ++i) soup.sheet[i] = i % 5 == 0 ? no_entity : i % 3;
  (void)expect_all_found(soup, soup.sheet);
  for (const double scale : {1e300, 1e-300, 1e-310}) {
    Soup other = pencil(8, 4, {}, 1e-3);
    for (Point& p : other.vertices)
      for (double& x : p) x *= scale;
    (void)expect_all_found(other, other.sheet);
  }
}

/// Pages around a spine, each cut where it is crossed: the boxes of most pairs meet, but few pages do.
TEST(CheckSheets, PagesOfABookAreNotComparedAllWithAll) {
  constexpr Index kPages = 20, kParts = 20;
  Soup soup;
  for (Index page = 0; page < kPages; ++page) {
    const double angle = 0.1 + 0.2 * page;
    const Point far{std::cos(angle), std::sin(angle), std::sin(3.0 * page)};
    for (Index k = 0; k < kParts; ++k) soup.add({{{0, 0, k / 20.0}, {0, 0, (k + 1) / 20.0}, far}}, page);
  }
  const std::size_t near = expect_all_found(soup, soup.sheet);
  EXPECT_LT(near, 5 * kPages * kPages * kParts);
  EXPECT_GT(expect_all_found(soup, {}), 2 * near);
}

}  // namespace
}  // namespace holdfast::checking::check_sheets_test
