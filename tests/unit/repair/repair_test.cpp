// Repairs in the library: independence of scale, and displacements.
#include "holdfast/repair.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>
#include <span>
#include <tuple>

#include "small_surfaces.h"

namespace holdfast::repair_test {
namespace {

/// A sphere of n rings and 2 n meridians.
Surface sphere(int n, const Point& centre, double turned) {
  Surface surface;
  const auto put = [&](double x, double y, double z) {
    const double c = std::cos(turned), s = std::sin(turned);
    surface.vertices.push_back({centre[0] + c * x - s * y, centre[1] + s * x + c * y, centre[2] + z});
    return static_cast<Index>(surface.vertices.size() - 1);
  };
  const Index top = put(0, 0, 1);
  const int m = 2 * n;
  for (int i = 1; i < n; ++i)
    for (int j = 0; j < m; ++j) {
      const double a = std::numbers::pi * i / n, b = 2 * std::numbers::pi * j / m;
      put(std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a));
    }
  const Index bottom = put(0, 0, -1);
  const auto at = [&](int i, int j) { return static_cast<Index>(1 + (i - 1) * m + j % m); };
  for (int j = 0; j < m; ++j) {
    surface.facets.push_back({top, at(1, j), at(1, j + 1)});
    for (int i = 1; i + 1 < n; ++i) {
      surface.facets.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      surface.facets.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
    surface.facets.push_back({at(n - 1, j), bottom, at(n - 1, j + 1)});
  }
  return surface;
}

Surface together(Surface a, const Surface& b) {
  const auto n = static_cast<Index>(a.vertices.size());
  a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const Triangle& t : b.facets) a.facets.push_back({t[0] + n, t[1] + n, t[2] + n});
  return a;
}

Surface scaled(Surface surface, int by) {
  for (Point& p : surface.vertices)
    for (double& x : p) x = std::ldexp(x, by);
  return surface;
}

void expect_valid(const RepairResult& repaired) {
  ASSERT_EQ(repaired.outcome, Outcome::done) << repaired.message;
  EXPECT_TRUE(diagnose(repaired.surface.view()).empty());
}

const Surface& two_spheres() {
  static const Surface both = together(sphere(5, {0, 0, 0}, 0), sphere(5, {0.3, 0.2, 0.1}, 0.4));
  return both;
}

TEST(Repair, IsTheSameAtAnyScale) {
  const RepairResult usual = repair(two_spheres());
  expect_valid(usual);
  for (const int by : {-332, -150, 300}) {
    const RepairResult other = repair(scaled(two_spheres(), by));
    expect_valid(other);
    EXPECT_EQ(other.surface.vertices, scaled(usual.surface, by).vertices) << by;
    EXPECT_EQ(other.surface.facets, usual.surface.facets) << by;
    EXPECT_EQ(other.max_displacement, std::ldexp(usual.max_displacement, by)) << by;
  }
}

/// Among denormals there are fewer doubles than at a larger scale.
TEST(Repair, IsValidInTheDoublesThatAreWritten) {
  for (const int by : {-1074 + 12, -1074 + 20, -1074 + 40}) {
    const Surface small = scaled(two_spheres(), by);
    const RepairResult repaired = repair(small);
    if (repaired.outcome == Outcome::not_representable) continue;
    expect_valid(repaired);
    EXPECT_GE(repaired.max_displacement, 0x1p-1074) << by;
  }
}

/// Half of the least double is zero, so the triangle round a sheet of such a size had no size.
TEST(Repair, SheetsOfTheLeastDoublesNextToLargeTriangles) {
  constexpr double d = 0x1p-1074;
  Surface surface;
  surface.vertices = {{0, 0, 0}, {d, 0, 0}, {d, d, 0}, {0, d, 0}, {1, 1, 1}, {1, 2, 1}, {2, 1, 1}};
  surface.facets = {{0, 2, 3}, {3, 2, 1}, {3, 1, 0}, {4, 5, 6}};
  const RepairResult repaired = repair(surface);
  if (repaired.outcome == Outcome::not_representable) return;
  expect_valid(repaired);
}

TEST(Repair, VerticesThatAreNotFiniteHaveNoScale) {
  Surface surface = scaled(two_spheres(), -332);
  const RepairResult before = repair(surface);
  const auto v = static_cast<Index>(surface.vertices.size());
  surface.vertices.push_back({std::numeric_limits<double>::infinity(), 0, 0});
  surface.facets.push_back({0, 1, v});
  const RepairResult after = repair(surface);
  ASSERT_EQ(after.outcome, Outcome::done);
  EXPECT_EQ(after.surface.facets.size(), before.surface.facets.size());
  EXPECT_EQ(after.max_displacement, before.max_displacement);
  EXPECT_EQ(after.dropped.size(), 1U);
}

/// A sphere, and a copy moved by the last bit.
Surface twice_but_for_rounding(int n) {
  const Surface one = sphere(n, {0, 0, 0}, 0);
  Surface other = one;
  for (Point& p : other.vertices) p[0] = std::nextafter(p[0], 2);
  return together(one, other);
}

/// Only if much is in trouble and the vertices show that it is duplicated: see below. They do not return to
/// their places: one sphere with the vertices of both would have sides of some last bits everywhere.
TEST(Repair, WeldsADuplicateUpToRoundingAtOnce) {
  const Surface twice = twice_but_for_rounding(14);
  const RepairResult repaired = repair(twice);
  expect_valid(repaired);
  EXPECT_EQ(repaired.surface.facets.size(), twice.facets.size() / 2);
  EXPECT_EQ(repaired.report.rung, Rung::snapped);
  EXPECT_LE(repaired.report.rounds, 2u);  // before anything is welded
}

TEST(Repair, MovesNoVertexIfThatIsFast) {
  const RepairResult repaired = repair(twice_but_for_rounding(5));
  expect_valid(repaired);
  EXPECT_TRUE(repaired.moved.empty());
}

/// Copies become one facet with the parents of all before anything is cut, whichever vertices they name.
TEST(Repair, CopiesOfFacetsChangeNothing) {
  const Surface crossing = together(sphere(6, {0, 0, 0}, 0), sphere(6, {0.7, 0.2, 0.1}, 0.3));
  const RepairResult once = repair(crossing);
  Surface own_vertices = together(crossing, crossing), same_vertices = crossing;
  same_vertices.facets.insert(same_vertices.facets.end(), crossing.facets.begin(), crossing.facets.end());
  const auto count = static_cast<Index>(crossing.facets.size());
  for (const Surface& copies : {own_vertices, same_vertices}) {
    const RepairResult twice = repair(copies);
    ASSERT_EQ(twice.outcome, Outcome::done);
    EXPECT_EQ(twice.report.pairs, once.report.pairs + count);
    EXPECT_EQ(twice.max_displacement, once.max_displacement);
    ASSERT_EQ(twice.surface.facets.size(), once.surface.facets.size());
    for (std::size_t f = 0; f < twice.parents.size(); ++f) {
      for (std::size_t i = 0; i < 3; ++i)
        EXPECT_EQ(twice.surface.vertices[twice.surface.facets[f][i]],
                  once.surface.vertices[once.surface.facets[f][i]]);
      std::vector<Index> both(once.parents[f].begin(), once.parents[f].end());
      for (const Index p : once.parents[f]) both.push_back(p + count);
      EXPECT_TRUE(std::ranges::equal(twice.parents[f], both));
    }
    EXPECT_EQ(twice.merged.size(), count);
  }
}

TEST(Repair, ThreadsLeaveTheSameBits) {
  RepairOptions options;
  const RepairResult one = repair(two_spheres(), options);
  options.threads = 3;
  const RepairResult three = repair(two_spheres(), options);
  EXPECT_EQ(one.surface.vertices, three.surface.vertices);
  EXPECT_EQ(one.surface.facets, three.surface.facets);
  EXPECT_EQ(one.parents.all, three.parents.all);
}

TEST(Repair, SheetsThatCoincideUpToRounding) {
  // A copy that is rotated very little crosses the original nearly everywhere.
  for (const double turned : {0x1p-53, 0x1p-50, 0x1p-46}) {
    const RepairResult repaired = repair(together(sphere(5, {0, 0, 0}, 0), sphere(5, {0, 0, 0}, turned)));
    expect_valid(repaired);
    EXPECT_LT(repaired.max_displacement, 0x1p-40) << turned;
  }
}

/// Boxes of a lattice, cut alike.
Surface turned_boxes(std::span<const std::pair<std::array<int, 3>, std::array<int, 3>>> boxes,
                     bool is_turned) {
  Surface surface;
  const double a = std::cos(0.2), b = std::sin(0.2), c = std::cos(0.4), d = std::sin(0.4), e = std::cos(0.9),
               f = std::sin(0.9);
  for (const auto& [low, size] : boxes) {
    std::map<std::array<int, 3>, Index> at;
    const auto put = [&](const std::array<int, 3>& p) {
      const auto [found, is_new] = at.try_emplace(p, static_cast<Index>(surface.vertices.size()));
      if (!is_new) return found->second;
      double x = p[0], y = p[1], z = p[2];
      if (!is_turned) return surface.vertices.push_back({x, y, z}), found->second;
      std::tie(x, y) = std::pair(x * a - y * b, x * b + y * a);
      std::tie(y, z) = std::pair(y * c - z * d, y * d + z * c);
      std::tie(z, x) = std::pair(z * e - x * f, z * f + x * e);
      surface.vertices.push_back({x, y, z});
      return found->second;
    };
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (const bool is_high : {false, true}) {
        std::array<std::array<int, 3>, 4> corners;
        corners.fill(low);
        for (std::size_t k = 0; k < 4; ++k) {
          corners[k][axis] += is_high ? size[axis] : 0;
          corners[k][(axis + 1) % 3] += k == 1 || k == 2 ? size[(axis + 1) % 3] : 0;
          corners[k][(axis + 2) % 3] += k >= 2 ? size[(axis + 2) % 3] : 0;
        }
        std::array<Index, 4> q{};
        for (std::size_t k = 0; k < 4; ++k) q[k] = put(corners[k]);
        if (!is_high) std::reverse(q.begin(), q.end());
        surface.facets.push_back({q[0], q[1], q[2]});
        surface.facets.push_back({q[0], q[2], q[3]});
      }
  }
  return surface;
}

Surface turned_cubes(std::initializer_list<std::pair<std::array<int, 3>, int>> cubes) {
  std::vector<std::pair<std::array<int, 3>, std::array<int, 3>>> boxes;
  for (const auto& [low, size] : cubes) boxes.push_back({low, {size, size, size}});
  return turned_boxes(boxes, true);
}

/// Little is in trouble, and joining only that leaves more.
TEST(Repair, SheetsAreJoinedEverywhereIfNothingElseHelps) {
  const Surface cubes =
      turned_cubes({{{2, 3, 4}, 2}, {{4, 2, 3}, 2}, {{3, 1, 4}, 2}, {{4, 1, 4}, 1}, {{4, 2, 4}, 2}});
  const RepairResult repaired = repair(cubes.view());
  expect_valid(repaired);
  EXPECT_LT(repaired.max_displacement, 1e-12);
  EXPECT_TRUE(repaired.moved.empty());
}

/// A side of a strut is in two planes, and in each of them others cross it, at places that coincide up to
/// rounding. The rotated lattice has as few new points as the original.
TEST(Repair, SheetsRouteTheirCommonSidesTogether) {
  std::vector<std::pair<std::array<int, 3>, std::array<int, 3>>> struts;
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j)
      for (std::size_t axis = 0; axis < 3; ++axis) {
        std::array<int, 3> low{}, size{};
        low[axis] = -5;
        size[axis] = 21;
        low[(axis + 1) % 3] = 10 * i;
        low[(axis + 2) % 3] = 10 * j;
        size[(axis + 1) % 3] = size[(axis + 2) % 3] = 1;
        struts.emplace_back(low, size);
      }
  const auto vertices_of = [&](bool is_turned) {
    const Surface lattice = turned_boxes(struts, is_turned);
    const RepairResult repaired = repair(lattice);
    expect_valid(repaired);
    EXPECT_TRUE(repaired.moved.empty());
    return repaired.surface.vertices.size();
  };
  EXPECT_LE(vertices_of(true), 2 * vertices_of(false));
}

