// Vertices at one place are one vertex: a complex whose vertices were split at random has the mesh, and the
// defects, of the complex with each place once.
#include <gtest/gtest.h>

#include <bit>

#include "dangling_surfaces.h"
#include "hard_surfaces.h"
#include "holdfast/check.h"
#include "holdfast/holdfast.h"
#include "property/surface_truth.h"
#include "split_vertices.h"

namespace holdfast::merged_vertices_test {
namespace {

using split::Joined;
using split::Random;

bool same_bits(const Point& p, const Point& q) {
  return std::equal(p.begin(), p.end(), q.begin(), [](double x, double y) {
    return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
  });
}

void expect_same_volume(const Volume& a, const Volume& b) {
  EXPECT_TRUE(
      std::equal(a.vertices.begin(), a.vertices.end(), b.vertices.begin(), b.vertices.end(), same_bits));
  EXPECT_EQ(a.tetrahedra, b.tetrahedra);
  EXPECT_EQ(a.regions, b.regions);
  EXPECT_EQ(a.facets, b.facets);
  EXPECT_EQ(a.segments, b.segments);
  EXPECT_EQ(a.facet_markers, b.facet_markers);
  EXPECT_EQ(a.segment_markers, b.segment_markers);
}

std::string broken_rules(const Surface& surface, const Volume& volume, const CheckOptions& options) {
  std::string text;
  for (const Rule& rule : check(surface.view(), volume, options).rules)
    if (!rule.holds) text += rule.name + ": " + rule.detail + "\n";
  return text;
}

void mark(Surface& surface, Random& random) {
  const auto markers = [&](std::size_t count) {
    std::vector<int> values(count);
    for (int& m : values) m = static_cast<int>(random() % 5);
    return values;
  };
  surface.facet_markers = markers(surface.facets.size());
  surface.segment_markers = markers(surface.segments.size());
}

// Sizes for the split vertices, and the least at each place for the joined ones.
std::array<Sizes, 2> random_sizes(const Joined& whole, Random& random) {
  std::array<Sizes, 2> sizes;
  for (Sizes& s : sizes) s.gradation = 0.8;
  sizes[1].vertex_sizes.assign(whole.origin.size(), 0);
  for (const std::int64_t v : whole.map) {
    const double size = split::one_in(random, 3) ? 0 : hard::uniform(random, 0.5, 2);
    sizes[0].vertex_sizes.push_back(size);
    if (v < 0 || size == 0) continue;
    double& least = sizes[1].vertex_sizes[static_cast<std::size_t>(v)];
    if (least == 0 || size < least) least = size;
  }
  return sizes;
}

void expect_same_mesh(const Surface& surface, Keep keep, bool with_sizes, Random& random) {
  const Joined whole = split::joined(surface);
  std::array<Options, 2> options;
  options[0].keep = options[1].keep = keep;
  if (with_sizes) {
    const std::array<Sizes, 2> sizes = random_sizes(whole, random);
    for (std::size_t k = 0; k < 2; ++k) options[k].sizes = sizes[k];
  }
  const Result result = mesh(surface.view(), options[0]);
  const Result expected = mesh(whole.surface.view(), options[1]);
  ASSERT_EQ(result.outcome, expected.outcome) << result.message;
  ASSERT_EQ(expected.outcome, Outcome::done) << expected.message;
  expect_same_volume(result.volume, expected.volume);
  EXPECT_EQ(result.facet_regions, expected.facet_regions);

  EXPECT_TRUE(expected.vertex_map.empty());
  EXPECT_EQ(result.vertex_map, whole.map);
  EXPECT_EQ(vertex_map(surface.view()), whole.map);
  std::vector<std::int64_t> origin = whole.origin;
  origin.resize(result.volume.vertices.size(), -1);
  EXPECT_EQ(result.volume.input_vertices, origin);

  const Report::Input& counts = result.report.input;
  EXPECT_EQ(counts.vertices, whole.origin.size());
  EXPECT_EQ(counts.left_out_vertices,
            static_cast<std::size_t>(std::count(whole.map.begin(), whole.map.end(), -1)));
  EXPECT_EQ(counts.vertices + counts.merged_vertices + counts.left_out_vertices, surface.vertices.size());
  EXPECT_EQ(counts.components, expected.report.input.components);
  EXPECT_EQ(counts.segments, expected.report.input.segments);
  EXPECT_EQ(counts.closed, expected.report.input.closed);

  CheckOptions check_options;
  check_options.box = keep == Keep::box;
  EXPECT_EQ(broken_rules(surface, result.volume, check_options), "");
}

struct Family {
  const char* name;
  Surface (*make)(hard::Random&);
  int count;
  Keep keep = Keep::automatic;
  bool with_sizes = false;
};

std::ostream& operator<<(std::ostream& out, const Family& family) { return out << family.name; }

const Family kFamilies[] = {
    {"stars", hard::star, 6},
    {"twisted_prisms", hard::twisted_prism, 8},
    {"voxels", hard::voxels, 6},
    {"lattices", hard::lattice, 6, Keep::bounded},
    {"scattered", hard::scattered, 4},
    {"furnished", hard::furnished, 6, Keep::box},
    {"stars_with_sizes", hard::star, 4, Keep::automatic, true},
    {"voxels_with_sizes", hard::voxels, 2, Keep::automatic, true},
};

class MergedVertices : public ::testing::TestWithParam<Family> {};

TEST_P(MergedVertices, GiveTheMeshOfTheComplexWithEachPlaceOnce) {
  const Family& family = GetParam();
  for (int k = 0; k < family.count; ++k) {
    SCOPED_TRACE(std::string(family.name) + " " + std::to_string(k));
    Random random(static_cast<unsigned>(k));
    Surface whole = family.make(random);
    mark(whole, random);
    expect_same_mesh(k % 3 == 0 ? split::soup(whole) : split::split_at_random(whole, random), family.keep,
                     family.with_sizes, random);
    if (HasFailure()) return;
  }
}

INSTANTIATE_TEST_SUITE_P(Families, MergedVertices, ::testing::ValuesIn(kFamilies),
                         [](const auto& info) { return std::string(info.param.name); });

// Small complexes on a grid, most of them with defects.
Surface on_a_grid(Random& random) {
  Surface surface;
  const auto coordinate = [&] { return static_cast<double>(random() % 4) - 1; };
  for (int k = 0; k < 9; ++k) {
    const Point p{coordinate(), coordinate(), coordinate()};
    if (std::find(surface.vertices.begin(), surface.vertices.end(), p) == surface.vertices.end())
      surface.vertices.push_back(p);
  }
  const auto pick = [&] { return static_cast<Index>(random() % surface.vertices.size()); };
  for (int k = 0; k < 5; ++k) surface.facets.push_back({pick(), pick(), pick()});
  for (int k = 0; k < 2; ++k) surface.segments.push_back({pick(), pick()});
  return surface;
}

TEST(MergedDefects, AreThoseOfTheComplexWithEachPlaceOnce) {
  std::size_t found = 0;
  for (unsigned seed = 0; seed < 500; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Surface surface = split::split_at_random(on_a_grid(random), random);
    const Joined whole = split::joined(surface);
    const std::vector<Defect> defects = diagnose(surface.view());
    const std::vector<Defect> expected = diagnose(whole.surface.view());
    ASSERT_EQ(defects.size(), expected.size());
    for (std::size_t k = 0; k < defects.size(); ++k) {
      EXPECT_EQ(defects[k].kind, expected[k].kind);
      EXPECT_EQ(defects[k].facets, expected[k].facets);
      EXPECT_EQ(defects[k].segments, expected[k].segments);
      EXPECT_EQ(defects[k].where, expected[k].where);
      std::vector<std::int64_t> vertices;
      for (const Index v : defects[k].vertices) vertices.push_back(whole.map.at(v));
      EXPECT_EQ(vertices,
                std::vector<std::int64_t>(expected[k].vertices.begin(), expected[k].vertices.end()));
    }
    found += defects.size();
    Options options;
    options.keep = Keep::box;
    const Result result = mesh(surface.view(), options);
    EXPECT_EQ(result.outcome == Outcome::invalid_input, !defects.empty());
    if (HasFailure()) return;
  }
  EXPECT_GT(found, 1000u);
}

}  // namespace
}  // namespace holdfast::merged_vertices_test
