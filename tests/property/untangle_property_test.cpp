// Untangling random meshes of hard surfaces: positive with the surface unchanged, or refused for a reason.
//
// HOLDFAST_SEEDS=k takes k times as many meshes of each family.
#include <gtest/gtest.h>

#include <cstdlib>
#include <functional>
#include <map>
#include <numeric>
#include <ostream>
#include <set>

#include "dangling_surfaces.h"
#include "hard_surfaces.h"
#include "holdfast/check.h"
#include "holdfast/untangle.h"

namespace holdfast::untangle_property_test {
namespace {

struct Family {
  const char* name;
  std::function<Surface(hard::Random&)> make;
  int count;
  Keep keep = Keep::automatic;
};

std::ostream& operator<<(std::ostream& out, const Family& family) { return out << family.name; }

const Family kFamilies[] = {
    {"stars", hard::star, 6},
    {"spikes", hard::spikes, 4},
    {"twisted_prisms", hard::twisted_prism, 10},
    {"nested_spheres", hard::nested_spheres, 4},
    {"voxels", hard::voxels, 6},
    {"combs", hard::comb, 3},
    {"lattices", hard::lattice, 8, Keep::bounded},
    {"scattered", hard::scattered, 4, Keep::box},
    {"furnished", hard::furnished, 6, Keep::box},
    {"chazelle", [](hard::Random&) { return hard::chazelle(3); }, 2, Keep::bounded},
};

int seed_factor() {
  const char* const text = std::getenv("HOLDFAST_SEEDS");
  return text == nullptr ? 1 : std::max(1, std::atoi(text));
}

double extent(const std::vector<Point>& points) {
  double most = 0;
  for (const Point& p : points)
    for (std::size_t k = 0; k < 3; ++k) most = std::max(most, std::abs(p[k] - points[0][k]));
  return most;
}

void displace(std::vector<Point>& points, std::size_t from, std::size_t to, double by, hard::Random& random) {
  std::normal_distribution<double> normal(0, by);
  for (std::size_t v = from; v < to; ++v)
    for (double& x : points[v]) x += normal(random);
}

// The regions at every facet, segment end and facet corner. A dangling facet that moves into another region
// has no mesh with the same connectivity; an isolated point may move, and does.
auto places(const Surface& surface, const Volume& volume) {
  std::map<std::vector<Index>, std::set<int>> regions;
  for (const Segment& segment : surface.segments)
    for (const Index v : segment) regions[{v}];
  for (const Triangle& f : surface.facets) {
    for (const Index v : f) regions[{v}];
    std::vector<Index> key(f.begin(), f.end());
    std::ranges::sort(key);
    regions[key];
  }
  for (std::size_t t = 0; t < volume.tetrahedra.size(); ++t) {
    Tetrahedron c = volume.tetrahedra[t];
    std::ranges::sort(c);
    for (std::size_t i = 0; i < 4; ++i) {
      const std::vector<Index> corner{c[i]};
      std::vector<Index> face(c.begin(), c.end());
      face.erase(face.begin() + static_cast<long>(i));
      for (const auto& key : {corner, face})
        if (const auto at = regions.find(key); at != regions.end()) at->second.insert(volume.regions[t]);
    }
  }
  return regions;
}

class Untangled : public ::testing::TestWithParam<Family> {
 protected:
  // With the surface's vertices fixed, including isolated points.
  static UntangleResult untangled(const Surface& surface, const Volume& tangled) {
    UntangleOptions options;
    options.fixed.resize(surface.vertices.size());
    std::iota(options.fixed.begin(), options.fixed.end(), Index{0});
    return untangle(tangled, options);
  }
  void expect_untangled(const Surface& surface, const Volume& tangled) const {
    const UntangleResult result = untangled(surface, tangled);
    ASSERT_EQ(result.outcome, Outcome::done) << result.message;
    CheckOptions box;
    box.box = GetParam().keep == Keep::box;
    for (const Rule& rule : check(surface.view(), result.volume, box).rules)
      EXPECT_TRUE(rule.holds) << rule.name << ": " << rule.detail;
  }
};

TEST_P(Untangled, InnerVerticesDisplacedOrSurfaceMoved) {
  hard::Random random(1);
  for (int k = 0; k < GetParam().count * seed_factor(); ++k) {
    SCOPED_TRACE(k);
    const Surface surface = GetParam().make(random);
    Options options;
    options.keep = GetParam().keep;
    const Result filled = mesh(surface.view(), options);
    ASSERT_EQ(filled.outcome, Outcome::done) << filled.message;
    const std::size_t n = surface.vertices.size();
    const double size = extent(surface.vertices);

    // The corners of a box also belong to the boundary.
    Volume tangled = filled.volume;
    const std::size_t first_free = n + (options.keep == Keep::box ? 8 : 0);
    displace(tangled.vertices, first_free, tangled.vertices.size(), size * (k % 2 == 0 ? 0.01 : 1), random);
    expect_untangled(surface, tangled);

    Surface moved = surface;
    const int digits = (options.keep == Keep::box ? 2 : 1) + k % 5;  // nothing leaves the box
    displace(moved.vertices, 0, n, size * std::pow(10.0, -digits), random);
    tangled = filled.volume;
    std::copy(moved.vertices.begin(), moved.vertices.end(), tangled.vertices.begin());
    const Result again = mesh(moved.view(), options);
    if (again.outcome == Outcome::done && places(surface, filled.volume) == places(surface, again.volume)) {
      expect_untangled(moved, tangled);
    } else {
      const Outcome outcome = untangled(moved, tangled).outcome;
      EXPECT_TRUE(outcome == Outcome::invalid_input || outcome == Outcome::not_representable)
          << static_cast<int>(outcome);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Families, Untangled, ::testing::ValuesIn(kFamilies),
                         [](const auto& family) { return family.param.name; });

}  // namespace
}  // namespace holdfast::untangle_property_test
