// Regions, winding numbers, keep rules, holes and seeds (docs/concepts.md).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <stdexcept>

#include "classify/keep.h"
#include "classify/regions.h"
#include "delaunay/delaunay.h"
#include "enforce/enforce.h"
#include "mesh/editor.h"
#include "recover/standing.h"
#include "small_surfaces.h"
#include "surface/complex.h"

namespace holdfast {
namespace {

// A surface, the mesh that conforms to it in a box from -9 to 9, and the regions there.
struct Scene {
  Surface surface;
  SegmentTable table;
  TetMesh mesh;
  Regions regions;

  explicit Scene(Surface s, int scale = 0) : surface(std::move(s)), table(segment_table(surface.view())) {
    const auto add = [&](const Point& p) {
      MeshEditor(mesh).add_vertex(
          Point{std::ldexp(p[0], scale), std::ldexp(p[1], scale), std::ldexp(p[2], scale)});
    };
    for (const Point& p : surface.vertices) add(p);
    for (const Point& p : small::box({-9, -9, -9}, {9, 9, 9}).vertices) add(p);
    const auto first_free = static_cast<Vertex>(mesh.vertex_count());
    EXPECT_TRUE(build_delaunay(mesh, {}, nullptr));
    Standing standing = mark_present(mesh, table);
    const Options options;
    Monitor monitor(options);
    enforce(mesh, table, surface.facets, standing, first_free, {.seed = 1}, monitor);
    regions = find_regions(mesh, surface.facets);
  }

