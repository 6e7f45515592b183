// Regions and winding numbers of random grids of cells, compared with components and heights found directly.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "unit/classified.h"

namespace holdfast::classify_grid_test {
namespace {

using testing::Classified;

// Cells of a grid with random materials; the facets are the walls between different ones, so the regions are
// the connected sets of cells of one material.
struct Grid {
  static constexpr int kSize = 5;
  std::vector<int> material = std::vector<int>(kSize * kSize * kSize);
  Surface surface;

  Grid(unsigned seed, int materials) {
    std::mt19937 random(seed);
    for (int& m : material) m = static_cast<int>(random() % static_cast<unsigned>(materials));
    build();
  }

  /// Lowers cells until neighbours, including the outside, differ by at most one.
  void flatten() {
    for (bool changed = true; changed;) {
      changed = false;
      for (int k = 0; k < kSize * kSize * kSize; ++k) {
        const std::array<int, 3> c = cell(k);
        for (std::size_t axis = 0; axis < 3; ++axis)
          for (const int step : {-1, 1}) {
            auto d = c;
            d[axis] += step;
            int& m = material[static_cast<std::size_t>(k)];
            changed = changed || m > at(d) + 1;
            m = std::min(m, at(d) + 1);
          }
      }
    }
    build();
  }

  /// The walls between cells of different materials.
  void build() {
    surface = {};
    for (int z = 0; z <= kSize; ++z)
      for (int y = 0; y <= kSize; ++y)
        for (int x = 0; x <= kSize; ++x)
          surface.vertices.push_back(
              {static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)});
    for (int z = -1; z < kSize; ++z)
      for (int y = -1; y < kSize; ++y)
        for (int x = -1; x < kSize; ++x) {
          const std::array<int, 3> cell{x, y, z};
          for (std::size_t axis = 0; axis < 3; ++axis) add_wall(cell, axis);
        }
    drop_unused_vertices();
  }

  static std::array<int, 3> cell(int k) { return {k % kSize, k / kSize % kSize, k / (kSize * kSize)}; }
  static Point middle(std::size_t k) {
    const auto c = cell(static_cast<int>(k));
    return {c[0] + 0.5, c[1] + 0.5, c[2] + 0.5};
  }
  // -1 outside.
  [[nodiscard]] int at(const std::array<int, 3>& c) const {
    for (const int x : c)
      if (x < 0 || x >= kSize) return -1;
    return material[index(c)];
  }
  static std::size_t index(const std::array<int, 3>& c) {
    return static_cast<std::size_t>((c[2] * kSize + c[1]) * kSize + c[0]);
  }

  // Component of each cell by flooding cells.
  [[nodiscard]] std::vector<int> components() const {
    std::vector<int> component(material.size(), -1);
    int count = 0;
    for (int start = 0; start < kSize * kSize * kSize; ++start) {
      if (component[static_cast<std::size_t>(start)] >= 0) continue;
      std::vector<std::array<int, 3>> stack{cell(start)};
      component[static_cast<std::size_t>(start)] = count;
      while (!stack.empty()) {
        const auto c = stack.back();
        stack.pop_back();
        for (std::size_t axis = 0; axis < 3; ++axis)
          for (const int step : {-1, 1}) {
            auto d = c;
            d[axis] += step;
            if (at(d) != at(c) || component[index(d)] >= 0) continue;
            component[index(d)] = count;
            stack.push_back(d);
          }
      }
      ++count;
    }
    return component;
  }

 private:
  // The wall between a cell and the next one along an axis, facing the lesser material.
  void add_wall(std::array<int, 3> cell, std::size_t axis) {
    auto next = cell;
    ++next[axis];
    const int here = at(cell);
    const int there = at(next);
    if (here == there) return;
    const auto corner = [&](int u, int v) {
      auto c = next;
      c[(axis + 1) % 3] += u;
      c[(axis + 2) % 3] += v;
      return static_cast<Index>((c[2] * (kSize + 1) + c[1]) * (kSize + 1) + c[0]);
    };
    Triangle first{corner(0, 0), corner(1, 0), corner(1, 1)};  // faces along the axis
    Triangle second{corner(0, 0), corner(1, 1), corner(0, 1)};
    if (there > here) {
      std::swap(first[1], first[2]);
      std::swap(second[1], second[2]);
    }
    surface.facets.insert(surface.facets.end(), {first, second});
  }