/// A line on which facets cross comes within 1e-11 of a side, and its points are 1e-10 apart: two of them
/// each pass the side that ends in the other by less than a last bit. If the sides were routed back and forth
/// through them, only joining points 10,000 last bits apart would end that.
TEST(Repair, SidesAreNotMovedBackAndForth) {
  Surface surface;
  surface.vertices = {{0.058976713567972183, 0.018437961116433144, -1.0458670854568481},
                      {0.11398078501224518, -0.0111279571428895, -1.0432866811752319},
                      {0.031898517161607742, -0.033781502395868301, -1.0669893026351929},
                      {0.098089665174484253, 0.093866072595119476, -1.0153572559356689},
                      {0.049950648099184036, 0.0010314729297533631, -1.0529078245162964},
                      {0.0018116285791620612, -0.091803126037120819, -1.0904585123062134},
                      {0.11968608200550079, 0.12492554634809494, -1.1198301315307617},
                      {0.071547061204910278, 0.032090947031974792, -1.1573807001113892},
                      {0.023408040404319763, -0.060743652284145355, -1.1949313879013062}};
  surface.facets = {{0, 1, 2}, {3, 6, 4}, {4, 8, 5}, {4, 7, 8}};
  const RepairResult repaired = repair(surface);
  expect_valid(repaired);
  EXPECT_LT(repaired.max_displacement, 1e-14);
  EXPECT_TRUE(repaired.moved.empty());
}

