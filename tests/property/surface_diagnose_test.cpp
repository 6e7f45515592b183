// Property tests of the diagnosis: random small complexes against the all-pairs oracle of surface_oracle.h.
// The oracle sees small integers; the library sees their image under an integer affine map with large
// entries, which changes the axes and the filters but not the truth.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <string>

#include "holdfast/holdfast.h"
#include "property/surface_oracle.h"
#include "property/surface_truth.h"
#include "surface/complex.h"
#include "surface/diagnose.h"

namespace holdfast::surface_diagnose_test {
namespace {

using oracle::ElementKey;
using oracle::IntPoint;
using oracle::PairKey;
using oracle::Sample;
using oracle::Truth;
using oracle::truth_of;
using Random = std::mt19937_64;

struct Shape {
  int size_x, size_y, size_z;  // of the grid
  int vertices, facets, segments;
  bool repeats;  // allow identical vertices
};

int below(Random& random, int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); }

Sample make_sample(const Shape& shape, Random& random) {
  Sample sample;
  std::set<IntPoint> seen;
  for (int i = 0; i < shape.vertices; ++i) {
    const IntPoint p{below(random, shape.size_x), below(random, shape.size_y), below(random, shape.size_z)};
    if (seen.insert(p).second || shape.repeats) sample.points.push_back(p);
  }
  const int n = static_cast<int>(sample.points.size());
  const auto pick = [&] { return static_cast<Index>(below(random, n)); };
  for (int i = 0; i < shape.facets; ++i) sample.facets.push_back({pick(), pick(), pick()});
  for (int i = 0; i < shape.segments; ++i) sample.segments.push_back({pick(), pick()});
  return sample;
}

// --- What the library says ----------------------------------------------------------------------

// An integer matrix with a nonzero determinant, an offset and a power of two.
struct Map {
  std::array<std::array<double, 3>, 3> matrix{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  Point offset{0, 0, 0};
  double scale = 1;

  [[nodiscard]] Point operator()(const IntPoint& p) const {
    Point q;
    for (std::size_t i = 0; i < 3; ++i) {
      q[i] = offset[i];
      for (std::size_t j = 0; j < 3; ++j) q[i] += matrix[i][j] * static_cast<double>(p[j]);
      q[i] *= scale;
    }
    return q;
  }
};

Map make_map(Random& random) {
  Map map;
  const int kind = below(random, 3);
  if (kind == 0) return map;
  const int range = kind == 1 ? 3 : 1 << 20;
  double determinant = 0;
  while (determinant == 0) {
    auto& m = map.matrix;
    for (auto& row : m) {
      for (double& x : row) x = below(random, 2 * range) - range;
    }
    determinant = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                  m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                  m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
  }
  if (kind == 2) {
    for (double& x : map.offset) x = below(random, 1 << 30);
    map.scale = std::ldexp(1.0, below(random, 1200) - 600);
  }
  return map;
}

Surface image(const Sample& sample, const Map& map) {
  Surface surface;
  for (const IntPoint& p : sample.points) surface.vertices.push_back(map(p));
  surface.facets = sample.facets;
  surface.segments = sample.segments;
  return surface;
}

PairKey key(ElementKey a, ElementKey b) { return {std::min(a, b), std::max(a, b)}; }

// The pairs of elements implied by a defect (surface/diagnose.h): those with the first simplex as a face,
// combined with those with the second.
void expand(const Defect& defect, const Truth& truth, std::set<PairKey>& pairs) {
  std::vector<Index> first, second;
  const auto& v = defect.vertices;
  switch (defect.kind) {
    case DefectKind::vertex_in_segment:
      first = {v[0]};
      second = {v[1], v[2]};
      break;
    case DefectKind::vertex_in_facet:
      first = {v[0]};
      second = truth.elements.at({0, defect.facets[0]});
      break;
    case DefectKind::segments_cross:
    case DefectKind::segments_overlap:
      first = {v[0], v[1]};
      second = {v[2], v[3]};
      break;
    case DefectKind::segment_pierces_facet:
      first = {v[0], v[1]};
      second = truth.elements.at({0, defect.facets[0]});
      break;
    case DefectKind::repeated_facet:
    case DefectKind::facets_cross:
    case DefectKind::facets_overlap:
      pairs.insert(key({0, defect.facets[0]}, {0, defect.facets[1]}));
      return;
    default:
      return;
  }
  const auto holds = [](const std::vector<Index>& element, const std::vector<Index>& face) {
    return std::all_of(face.begin(), face.end(), [&](Index x) {
      return std::find(element.begin(), element.end(), x) != element.end();
    });
  };
  for (const auto& [a, corners_a] : truth.elements) {
    if (!holds(corners_a, first)) continue;
    for (const auto& [b, corners_b] : truth.elements) {
      if (holds(corners_b, second)) pairs.insert(key(a, b));
    }
  }
}

// The interiors of the two simplices that the defect names must meet.
void expect_true(const Defect& defect, const Sample& sample, const Truth& truth) {
  const auto points = [&](const std::vector<Index>& vertices) {
    std::vector<IntPoint> result;
    for (const Index v : vertices) result.push_back(sample.points[v]);
    return result;
  };
  const auto facet = [&](std::size_t i) { return points(truth.elements.at({0, defect.facets[i]})); };
  const auto& v = defect.vertices;
  switch (defect.kind) {
    case DefectKind::vertex_in_segment:
      EXPECT_TRUE(oracle::interiors_meet(points({v[0]}), points({v[1], v[2]})));
      break;
    case DefectKind::vertex_in_facet:
      EXPECT_TRUE(oracle::interiors_meet(points({v[0]}), facet(0)));
      break;
    case DefectKind::segments_cross:
    case DefectKind::segments_overlap:
      EXPECT_TRUE(oracle::interiors_meet(points({v[0], v[1]}), points({v[2], v[3]})));
      break;
    case DefectKind::segment_pierces_facet:
      EXPECT_TRUE(oracle::interiors_meet(points({v[0], v[1]}), facet(0)));
      break;
    case DefectKind::repeated_facet:
    case DefectKind::facets_cross:
    case DefectKind::facets_overlap:
      EXPECT_TRUE(oracle::interiors_meet(facet(0), facet(1)));
      break;
    default:
      break;
  }
}

// The pairs again, with hubs and oriented boxes from the start.
std::set<PairKey> pairs_with_every_means(const Complex& complex) {
  const Elements elements = elements_of(complex);
  std::set<PairKey> pairs;
  const auto element = [&](Index i) { return ElementKey{3u - elements.all[i].corners, elements.all[i].id}; };
  const auto visit = [&](Index i, Index j, const Contacts&) {
    EXPECT_TRUE(pairs.insert(key(element(i), element(j))).second);
    return true;
  };
  for_each_offending_pair(complex, elements, visit, [](double) {}, {.hub_degree = 3, .patience = 0});
  return pairs;
}

// `mesh` searches most of the defects among what Delaunay leaves missing.
void expect_same_from_mesh(const Complex& complex, const std::vector<Defect>& defects) {
  Options options;
  options.stop_after = Stage::delaunay;
  const Result result = mesh(complex, options);
  ASSERT_EQ(result.outcome, defects.empty() ? Outcome::done : Outcome::invalid_input);
  ASSERT_LE(result.defects.size(), defects.size());
  for (std::size_t k = 0; k < result.defects.size(); ++k)
    EXPECT_EQ(result.defects[k].message, defects[k].message);
}

void check(const Sample& sample, const Map& map) {
  const Truth truth = truth_of(sample);
  const Surface surface = image(sample, map);
  const Complex complex = surface.view();

  std::set<PairKey> pairs;
  for (const auto& [a, b] : offending_pairs(complex, SIZE_MAX, [](double) {})) {
    EXPECT_TRUE(pairs.insert(key({3 - a.corners, a.id}, {3 - b.corners, b.id})).second);
  }
  EXPECT_EQ(pairs, truth.pairs);

  EXPECT_EQ(pairs_with_every_means(complex), truth.pairs);

  const std::vector<Defect> defects = diagnose(complex);
  EXPECT_EQ(defects.empty(), truth.valid());
  std::set<PairKey> implied;
  std::set<Index> flat_facets, flat_segments;
  std::set<std::string> messages;
  for (const Defect& defect : defects) {
    expand(defect, truth, implied);
    expect_true(defect, sample, truth);
    if (defect.kind == DefectKind::degenerate_facet) flat_facets.insert(defect.facets.at(0));
    if (defect.kind == DefectKind::degenerate_segment) flat_segments.insert(defect.segments.at(0));
    EXPECT_NE(defect.kind, DefectKind::repeated_vertex);
    EXPECT_TRUE(messages.insert(defect.message).second) << "told twice: " << defect.message;
    EXPECT_FALSE(defect.where.empty());
    EXPECT_LE(defect.where.size(), 2u);
  }
  EXPECT_EQ(implied, truth.pairs);
  EXPECT_EQ(flat_facets, truth.flat_facets);
  EXPECT_EQ(flat_segments, truth.flat_segments);

  expect_same_from_mesh(complex, defects);
  if (!defects.empty()) {
    EXPECT_EQ(diagnose(complex, 1).size(), 1u);
    EXPECT_EQ(diagnose(complex, defects.size()).size(), defects.size());
  }
}

void check_many(const Shape& shape, unsigned seeds) {
  std::size_t valid = 0;
  for (unsigned seed = 0; seed < seeds; ++seed) {
    Random random(seed);
    const Sample sample = make_sample(shape, random);
    if (sample.points.empty()) continue;
    SCOPED_TRACE("seed " + std::to_string(seed));
    check(sample, make_map(random));
    if (::testing::Test::HasFailure()) return;
    valid += truth_of(sample).valid();
  }
  ::testing::Test::RecordProperty("valid", static_cast<int>(valid));
}

TEST(SurfaceDiagnose, PairsOfFacetsInSpace) { check_many({3, 3, 3, 8, 2, 0, false}, 3000); }
TEST(SurfaceDiagnose, FacetsInSpace) { check_many({3, 3, 3, 8, 5, 0, false}, 1500); }
TEST(SurfaceDiagnose, FacetsOnALargerGrid) { check_many({5, 5, 5, 9, 4, 0, false}, 1500); }
TEST(SurfaceDiagnose, FacetsInAPlane) { check_many({5, 5, 1, 8, 3, 0, false}, 2000); }
TEST(SurfaceDiagnose, FewVerticesManyShared) { check_many({2, 2, 2, 5, 4, 1, false}, 2000); }
TEST(SurfaceDiagnose, ThinSlab) { check_many({4, 4, 2, 8, 4, 2, false}, 1500); }
TEST(SurfaceDiagnose, SegmentsInSpace) { check_many({3, 3, 3, 8, 1, 4, false}, 2000); }
TEST(SurfaceDiagnose, SegmentsOnALine) { check_many({8, 1, 1, 7, 0, 4, false}, 1000); }
TEST(SurfaceDiagnose, SegmentsInAPlane) { check_many({4, 4, 1, 8, 1, 4, false}, 1500); }
TEST(SurfaceDiagnose, IdenticalVertices) { check_many({2, 2, 2, 9, 4, 2, true}, 1500); }
TEST(SurfaceDiagnose, IsolatedVertices) { check_many({3, 3, 3, 14, 2, 1, false}, 1500); }

}  // namespace
}  // namespace holdfast::surface_diagnose_test