  [[nodiscard]] Kept choose(const Options& options, int scale = 0) const {
    const Wanted wanted{options.keep, options.holes, options.regions, options.drop_outside};
    return choose_regions(mesh, regions, surface.view(), table, wanted, scale);
  }
  [[nodiscard]] Kept choose(Keep keep) const {
    Options options;
    options.keep = keep;
    return choose(options);
  }
  [[nodiscard]] Located at(const Point& p) const { return locate(mesh, regions, {p.data(), nullptr}); }
};

Point middle_of(const TetMesh& mesh, Tet t) {
  Point middle{};
  for (const Vertex v : mesh.corners(t))
    for (std::size_t i = 0; i < 3; ++i) middle[i] += mesh.position(v)[i] / 4;
  return middle;
}

std::vector<TetMesh::Corners> cone(const TetMesh& mesh, Tet t, Vertex apex) {
  std::vector<TetMesh::Corners> tets;
  for (int i = 0; i < 4; ++i) {
    const auto f = mesh.face_vertices(face_code(t, i));
    tets.push_back({f[0], f[1], f[2], apex});
  }
  return tets;
}

using Flags = std::vector<bool>;
using Ids = std::vector<int>;

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

// What std::invalid_argument says, or nothing where none is thrown.
std::string complaint(const Scene& scene, const Options& options) {
  try {
    static_cast<void>(scene.choose(options));
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return {};
}

TEST(Regions, BoxHasAnInside) {
  const Scene scene(small::box());
  EXPECT_EQ(scene.regions.count, 2u);
  for (const auto& sides : scene.regions.of_facet) EXPECT_EQ(sides, (std::array<RegionId, 2>{0, 1}));
  EXPECT_EQ(winding_numbers(scene.regions).number, (Ids{0, 1}));
}

TEST(Regions, FreeSlotsHaveNone) {
  Scene scene(small::box());
  for (Tet t = 0; t < scene.mesh.slot_count(); ++t)
    EXPECT_EQ(scene.regions.of_tet[t] == kNone, !scene.mesh.alive(t));
}

TEST(Regions, InsideOutBoxWindsBackwards) {
  Surface surface;
  small::add_box(surface, {0, 0, 0}, {1, 1, 1}, false);
  const Scene scene(surface);
  for (const auto& sides : scene.regions.of_facet) EXPECT_EQ(sides, (std::array<RegionId, 2>{1, 0}));
  EXPECT_EQ(winding_numbers(scene.regions).number, (Ids{0, -1}));
  EXPECT_EQ(scene.choose(Keep::winding).region, (Flags{false, true}));
}

TEST(Regions, NumberedByLeastFacet) {
  Surface surface = small::box({5, 5, 5}, {6, 6, 6});
  small::add_box(surface, {-6, -6, -6}, {-5, -5, -5});
  small::add_box(surface, {0, 0, 0}, {1, 1, 1}, false);
  const Scene scene(surface);
  EXPECT_EQ(scene.at({5.3, 5.6, 5.2}).region, 1u);
  EXPECT_EQ(scene.at({-5.3, -5.6, -5.2}).region, 2u);
  EXPECT_EQ(scene.at({0.3, 0.6, 0.2}).region, 3u);
  EXPECT_EQ(scene.at({3, 3, 3}).region, 0u);
}

TEST(Regions, FoundAgainAreTheSame) {
  for (const Surface& surface :
       {small::box(), small::nested(true), small::nested(false), small::touching()}) {
    Scene scene(surface);
    // Tetrahedra change within their regions.
    std::size_t changed = 0;
    for (Tet t = 0; t < scene.mesh.slot_count(); ++t) {
      if (!scene.mesh.alive(t) || scene.mesh.is_ghost(t)) continue;
      const Vertex p = MeshEditor(scene.mesh).add_vertex(middle_of(scene.mesh, t));
      const std::vector<TetMesh::Corners> fresh = cone(scene.mesh, t, p);
      MeshEditor(scene.mesh).replace({.old_tets = std::array{t}, .new_tets = fresh});
      if (++changed == 20) break;
    }
    Regions again = scene.regions;
    find_regions_again(scene.mesh, scene.surface.facets, again);
    const Regions afresh = find_regions(scene.mesh, scene.surface.facets);
    EXPECT_EQ(again.of_tet, afresh.of_tet);
    EXPECT_EQ(again.of_facet, afresh.of_facet);
    EXPECT_NE(again.of_tet, scene.regions.of_tet);
  }
}

TEST(Regions, RefusesFacesThatAreNoFacets) {
  const Scene scene(small::box());
  std::vector<Triangle> fewer(scene.surface.facets.begin(), scene.surface.facets.end() - 1);
  EXPECT_THROW(static_cast<void>(find_regions(scene.mesh, fewer)), std::logic_error);
  std::vector<Triangle> more = scene.surface.facets;
  more.push_back({0, 3, 5});
  EXPECT_THROW(static_cast<void>(find_regions(scene.mesh, more)), std::logic_error);
}

TEST(Keep, NestedShellsFacingOutwards) {
  const Scene scene(small::nested(true));
  EXPECT_EQ(winding_numbers(scene.regions).number, (Ids{0, 1, 2}));
  for (const Keep keep : {Keep::automatic, Keep::bounded, Keep::winding}) {
    const Kept kept = scene.choose(keep);
    EXPECT_EQ(kept.region, (Flags{false, true, true}));
    EXPECT_EQ(kept.id, (Ids{0, 1, 2}));
    EXPECT_TRUE(kept.defects.empty());
  }
}

TEST(Keep, OrientedCavityIsEmpty) {
  const Scene scene(small::nested(false));
  EXPECT_EQ(winding_numbers(scene.regions).number, (Ids{0, 1, 0}));
  for (const Keep keep : {Keep::automatic, Keep::winding}) {
    const Kept kept = scene.choose(keep);
    EXPECT_EQ(kept.region, (Flags{false, true, false}));
    EXPECT_EQ(kept.id, (Ids{0, 1, 0}));
    EXPECT_TRUE(kept.defects.empty());
  }
  EXPECT_EQ(scene.choose(Keep::bounded).region, (Flags{false, true, true}));
}

TEST(Keep, CavityWithoutOrientationIsFilled) {
  Surface surface = small::nested(false);
  std::swap(surface.facets[17][0], surface.facets[17][1]);
  const Scene scene(surface);
  EXPECT_TRUE(winding_numbers(scene.regions).conflict);
  const Kept kept = scene.choose(Keep::automatic);
  EXPECT_EQ(kept.region, (Flags{false, true, true}));
  EXPECT_TRUE(kept.defects.empty());
}

TEST(Keep, WindingNeedsOrientation) {
  Surface surface = small::nested(false);
  std::swap(surface.facets[17][0], surface.facets[17][1]);
  const Kept kept = Scene(surface).choose(Keep::winding);
  ASSERT_EQ(kept.defects.size(), 1u);
  EXPECT_EQ(kept.defects[0].kind, DefectKind::inconsistent_orientation);
  EXPECT_EQ(kept.defects[0].facets, (std::vector<Index>{12, 17}));
  EXPECT_TRUE(contains(kept.defects[0].message, "triangles 12 and 17")) << kept.defects[0].message;
}

TEST(Keep, BoxesThatShareAWall) {
  const Scene scene(small::touching());
  EXPECT_EQ(scene.regions.count, 3u);
  EXPECT_TRUE(winding_numbers(scene.regions).conflict);
  const Kept kept = scene.choose(Keep::automatic);
  EXPECT_EQ(kept.region, (Flags{false, true, true}));
  EXPECT_EQ(kept.id, (Ids{0, 1, 2}));
  EXPECT_TRUE(kept.defects.empty());
}

TEST(Keep, BoxKeepsTheOutsideAsZero) {
  const Kept kept = Scene(small::nested(false)).choose(Keep::box);
  EXPECT_EQ(kept.region, (Flags{true, true, true}));
  EXPECT_EQ(kept.id, (Ids{0, 1, 2}));
}

TEST(Keep, OpenSurfaceEnclosesNothing) {
  const Scene scene(small::open_box());
  EXPECT_EQ(scene.regions.count, 1u);
  for (const Keep keep : {Keep::automatic, Keep::bounded, Keep::winding}) {
    const Kept kept = scene.choose(keep);
    ASSERT_EQ(kept.defects.size(), 1u);
    EXPECT_EQ(kept.defects[0].kind, DefectKind::encloses_nothing);
    EXPECT_TRUE(contains(kept.defects[0].message, "1 open border, 4 edges at vertex 4 (0, 0, 1)"))
        << kept.defects[0].message;
    EXPECT_TRUE(contains(kept.defects[0].message, "enclosing box"));
    EXPECT_EQ(kept.defects[0].vertices.size(), 8u);
    EXPECT_EQ(kept.defects[0].where.size(), 8u);
  }
  EXPECT_TRUE(scene.choose(Keep::box).defects.empty());
}

TEST(Keep, NoTrianglesEncloseNothing) {
  Surface surface;
  small::add_segment(surface, {0, 0, 0}, {1, 0, 0});
  const Kept kept = Scene(surface).choose(Keep::automatic);
  ASSERT_EQ(kept.defects.size(), 1u);
  EXPECT_TRUE(contains(kept.defects[0].message, "no triangles")) << kept.defects[0].message;
}

TEST(Keep, DanglingFacetInsideIsIgnored) {
  Surface surface = small::box();
  small::add_triangle(surface, {0.3, 0.3, 0.4}, {0.7, 0.3, 0.5}, {0.4, 0.7, 0.6});
  const Scene scene(surface);
  EXPECT_EQ(scene.regions.count, 2u);
  EXPECT_EQ(scene.regions.of_facet.back(), (std::array<RegionId, 2>{1, 1}));
  EXPECT_EQ(winding_numbers(scene.regions).number, (Ids{0, 1}));
  const Kept kept = scene.choose(Keep::automatic);
  EXPECT_TRUE(kept.defects.empty());
  EXPECT_TRUE(kept.facet(scene.regions, 12));
}

TEST(Keep, PiecesOutsideAreDefects) {
  Surface surface = small::box();
  small::add_triangle(surface, {2, 0, 0}, {3, 0, 0}, {2, 1, 0});
  surface.vertices.push_back({2, 0, 1});
  surface.facets.push_back({8, 9, 11});  // hangs together with the first
  small::add_segment(surface, {0, 5, 0}, {0, 6, 0});
  surface.segments.push_back({9, 10});  // a side: no piece of its own
  surface.vertices.push_back({0, 0, 5});
  const Scene scene(surface);
  Options options;
  const Kept kept = scene.choose(options);
  ASSERT_EQ(kept.defects.size(), 3u);
  for (const Defect& defect : kept.defects) EXPECT_EQ(defect.kind, DefectKind::outside_region);
  EXPECT_EQ(kept.defects[0].facets, (std::vector<Index>{12, 13}));
  EXPECT_TRUE(contains(kept.defects[0].message, "triangles 12 and 13 at (2, 0, 0) border on no kept region"))
      << kept.defects[0].message;
  EXPECT_TRUE(contains(kept.defects[0].message, "4 open border edges")) << kept.defects[0].message;
  EXPECT_EQ(kept.defects[1].segments, (std::vector<Index>{0}));
  EXPECT_EQ(kept.defects[2].vertices, (std::vector<Index>{14}));
  options.drop_outside = true;
  const Kept dropped = scene.choose(options);
  EXPECT_TRUE(dropped.defects.empty());
  EXPECT_FALSE(dropped.facet(scene.regions, 12));
  EXPECT_TRUE(dropped.facet(scene.regions, 0));
  EXPECT_FALSE(dropped.segment[scene.table.find(12, 13)]);
  EXPECT_TRUE(scene.choose(Keep::box).defects.empty());
}

TEST(Keep, SegmentsAndVerticesInsideAreKept) {
  Surface surface = small::box();
  small::add_segment(surface, {0.2, 0.3, 0.4}, {0.7, 0.6, 0.5});
  surface.vertices.push_back({0.1, 0.8, 0.6});
  const Scene scene(surface);
  const Kept kept = scene.choose(Keep::automatic);
  EXPECT_TRUE(kept.defects.empty());
  EXPECT_TRUE(kept.segment[scene.table.find(8, 9)]);
}

TEST(Holes, EmptyTheirRegion) {
  const Scene scene(small::nested(true));
  Options options;
  options.holes = {{1.5, 1.5, 1.5}};
  const Kept kept = scene.choose(options);
  EXPECT_EQ(kept.region, (Flags{false, true, false}));
  EXPECT_TRUE(kept.defects.empty());
}

TEST(Holes, MayLeaveFacetsOutside) {
  const Scene scene(small::touching());
  Options options;
  options.holes = {{1.5, 0.25, 0.75}};
  const Kept kept = scene.choose(options);
  ASSERT_EQ(kept.defects.size(), 1u);
  EXPECT_EQ(kept.defects[0].facets, (std::vector<Index>{10, 11, 12, 13, 14, 15, 16, 17, 18, 19}));
}

TEST(Holes, MayNotTakeEverything) {
  const Scene scene(small::box());
  Options options;
  options.holes = {{0.5, 0.5, 0.5}};
  const Kept kept = scene.choose(options);
  ASSERT_EQ(kept.defects.size(), 1u);
  EXPECT_EQ(kept.defects[0].kind, DefectKind::encloses_nothing);
}

TEST(Holes, MustLieInsideARegion) {
  const Scene scene(small::nested(true));
  Options options;
  const auto with = [&](const Point& p) {
    options.holes = {p};
    return complaint(scene, options);
  };
  EXPECT_TRUE(contains(with({-1, 1, 1}), "no bounded region"));
  EXPECT_TRUE(contains(with({100, 1, 1}), "no bounded region"));  // beyond the box
  EXPECT_TRUE(contains(with({0, 0.7, 0.4}), "on the surface"));
  EXPECT_TRUE(contains(with({1.5, 1.5, 1}), "on the surface"));
  EXPECT_TRUE(contains(with({1, 1, 1}), "on the surface"));
  EXPECT_TRUE(contains(with({1, 1, 1.25}), "on the surface"));
  EXPECT_TRUE(contains(with({1, 1, 1.25}), "(1, 1, 1.25)"));
  EXPECT_EQ(with({std::nextafter(1.0, 0.0), 1.5, 1.5}), "");
  EXPECT_EQ(with({std::nextafter(1.0, 2.0), 1.5, 1.5}), "");
}

TEST(Holes, OneUlpDecides) {
  const Scene scene(small::nested(true));
  EXPECT_EQ(scene.at({std::nextafter(1.0, 0.0), 1.5, 1.5}).region, 1u);
  EXPECT_EQ(scene.at({std::nextafter(1.0, 2.0), 1.5, 1.5}).region, 2u);
  EXPECT_TRUE(scene.at({1, 1.5, 1.5}).on_facet);
}

TEST(Holes, MayTakeTheOutsideOfABox) {
  const Scene scene(small::box());
  Options options;
  options.keep = Keep::box;
  options.holes = {{5, 5, 5}};
  EXPECT_EQ(scene.choose(options).region, (Flags{false, true}));
  options.holes = {{50, 5, 5}};
  EXPECT_TRUE(contains(complaint(scene, options), "no bounded region"));
}

TEST(Holes, OnADanglingSegmentAreInItsRegion) {
  Surface surface = small::nested(true);
  small::add_segment(surface, {1.25, 1.5, 1.5}, {1.75, 1.5, 1.5});
  const Scene scene(surface);
  const Located located = scene.at({1.5, 1.5, 1.5});
  EXPECT_EQ(located.region, 2u);
  EXPECT_FALSE(located.on_facet);
}

TEST(Seeds, GiveIdsAndTheOthersAvoidThem) {
  Surface surface = small::box({5, 5, 5}, {6, 6, 6});
  small::add_box(surface, {-6, -6, -6}, {-5, -5, -5});
  small::add_box(surface, {0, 0, 0}, {1, 1, 1});
  small::add_box(surface, {3, 3, 3}, {4, 4, 4});
  const Scene scene(surface);
  Options options;
  options.regions = {{{0.5, 0.5, 0.5}, 2}, {{3.5, 3.5, 3.5}, -7}};
  EXPECT_EQ(scene.choose(options).id, (Ids{0, 1, 3, 2, -7}));
  options.regions = {{{0.5, 0.5, 0.5}, 1}, {{0.25, 0.5, 0.5}, 1}, {{5.5, 5.5, 5.5}, 1}};
  EXPECT_EQ(scene.choose(options).id, (Ids{0, 1, 2, 1, 3}));
}

TEST(Seeds, MustSuit) {
  const Scene scene(small::nested(false));
  Options options;
  options.regions = {{{0.5, 0.5, 0.5}, 1}, {{0.25, 0.5, 0.5}, 2}};
  EXPECT_TRUE(contains(complaint(scene, options), "id 2"));
  options.regions = {{{1.5, 1.5, 1.5}, 1}};
  EXPECT_TRUE(contains(complaint(scene, options), "not kept"));
  options.regions = {{{4, 1.5, 1.5}, 1}};
  EXPECT_TRUE(contains(complaint(scene, options), "no bounded region"));
  options.regions = {{{3, 1.5, 1.5}, 1}};
  EXPECT_TRUE(contains(complaint(scene, options), "on the surface"));
}

TEST(Seeds, AreInTheUnitsOfTheComplex) {
  const Scene scene(small::nested(true), -4);
  Options options;
  options.holes = {{1.5, 1.5, 1.5}};
  EXPECT_EQ(scene.choose(options, -4).region, (Flags{false, true, false}));
  // A coordinate that the scaled doubles do not hold.
  options.holes = {{1.5, 1.5, 1 + 0x1p-52}};
  EXPECT_EQ(scene.choose(options, -4).region, (Flags{false, true, false}));
}

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

  /// Lowers cells until neighbours differ by one at most, the outside included.
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

class RandomGrid : public testing::TestWithParam<unsigned> {};

TEST_P(RandomGrid, RegionsAreComponentsOfCells) {
  const Grid grid(GetParam(), 2 + static_cast<int>(GetParam() % 3));
  const Scene scene(grid.surface);
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
  const Scene scene(grid.surface);
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
  // Demands number(b) = number(a) + step; false if that contradicts what was demanded before.
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
  const Scene scene(grid.surface);
  Offsets offsets(scene.regions.count);
  bool consistent = true;
  for (const auto& [front, back] : scene.regions.of_facet)
    if (front != back) consistent = offsets.demand(front, back, 1) && consistent;
  EXPECT_EQ(winding_numbers(scene.regions).conflict.has_value(), !consistent);
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomGrid, testing::Range(1u, 13u));

}  // namespace
}  // namespace holdfast