/// Each of eight places has two vertices up to 1e-10 apart, and facets cross in all of these gaps. Bending
/// sides does not separate them.
TEST(Repair, VerticesAreWeldedIfNothingElseHelps) {
  Surface surface;
  surface.vertices = {{-0.16442138973640275, -0.91886507618287649, -0.32498593977578322},
                      {-0.16442138975797049, -0.9188650761824585, -0.32498593977578322},
                      {0.84495495267398757, 0.22227635253380634, 0.32016939154221269},
                      {0.84495495260438891, 0.22227635253626346, 0.32016939154220542},
                      {0.3209386796098454, 0.19334235477783082, 0.15428431032237361},
                      {0.32093867961422556, 0.19334235477775882, 0.15428431031760062},
                      {0.34184233243588802, 0.83236236400251618, 0.35226140893169239},
                      {0.34184233243693196, 0.83236236400172192, 0.35226140894803604},
                      {0.4905621344387523, 0.4636646558181674, 0.28626803707707588},
                      {0.4905621344387523, 0.4636646558181674, 0.28626803707707588},
                      {-0.11285631568948719, 0.2802898425753782, 0.050230058055166005},
                      {-0.11285631568953636, 0.28028984254008971, 0.050230058055166005},
                      {0.2307881777411199, 0.99481961704514466, 0.3676823384226372},
                      {0.23078817774111782, 0.99481961704514466, 0.36768233843587811},
                      {-0.8585719033164072, 0.58311307750657182, -0.082637647755344851},
                      {-0.85857190331640854, 0.58311307746517793, -0.082637647720209845}};
  surface.facets = {{1, 7, 6},   {0, 8, 14}, {15, 10, 4}, {8, 7, 15}, {1, 0, 6},  {1, 14, 7},
                    {14, 4, 15}, {2, 5, 3},  {10, 7, 0},  {15, 2, 3}, {10, 3, 7}, {3, 4, 7},
                    {3, 12, 4},  {6, 11, 1}, {11, 5, 9},  {7, 8, 12}};
  const RepairResult repaired = repair(surface);
  expect_valid(repaired);
  EXPECT_LT(repaired.max_displacement, 1e-9);
}