  void drop_unused_vertices() {
    std::vector<Index> renamed(surface.vertices.size(), no_index);
    std::vector<Point> used;
    for (Triangle& t : surface.facets)
      for (Index& v : t) {
        if (renamed[v] == no_index) {
          renamed[v] = static_cast<Index>(used.size());
          used.push_back(surface.vertices[v]);
        }
        v = renamed[v];
      }
    surface.vertices = used;
  }
};

class RandomGrid : public ::testing::TestWithParam<unsigned> {};

TEST_P(RandomGrid, RegionsAreComponentsOfCells) {
  const Grid grid(GetParam(), 2 + static_cast<int>(GetParam() % 3));
  const Classified scene(grid.surface);
  const std::vector<int> component = grid.components();
  std::vector<int> region_of(component.size(), -1);
  std::vector<bool> seen(scene.regions.count, false);
  std::size_t regions = 1;
  for (std::size_t k = 0; k < component.size(); ++k) {
    const Located located = scene.at(Grid::middle(k));
    ASSERT_FALSE(located.on_facet);
    ASSERT_NE(located.region, 0u);
    int& region = region_of[static_cast<std::size_t>(component[k])];
    if (region < 0) {
      region = static_cast<int>(located.region);
      EXPECT_FALSE(seen[located.region]) << "two components in one region";
      seen[located.region] = true;
      ++regions;
    }
    EXPECT_EQ(region, static_cast<int>(located.region)) << "cell " << k;
  }
  EXPECT_EQ(regions, scene.regions.count);
}

TEST_P(RandomGrid, WindingNumbersAreHeightsThatStepByOne) {
  Grid grid(GetParam(), 4);
  grid.flatten();
  const Classified scene(grid.surface);
  const Winding winding = winding_numbers(scene.regions);
  ASSERT_FALSE(winding.conflict);
  for (std::size_t k = 0; k < grid.material.size(); ++k)
    EXPECT_EQ(winding.number[scene.at(Grid::middle(k)).region], grid.material[k] + 1) << "cell " << k;
}

// Regions joined with offsets: the oracle for whether winding numbers exist.
class Offsets {
 public:
  explicit Offsets(std::size_t size) : parent_(size), offset_(size, 0) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  // Requires number(b) = number(a) + step; returns false if that contradicts an earlier requirement.
  bool demand(std::size_t a, std::size_t b, int step) {
    const auto [root_a, from_a] = find(a);
    const auto [root_b, from_b] = find(b);
    if (root_a == root_b) return from_b == from_a + step;
    parent_[root_b] = root_a;
    offset_[root_b] = from_a + step - from_b;
    return true;
  }

 private:
  [[nodiscard]] std::pair<std::size_t, int> find(std::size_t a) const {
    int offset = 0;
    for (; parent_[a] != a; a = parent_[a]) offset += offset_[a];
    return {a, offset};
  }
  std::vector<std::size_t> parent_;
  std::vector<int> offset_;
};

TEST_P(RandomGrid, ConflictsAreThoseOfTheOracle) {
  const Grid grid(GetParam(), 2);
  const Classified scene(grid.surface);
  Offsets offsets(scene.regions.count);
  bool consistent = true;
  for (const auto& [front, back] : scene.regions.of_facet)
    if (front != back) consistent = offsets.demand(front, back, 1) && consistent;
  EXPECT_EQ(winding_numbers(scene.regions).conflict.has_value(), !consistent);
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomGrid, ::testing::Range(1u, 13u));

}  // namespace
}  // namespace holdfast::classify_grid_test
