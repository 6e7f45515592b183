// The promises of `repair`, checked on small surfaces that once broke them: found by random search, then
// reduced.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "holdfast/check_repair.h"
#include "holdfast/repair.h"
#include "small_surfaces.h"

namespace holdfast::repair_promise_test {
namespace {

/// The rules that are broken.
std::string broken(const Surface& surface, const RepairOptions& options = {}) {
  const RepairResult repaired = repair(surface, options);
  if (repaired.outcome != Outcome::done) return repaired.message;
  std::string told;
  for (const RepairRule& rule :
       check_repaired(surface.view(), repaired.surface.view(), claims_of(repaired, options)).rules)
    if (!rule.holds()) told += std::string(name(rule.kind)) + ": " + rule.first[0] + "\n";
  return told;
}

Surface surface_of(std::vector<Point> vertices, std::vector<Triangle> facets) {
  Surface surface;
  surface.vertices = std::move(vertices);
  surface.facets = std::move(facets);
  return surface;
}

// A needle through a triangle: both points where its sides pass through it have the same doubles, so the part
// beyond is a line.
TEST(RepairPromise, TheTipOfANeedleStays) {
  EXPECT_EQ(broken(surface_of({{-0.042760119712698219, 0.81403626276529684, -0.84924679661313152},
                               {-0.16722509948979833, -0.92416943101496107, -0.93303243102019351},
                               {0.79742528927720968, -0.58939826806344298, -0.2508157442973139},
                               {-0.51093912832326649, -0.44083699007483212, -0.56665491517057354},
                               {-0.20916613317857452, -0.86519173283188555, -0.88832592945844213},
                               {-0.16722509939094959, -0.92416943101496118, -0.93303243102019351}},
                              {{0, 1, 2}, {3, 4, 5}})),
            "");
  EXPECT_EQ(broken(surface_of({{0.054620670168461505, 0.46274513883706586, -0.37526349663058456},
                               {0.70252992573224138, 0.2110373780416146, 0.14019249578606263},
                               {0.58206299628390834, -0.57840828657031118, -0.023171813125046459},
                               {0.58206299628391345, -0.57840828659241206, -0.023171813125213298},
                               {0.19149658563316607, 0.69514551720432682, -0.21993601283858191},
                               {0.19149658563316557, 0.69514551720429174, -0.21993601284314868}},
                              {{3, 0, 1}, {5, 2, 4}})),
            "");
  EXPECT_EQ(broken(surface_of({{-0.59972085170478628, -0.018313317989039766, 0.78996393639684093},
                               {0.44720145819034524, 0.75359175533023937, -0.4209032547005222},
                               {0.68285271591653762, -0.1452184015914173, -0.27227782707622006},
                               {0.68285271591653762, -0.14521840159152977, -0.27227782704890907},
                               {0.43670565038163783, -0.16145452634758314, 0.68986290476507139},
                               {0.43670565038136677, -0.16145452634759883, 0.6898629047650815},
                               {-0.80762991937779738, -0.034760803869479773, -0.80007733741829812},
                               {-0.80762991938249851, -0.034760803869479745, -0.8000773374182979}},
                              {{2, 0, 4}, {3, 1, 5}, {7, 3, 6}})),
            "");
  EXPECT_EQ(broken(surface_of({{0.74790572067014016, -0.72993986352844009, 0.30169467663992866},
                               {-0.8203370930855175, 0.49129072439460786, -0.53631355454019425},
                               {0.95498300732990982, -0.50867061420836901, -0.89824257683133535},
                               {0.95498300732991037, -0.50867061420535964, -0.89824257683133546},
                               {0.95498300732990926, -0.50867061420836901, -0.89824257690060472},
                               {-0.94319871354074836, 0.82097749452194457, 0.33758993021520189},
                               {-0.30908247444005771, -0.25587319786394302, -0.64879117766771932},
                               {-0.30908247440936598, -0.25587319789163737, -0.64879117766771932}},
                              {{6, 7, 2}, {3, 1, 2}, {4, 0, 5}})),
            "");
}

/// A box without its side at the top.
void add_open_box(Surface& surface, const Point& low, const Point& high) {
  small::add_box(surface, low, high);
  const auto side = surface.facets.end() - 10;
  surface.facets.erase(side, side + 2);
}

/// Each facet with corners of its own, `noise` from where they were.
Surface in_pieces(const Surface& whole, double noise) {
  Surface pieces;
  for (const Triangle& t : whole.facets) {
    for (std::size_t k = 0; k < 3; ++k) {
      Point p = whole.vertices[t[k]];
      p[k] += noise;
      pieces.vertices.push_back(p);
    }
    const auto n = static_cast<Index>(pieces.vertices.size());
    pieces.facets.push_back({n - 3, n - 2, n - 1});
  }
  return pieces;
}

// Facets of a body whose vertices do not coincide are components of one facet each, which enclose nothing.
TEST(RepairPromise, AUnionKeepsWhatOnlyAWeldCloses) {
  const Surface box = small::box({0, 0, 0}, {1, 1, 1});
  RepairOptions options;
  options.unite = true;
  options.weld = 1e-6;
  const RepairResult repaired = repair(in_pieces(box, 1e-9), options);
  ASSERT_EQ(repaired.outcome, Outcome::done);
  EXPECT_EQ(repaired.surface.facets.size(), box.facets.size());
  EXPECT_TRUE(repaired.dropped.empty());
}

// A union drops fillings, or a part of one, and renumbers those after them.
TEST(RepairPromise, FillingsLeftByAUnionHaveCorrectNumbers) {
  RepairOptions options;
  options.unite = true;
  options.fill_holes = 100;
  Surface surface = small::box({0, 0, 0}, {4, 4, 4});
  add_open_box(surface, {1, 1, 1}, {2, 2, 2});    // inside
  add_open_box(surface, {3, 3, 3}, {6, 5, 3.5});  // in part
  add_open_box(surface, {7, 7, 7}, {8, 8, 8});    // outside
  EXPECT_EQ(broken(surface, options), "");
  EXPECT_EQ(repair(surface, options).filled.size(), 1u);

  // The filling of a square, whose diagonal is an edge of a prism round one half.
  Surface half = small::surface_of(
      {{-1, -1, 0.5}, {2, 2, 0.5}, {2, 2, 2}, {-1, -1, 2}, {2, -1, 0.5}, {2, -1, 2}, {0, 0, 1}, {1, 1, 1}},
      {{0, 6, 1},
       {1, 6, 7},
       {1, 7, 2},
       {2, 7, 6},
       {2, 6, 3},
       {3, 6, 0},
       {0, 5, 3},
       {0, 4, 5},
       {1, 5, 4},
       {1, 2, 5},
       {0, 1, 4},
       {2, 3, 5}});
  add_open_box(half, {0, 0, 0}, {1, 1, 1});
  EXPECT_EQ(broken(half, options), "");
  const RepairResult united = repair(half, options);
  ASSERT_EQ(united.filled.size(), 1u);
  EXPECT_EQ(united.filled[0].facets.size(), 1u);
  EXPECT_EQ(united.filled[0].border.size(), 3u);
}

/// Boxes with integer corners between 0 and kCells. Of those below, none lies inside another one.
constexpr int kCells = 10;
using Corners = std::array<std::array<int, 3>, 2>;

std::vector<Corners> random_boxes(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<Corners> boxes(count);
  for (auto& [low, high] : boxes)
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = static_cast<int>(random() % (kCells - 1));
      high[k] = low[k] + 1 + static_cast<int>(random() % std::min<unsigned>(4, kCells - low[k]));
    }
  return boxes;
}

bool is_in_one(const std::vector<Corners>& boxes, const Point& p) {
  return std::any_of(boxes.begin(), boxes.end(), [&](const Corners& box) {
    for (std::size_t k = 0; k < 3; ++k)
      if (p[k] < box[0][k] || p[k] > box[1][k]) return false;
    return true;
  });
}

/// The area of the boundary of the union, by cells.
int area_of_union(const std::vector<Corners>& boxes) {
  int area = 0;
  for (std::size_t k = 0; k < 3; ++k)
    for (int i = -1; i < kCells; ++i)
      for (int j = 0; j < kCells; ++j)
        for (int l = 0; l < kCells; ++l) {
          Point p{};
          p[k] = i + 0.5;
          p[(k + 1) % 3] = j + 0.5;
          p[(k + 2) % 3] = l + 0.5;
          const bool here = is_in_one(boxes, p);
          p[k] += 1;
          if (is_in_one(boxes, p) != here) ++area;
        }
  return area;
}

TEST(RepairPromise, TheUnionOfManyComponentsIsThatOfTheirInsides) {
  RepairOptions options;
  options.unite = true;
  for (const std::size_t count : {1, 2, 3, 5, 24}) {
    const std::vector<Corners> boxes = random_boxes(count, static_cast<unsigned>(count));
    Surface surface;
    for (std::size_t b = 0; b < count; ++b) {
      const auto& [low, high] = boxes[b];
      const std::size_t before = surface.facets.size();
      small::add_box(surface, {1. * low[0], 1. * low[1], 1. * low[2]},
                     {1. * high[0], 1. * high[1], 1. * high[2]});
      if (b % 3 == 2)
        for (std::size_t f = before; f < surface.facets.size(); ++f)
          std::swap(surface.facets[f][1], surface.facets[f][2]);
    }
    EXPECT_EQ(broken(surface, options), "");
    const Surface united = repair(surface, options).surface;
    double area = 0;
    for (const Triangle& t : united.facets) {
      const Point &a = united.vertices[t[0]], &b = united.vertices[t[1]], &c = united.vertices[t[2]];
      for (std::size_t k = 0; k < 3; ++k) {  // all but one of these are 0
        const std::size_t l = (k + 1) % 3, m = (k + 2) % 3;
        area += std::fabs((b[l] - a[l]) * (c[m] - a[m]) - (b[m] - a[m]) * (c[l] - a[l])) / 2;
      }
    }
    EXPECT_NEAR(area, area_of_union(boxes), 1e-9) << count;
  }
}

/// Boxes one inside the other; the lengths of their sides, negative if the box faces inwards.
Surface boxes_in_boxes(std::initializer_list<double> lengths) {
  Surface surface;
  for (const double length : lengths) {
    const double half = std::abs(length) / 2;
    small::add_box(surface, {-half, -half, -half}, {half, half, half}, length > 0);
  }
  return surface;
}

std::size_t facets_united(const Surface& surface) {
  RepairOptions options;
  options.unite = true;
  EXPECT_EQ(broken(surface, options), "");
  return repair(surface, options).surface.facets.size();
}

// `Keep::automatic` keeps the same of these surfaces, which are valid.
TEST(RepairPromise, AUnionKeepsCavities) {
  EXPECT_EQ(facets_united(boxes_in_boxes({8, -6})), 24u);
  EXPECT_EQ(facets_united(boxes_in_boxes({-8, 6})), 24u) << "all turned";
  EXPECT_EQ(facets_united(boxes_in_boxes({-2, 4, -6, 8})), 48u) << "a hollow box in a hollow box";
  EXPECT_EQ(facets_united(boxes_in_boxes({8, -6, -4})), 36u) << "what is in a cavity is no cavity of it";
  EXPECT_EQ(facets_united(boxes_in_boxes({8, 6})), 12u) << "no cavity";
  EXPECT_EQ(facets_united(boxes_in_boxes({8, -6, 10})), 12u) << "filled by another box";
  Surface crossing = boxes_in_boxes({8, -6}), solid = boxes_in_boxes({8});
  for (Surface* surface : {&crossing, &solid}) small::add_box(*surface, {2, -1, -1}, {9, 1, 1});
  EXPECT_GT(facets_united(crossing), facets_united(solid) + 12) << "a bar that ends in the cavity";
  Surface turned = small::box(), other = turned;
  small::add_box(turned, {0.5, 0.25, 0.25}, {2, 0.75, 0.75}, false);
  small::add_box(other, {0.5, 0.25, 0.25}, {2, 0.75, 0.75}, true);
  EXPECT_EQ(facets_united(turned), facets_united(other)) << "a box that crosses another one is no cavity";
}

// Sheets are joined first: their displacement counts in all later attempts from there.
TEST(RepairPromise, DisplacementByJoiningIsReported) {
  RepairOptions options;
  options.join = 1.72e-10;
  EXPECT_EQ(broken(surface_of({{0.78230180167084773, 0.91277626271049739, 0.014196584253915925},
                               {0.78230180167096208, 0.91277626271049062, 0.014196584246003958},
                               {-0.69567616982978953, 0.6907896849385109, -0.71471315715921779},
                               {-0.69567616987154302, 0.69078968495770687, -0.71471315715918649},
                               {-0.81806872662288943, -0.22983699459378948, 0.10288034837448359},
                               {-0.72732525057736508, -0.80227018814793483, 0.036665929576359835},
                               {-0.7273252506563348, -0.80227018814110151, 0.036665929588059434},
                               {0.33896922703516452, -0.22247887079805317, -0.51166402029211444}},
                              {{1, 3, 6}, {2, 5, 0}, {5, 0, 7}, {7, 1, 4}}),
                   options),
            "");
}

// Parts of facets became lines, so that the rest is further from them than anything was moved.
TEST(RepairPromise, TheDistanceIncludesLostParts) {
  EXPECT_EQ(broken(surface_of({{0.87180994922371835, 0.29635286399472371, 0.45241517936327669},
                               {-0.8221116601398486, 0.21416576819116684, -0.026287277042707224},
                               {0.84751037095477622, 0.24307896107166482, 0.56091730994639688},
                               {0.72635335368777487, -0.022543228124077719, 1.1019058967881366},
                               {0.39827627687462974, 0.21090862268226707, -0.40065174132989606},
                               {0.69220467338851355, 0.065228669761897423, 0.33507113464863097},
                               {0.311619979644363, 0.36640316994917477, 0.73309229936478548},
                               {-0.82211166013984838, 0.21416576819116684, -0.026287277042712276},
                               {-1.5837993675696704, -0.42218263173412907, -0.29849986023053998},
                               {-0.17860373367785631, 0.64293750363519109, 0.25793531029507633},
                               {-0.073339774277394465, 0.44688882924709161, -0.41011674660950526},
                               {-0.99130955871567772, 0.96529354525420175, 0.48340564538452124},
                               {0.39827627687463085, 0.21090862268226707, -0.40065174132988762}},
                              {{0, 1, 2}, {0, 1, 3}, {4, 5, 6}, {7, 8, 9}, {10, 11, 12}})),
            "");
  EXPECT_EQ(broken(surface_of({{-0.00421249394542067, 0.59501494780387265, 0.46880989054076072},
                               {0.54762964950184168, 0.10632479237630646, 0.94182066567681211},
                               {-0.081281254789095495, -0.30729399467463958, 1.0295638897117829},
                               {-0.063749339475028671, -0.10203308489111569, 0.9020012882390045},
                               {0.30795591241292608, 0.095601093858630914, 0.81791970817182746},
                               {1.0196470068464365, 0.12744421889231217, 1.1858332272500427},
                               {0.54762964950184168, 0.10632479237643803, 0.94182066566836153},
                               {-0.67711523344896374, -0.3107827447629552, 0.80640785445242869},
                               {0.55743729793861019, 0.01444538079563773, 0.89016226596797554},
                               {0.45866462239575256, -0.50695271389664087, 0.2646643449719891},
                               {0.50845939344403501, -0.24409764182464444, 0.57999979170335814},
                               {-0.67711523345108415, -0.31078274476275358, 0.80640785445242869},
                               {-0.13381478832357804, 0.28800466805965064, -1.1337474955738769},
                               {0.55743729793957919, 0.014445380795632221, 0.89016226596797554}},
                              {{0, 1, 2}, {0, 1, 3}, {4, 5, 6}, {7, 8, 9}, {7, 8, 10}, {11, 12, 13}})),
            "");
  EXPECT_EQ(broken(surface_of({{-0.16704602982176642, 0.31496332102098162, -0.39359839839086969},
                               {-0.15579371935532452, 0.32455719687212559, -0.37937324744374212},
                               {-0.084619115125565553, 0.38524165085858286, -0.28939443893240729},
                               {0.001631464296179359, 0.45878009023245869, -0.18035660930524317},
                               {0.18087642781721977, 0.61160683036311281, 0.046244555943884672},
                               {0.19716661634368732, 0.6254960708189049, 0.066838583330147014},
                               {0.22424309009139523, 0.64858184765201721, 0.1010686134523453},
                               {0.29961108622738641, 0.71284164563495533, 0.19634870057586262},
                               {-0.54834691823954196, 0.74702306493616599, 0.69211680412647403},
                               {-0.46213066543221815, 0.84170973612615607, -0.87246648110120395},
                               {0.9707134883346773, -0.57998332019793031, 0.68090959964452202},
                               {0.24234949681743401, -0.86439592691828571, -0.022999935420928042}},
                              {{0, 5, 8},
                               {0, 5, 10},
                               {1, 2, 5},
                               {1, 5, 7},
                               {1, 5, 9},
                               {3, 5, 11},
                               {3, 6, 9},
                               {3, 7, 8},
                               {4, 6, 11}})),
            "");
}

/// Boxes on a lattice, rotated together, with each vertex rounded to floats separately: their planes coincide
/// up to these last bits.
Surface turned_boxes(int count) {
  std::uint32_t random = 10;
  const auto next = [&](std::uint32_t below) {
    random = random * 1664525U + 1013904223U;
    return (random >> 16) % below;
  };
  // By the quaternion (3, 1, 2, 5).
  const std::array<Point, 3> turn{{{1 - 58.0 / 39, -26.0 / 39, 22.0 / 39},
                                   {34.0 / 39, 1 - 52.0 / 39, 14.0 / 39},
                                   {-2.0 / 39, 26.0 / 39, 1 - 10.0 / 39}}};
  Surface surface;
  for (int box = 0; box < count; ++box) {
    std::array<std::uint32_t, 3> low{}, size{};
    for (std::uint32_t& x : low) x = next(4);
    for (std::uint32_t& x : size) x = 1U << next(3);
    const auto first = static_cast<Index>(surface.vertices.size());
    for (unsigned corner = 0; corner < 8; ++corner) {
      Point p{}, q{};
      for (unsigned k = 0; k < 3; ++k) p[k] = (low[k] + ((corner >> k & 1U) != 0 ? size[k] : 0)) / 4.0;
      for (unsigned k = 0; k < 3; ++k)
        q[k] = static_cast<float>(turn[k][0] * p[0] + turn[k][1] * p[1] + turn[k][2] * p[2]);
      surface.vertices.push_back(q);
    }
    for (const auto& [a, b, c] : small::kSidesOfBox)
      surface.facets.push_back({first + a, first + b, first + c});
  }
  return surface;
}

// No doubles were found: sheets 1e-7 apart have intersection lines all over them.
TEST(RepairPromise, APileOfTurnedBoxesIsRepaired) { EXPECT_EQ(broken(turned_boxes(24)), ""); }

// Lines that run into each other leave a part thinner than a last bit, from one side of a facet to another.
// Its edge along the side is 6e-9 long and lost with it.
TEST(RepairPromise, APartThinnerThanALastBitFromSideToSide) {
  EXPECT_EQ(broken(surface_of({{505.195, 1.76373, -35.951873},
                               {505.195, 2.76376, -35.951801},
                               {503.195, 1.823737, -35.951915},
                               {505.195, 2.76376, -35.951801},
                               {505.195, 1.76373, -35.951873},
                               {503.195, 2.82375, -35.9519},
                               {505.195, 1.76373, -35.95187},
                               {505.195, 1.76375, -44.951801},
                               {503.195, 1.823737, -35.95192},
                               {492.1382, 2.227685, -68.5901},
                               {487.95123, 2.32865, -61.3815},
                               {489.39422, 2.32863, -69.0081},
                               {492.1382, 2.22768, -68.5901},
                               {489.3945, 3.328655, -69.0081},
                               {489.3942, 2.32863, -69.0081},
                               {492.1382, 2.22768, -68.5901},
                               {492.1385, 3.227675, -68.5901},
                               {489.3942, 2.32863, -69.0081}},
                              {{1, 2, 0}, {4, 5, 3}, {7, 8, 6}, {11, 10, 9}, {14, 13, 12}, {16, 17, 15}})),
            "");
}

// A needle of which a part is thinner than the tolerance: that part is lost, and the distance says so however
// long it is.
TEST(RepairPromise, TheDistanceIncludesALongTipThatWeldingLoses) {
  RepairOptions options;
  options.weld = 1e-6;
  EXPECT_EQ(broken(surface_of({{-81.127555000000001, -76.661299999999997, 37.944443999999997},
                               {-54.577800000000003, 84.4465, 53.185000000000002},
                               {-54.562477732601138, 84.438095884786563, 53.180064051601754},
                               {55.885800000000003, 23.606200000000001, 17.8367},
                               {55.885764000000002, 23.606200000000001, 17.8367},
                               {-70.685900000000004, -13.299300000000001, 43.938400000000001}},
                              {{0, 1, 2}, {3, 4, 5}}),
                   options),
            "");
}

}  // namespace
}  // namespace holdfast::repair_promise_test