TEST(Repair, DoublesNeedNoRounding) {
  // Pages of a book, whose spines are of different lengths.
  Surface book;
  for (int k = 0; k < 30; ++k)
    small::add_triangle(book, {0, 0, -16.0 - k}, {0, 0, 16.0 + k % 7}, {k + 1.0, 30.0 - k, 0});
  const RepairResult repaired = repair(book);
  expect_valid(repaired);
  EXPECT_EQ(repaired.max_displacement, 0);
}

TEST(Repair, ValidSurfacesDoNotChange) {
  Surface valid = sphere(6, {0.1, 0.2, 0.3}, 0.7);
  small::add_box(valid, {3, 3, 3}, {4, 4, 4});
  const RepairResult repaired = repair(valid);
  expect_valid(repaired);
  EXPECT_EQ(repaired.surface.vertices, valid.vertices);
  EXPECT_EQ(repaired.surface.facets, valid.facets);
  EXPECT_EQ(repaired.report.changed_facets, 0);
}

TEST(Repair, EveryFacetOfTheInputIsAParentOrListed) {
  Surface surface = together(two_spheres(), small::box({0, 0, 0}, {1, 1, 1}));
  surface.facets.push_back(surface.facets[3]);
  surface.facets.push_back({0, 0, 1});
  const RepairResult repaired = repair(surface);
  expect_valid(repaired);
  std::set<Index> named(repaired.parents.all.begin(), repaired.parents.all.end());
  for (const RepairResult::Dropped& dropped : repaired.dropped)
    EXPECT_TRUE(named.insert(dropped.facet).second);
  EXPECT_EQ(named.size(), surface.facets.size());
}

TEST(Repair, FacetsThatAreNotFiniteAreDropped) {
  Surface surface = small::box({0, 0, 0}, {1, 1, 1});
  const std::size_t whole = surface.facets.size();
  small::add_triangle(surface, {2, 0, 0}, {3, 0, 0}, {2, 1, std::nan("")});
  surface.segments.push_back({0, static_cast<Index>(surface.vertices.size() - 1)});
  Surface nothing;
  small::add_triangle(nothing, {-HUGE_VAL, 0, 0}, {HUGE_VAL, 0, 0}, {0, 1, std::nan("")});
  for (const bool unite : {false, true}) {
    RepairOptions options;
    options.unite = unite;
    const RepairResult repaired = repair(surface, options);
    expect_valid(repaired);
    EXPECT_EQ(repaired.surface.facets.size(), whole);
    EXPECT_TRUE(repaired.surface.segments.empty());
    ASSERT_EQ(repaired.dropped.size(), 1u);
    EXPECT_EQ(repaired.dropped[0].facet, whole);
    EXPECT_EQ(repaired.dropped[0].reason, DropReason::not_finite);
    const RepairResult empty = repair(nothing, options);
    expect_valid(empty);
    EXPECT_TRUE(empty.surface.facets.empty());
    EXPECT_EQ(empty.dropped.size(), 1u);
  }
}

// A segment that begins at a crossing has a piece there that rounding turns into a point.
TEST(Repair, PiecesOfSegmentsThatBecomePointsAreDropped) {
  Surface surface;
  surface.vertices = {{1.0, 0.0, 0.3},
                      {1.09, 0.0, 0.3},
                      {1.000000000000001, -1.270807895828401e-16, 0.3899999999999999},
                      {0.9948623426866301, 0.118708962502676, 0.3117714041100491},
                      {1.056114082167286, 7.812065818915443e-18, 0.3703648334221227},
                      {0.9799731159439315, 9.741486739085935e-18, 0.3877435120963641},
                      {1.063639610030914, 1.671175307069629e-17, 0.3636396105826642},
                      {0.9810907196037677, 1.010994565701443e-18, 0.3091062294987332},
                      {1.032658399789893, -1.746098424706752e-18, 0.2842725435702769},
                      {1.068228367860569, 0.0551484340663769, 0.3633277262445148}};
  surface.facets = {{8, 4, 7}, {7, 4, 5}, {8, 1, 4}, {6, 9, 2}};
  surface.segments = {{0, 3}};
  const RepairResult repaired = repair(surface);
  expect_valid(repaired);
  ASSERT_EQ(repaired.segment_parents.size(), repaired.surface.segments.size());
  EXPECT_FALSE(repaired.surface.segments.empty());
}

// Vertices at one place may differ in the signs of their zeros.
TEST(Repair, ZerosKeepTheirSigns) {
  Surface surface;
  surface.vertices = {{0.30901700258255005, 0.0, -0.9510565400123596},
                      {1.2246468525851679e-16, 0.0, -1.0},
                      {-0.30901700258255005, -0.0, -0.9510565400123596},
                      {1.2095694014262453e-16, 1.9157696546991458e-17, -0.9755282402038574},
                      {-0.30521246790885925, -0.04834090918302536, -0.9271836280822754},
                      {0.0, 0.0, 1.0},
                      {1.1647082866083914e-16, 3.7843668534256176e-17, -0.9045084714889526},
                      {-0.29389262199401855, -0.09549150615930557, -0.8579018712043762},
                      {0.0, 0.0, 1.0},
                      {0.2753361463546753, 0.1402907818555832, 0.956100344657898},
                      {1.091168290557732e-16, 5.559780005478398e-17, -0.7938926219940186},
                      {-0.2753361463546753, -0.1402907818555832, -0.7499929666519165},
                      {1.9815201570958424e-16, -1.4396586223584855e-16, 1.0},
                      {-0.0, 0.0, 1.0},
                      {-1.091168290557732e-16, 5.559780005478398e-17, -0.7938926219940186},
                      {2.182336581115464e-16, -1.1119560010956796e-16, 1.0},
                      {-1.1647082866083914e-16, 3.7843668534256176e-17, -0.9045084714889526},
                      {0.29389262199401855, -0.09549150615930557, -0.8579018712043762},
                      {-1.2095694014262453e-16, 1.9157696546991458e-17, -0.9755282402038574},
                      {0.30521246790885925, -0.04834090918302536, -0.9271836280822754},
                      {-1.2246468525851679e-16, 1.4997597572211942e-32, -1.0},
                      {0.30901700258255005, -3.7843668534256176e-17, -0.9510565400123596}};
  surface.facets = {{1, 4, 3},    {1, 2, 4},    {3, 7, 6},    {3, 4, 7},    {5, 9, 8},
                    {6, 11, 10},  {6, 7, 11},   {12, 13, 15}, {14, 17, 16}, {16, 19, 18},
                    {16, 17, 19}, {18, 21, 20}, {18, 19, 21}, {20, 21, 1},  {20, 0, 21}};
  const RepairResult repaired = repair(surface);
  expect_valid(repaired);
  std::set<Index> moved;
  for (const RepairResult::Moved& m : repaired.moved) moved.insert(m.vertex);
  for (Index v = 0; v < surface.vertices.size(); ++v) {
    if (moved.count(v) != 0) continue;
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_EQ(std::signbit(surface.vertices[v][k]), std::signbit(repaired.surface.vertices[v][k])) << v;
  }
}

TEST(Repair, LimitsEndIt) {
  RepairOptions options;
  options.most_points = 10;
  const RepairResult many = repair(two_spheres(), options);
  EXPECT_EQ(many.outcome, Outcome::memory_limit);
  EXPECT_TRUE(many.surface.facets.empty());
  EXPECT_NE(many.message.find("more than 10 new points"), std::string::npos) << many.message;
}

// Two combs across each other in one plane: the points are counted before any is made.
TEST(Repair, ASheetWithFarTooManyPointsEndsEarly) {
  Surface combs;
  constexpr int kTeeth = 40;
  for (int k = 0; k < kTeeth; ++k) {
    const double at = k, beside = k + 0.3;
    small::add_triangle(combs, {at, -1, 0}, {beside, -1, 0}, {at, kTeeth, 0});
    small::add_triangle(combs, {-1, at, 0}, {-1, beside, 0}, {kTeeth, at, 0});
  }
  RepairOptions options;
  options.most_points = 10;
  const RepairResult many = repair(combs, options);
  EXPECT_EQ(many.outcome, Outcome::memory_limit);
  EXPECT_NE(many.message.find("(12 so far)"), std::string::npos) << many.message;
}

}  // namespace
}  // namespace holdfast::repair_test
