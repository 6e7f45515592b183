// Regions, winding numbers, keep rules, holes and seeds (docs/concepts.md).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "unit/classified.h"

namespace holdfast::classify_test {
namespace {

using testing::Classified;

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

// The message of std::invalid_argument, or empty if none is thrown.
std::string complaint(const Classified& scene, const Options& options) {
  try {
    static_cast<void>(scene.choose(options));
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return {};
}

TEST(Regions, BoxHasAnInside) {
  const Classified scene(small::box());
  EXPECT_EQ(scene.regions.count, 2u);
  for (const auto& sides : scene.regions.of_facet) EXPECT_EQ(sides, (std::array<RegionId, 2>{0, 1}));
  EXPECT_EQ(winding_numbers(scene.regions).number, (Ids{0, 1}));
}

TEST(Regions, FreeSlotsHaveNone) {
  Classified scene(small::box());
  for (Tet t = 0; t < scene.mesh.slot_count(); ++t)
    EXPECT_EQ(scene.regions.of_tet[t] == kNone, !scene.mesh.alive(t));
}

TEST(Regions, InsideOutBoxWindsBackwards) {
  Surface surface;
  small::add_box(surface, {0, 0, 0}, {1, 1, 1}, false);
  const Classified scene(surface);
  for (const auto& sides : scene.regions.of_facet) EXPECT_EQ(sides, (std::array<RegionId, 2>{1, 0}));
  EXPECT_EQ(winding_numbers(scene.regions).number, (Ids{0, -1}));
  EXPECT_EQ(scene.choose(Keep::winding).region, (Flags{false, true}));
}

TEST(Regions, NumberedByLeastFacet) {
  Surface surface = small::box({5, 5, 5}, {6, 6, 6});
  small::add_box(surface, {-6, -6, -6}, {-5, -5, -5});
  small::add_box(surface, {0, 0, 0}, {1, 1, 1}, false);
  const Classified scene(surface);
  EXPECT_EQ(scene.at({5.3, 5.6, 5.2}).region, 1u);
  EXPECT_EQ(scene.at({-5.3, -5.6, -5.2}).region, 2u);
  EXPECT_EQ(scene.at({0.3, 0.6, 0.2}).region, 3u);
  EXPECT_EQ(scene.at({3, 3, 3}).region, 0u);
}

TEST(Regions, FoundAgainAreTheSame) {
  for (const Surface& surface :
       {small::box(), small::nested(true), small::nested(false), small::touching()}) {
    Classified scene(surface);
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
  const Classified scene(small::box());
  std::vector<Triangle> fewer(scene.surface.facets.begin(), scene.surface.facets.end() - 1);
  EXPECT_THROW(static_cast<void>(find_regions(scene.mesh, fewer)), std::logic_error);
  std::vector<Triangle> more = scene.surface.facets;
  more.push_back({0, 3, 5});
  EXPECT_THROW(static_cast<void>(find_regions(scene.mesh, more)), std::logic_error);
}

TEST(Keep, NestedShellsFacingOutwards) {
  const Classified scene(small::nested(true));
  EXPECT_EQ(winding_numbers(scene.regions).number, (Ids{0, 1, 2}));
  for (const Keep keep : {Keep::automatic, Keep::bounded, Keep::winding}) {
    const Kept kept = scene.choose(keep);
    EXPECT_EQ(kept.region, (Flags{false, true, true}));
    EXPECT_EQ(kept.id, (Ids{0, 1, 2}));
    EXPECT_TRUE(kept.defects.empty());
  }
}

TEST(Keep, OrientedCavityIsEmpty) {
  const Classified scene(small::nested(false));
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
  const Classified scene(surface);
  EXPECT_TRUE(winding_numbers(scene.regions).conflict);
  const Kept kept = scene.choose(Keep::automatic);
  EXPECT_EQ(kept.region, (Flags{false, true, true}));
  EXPECT_TRUE(kept.defects.empty());
}

TEST(Keep, WindingNeedsOrientation) {
  Surface surface = small::nested(false);
  std::swap(surface.facets[17][0], surface.facets[17][1]);
  const Kept kept = Classified(surface).choose(Keep::winding);
  ASSERT_EQ(kept.defects.size(), 1u);
  EXPECT_EQ(kept.defects[0].kind, DefectKind::inconsistent_orientation);
  EXPECT_EQ(kept.defects[0].facets, (std::vector<Index>{12, 17}));
  EXPECT_TRUE(contains(kept.defects[0].message, "triangles 12 and 17")) << kept.defects[0].message;
}

TEST(Keep, BoxesThatShareAWall) {
  const Classified scene(small::touching());
  EXPECT_EQ(scene.regions.count, 3u);
  EXPECT_TRUE(winding_numbers(scene.regions).conflict);
  const Kept kept = scene.choose(Keep::automatic);
  EXPECT_EQ(kept.region, (Flags{false, true, true}));
  EXPECT_EQ(kept.id, (Ids{0, 1, 2}));
  EXPECT_TRUE(kept.defects.empty());
}

TEST(Keep, BoxKeepsTheOutsideAsZero) {
  const Kept kept = Classified(small::nested(false)).choose(Keep::box);
  EXPECT_EQ(kept.region, (Flags{true, true, true}));
  EXPECT_EQ(kept.id, (Ids{0, 1, 2}));
}

TEST(Keep, OpenSurfaceEnclosesNothing) {
  const Classified scene(small::open_box());
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
  const Kept kept = Classified(surface).choose(Keep::automatic);
  ASSERT_EQ(kept.defects.size(), 1u);
  EXPECT_TRUE(contains(kept.defects[0].message, "no triangles")) << kept.defects[0].message;
}

TEST(Keep, DanglingFacetInsideIsIgnored) {
  Surface surface = small::box();
  small::add_triangle(surface, {0.3, 0.3, 0.4}, {0.7, 0.3, 0.5}, {0.4, 0.7, 0.6});
  const Classified scene(surface);
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
  surface.facets.push_back({8, 9, 11});  // connected with the first
  small::add_segment(surface, {0, 5, 0}, {0, 6, 0});
  surface.segments.push_back({9, 10});  // a side, not a separate piece
  surface.vertices.push_back({0, 0, 5});
  const Classified scene(surface);
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
  const Classified scene(surface);
  const Kept kept = scene.choose(Keep::automatic);
  EXPECT_TRUE(kept.defects.empty());
  EXPECT_TRUE(kept.segment[scene.table.find(8, 9)]);
}

TEST(Holes, EmptyTheirRegion) {
  const Classified scene(small::nested(true));
  Options options;
  options.holes = {{1.5, 1.5, 1.5}};
  const Kept kept = scene.choose(options);
  EXPECT_EQ(kept.region, (Flags{false, true, false}));
  EXPECT_TRUE(kept.defects.empty());
}

TEST(Holes, MayLeaveFacetsOutside) {
  const Classified scene(small::touching());
  Options options;
  options.holes = {{1.5, 0.25, 0.75}};
  const Kept kept = scene.choose(options);
  ASSERT_EQ(kept.defects.size(), 1u);
  EXPECT_EQ(kept.defects[0].facets, (std::vector<Index>{10, 11, 12, 13, 14, 15, 16, 17, 18, 19}));
}

TEST(Holes, MayNotTakeEverything) {
  const Classified scene(small::box());
  Options options;
  options.holes = {{0.5, 0.5, 0.5}};
  const Kept kept = scene.choose(options);
  ASSERT_EQ(kept.defects.size(), 1u);
  EXPECT_EQ(kept.defects[0].kind, DefectKind::encloses_nothing);
}

TEST(Holes, MustLieInsideARegion) {
  const Classified scene(small::nested(true));
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
  const Classified scene(small::nested(true));
  EXPECT_EQ(scene.at({std::nextafter(1.0, 0.0), 1.5, 1.5}).region, 1u);
  EXPECT_EQ(scene.at({std::nextafter(1.0, 2.0), 1.5, 1.5}).region, 2u);
  EXPECT_TRUE(scene.at({1, 1.5, 1.5}).on_facet);
}

TEST(Holes, MayTakeTheOutsideOfABox) {
  const Classified scene(small::box());
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
  const Classified scene(surface);
  const Located located = scene.at({1.5, 1.5, 1.5});
  EXPECT_EQ(located.region, 2u);
  EXPECT_FALSE(located.on_facet);
}

TEST(Seeds, GiveIdsAndTheOthersAvoidThem) {
  Surface surface = small::box({5, 5, 5}, {6, 6, 6});
  small::add_box(surface, {-6, -6, -6}, {-5, -5, -5});
  small::add_box(surface, {0, 0, 0}, {1, 1, 1});
  small::add_box(surface, {3, 3, 3}, {4, 4, 4});
  const Classified scene(surface);
  Options options;
  options.regions = {{{0.5, 0.5, 0.5}, 2}, {{3.5, 3.5, 3.5}, -7}};
  EXPECT_EQ(scene.choose(options).id, (Ids{0, 1, 3, 2, -7}));
  options.regions = {{{0.5, 0.5, 0.5}, 1}, {{0.25, 0.5, 0.5}, 1}, {{5.5, 5.5, 5.5}, 1}};
  EXPECT_EQ(scene.choose(options).id, (Ids{0, 1, 2, 1, 3}));
}

TEST(Seeds, MustSuit) {
  const Classified scene(small::nested(false));
  Options options;
  options.regions = {{{0.5, 0.5, 0.5}, 1}, {{0.25, 0.5, 0.5}, 2}};
  EXPECT_TRUE(contains(complaint(scene, options), "id 2"));
  options.regions = {{{1.5, 1.5, 1.5}, 1}};
  options.keep = Keep::winding;
  EXPECT_TRUE(contains(complaint(scene, options), "not kept"));
  options.keep = Keep::automatic;
  options.regions = {{{4, 1.5, 1.5}, 1}};
  EXPECT_TRUE(contains(complaint(scene, options), "no bounded region"));
  options.regions = {{{3, 1.5, 1.5}, 1}};
  EXPECT_TRUE(contains(complaint(scene, options), "on the surface"));
}

TEST(Seeds, KeepTheirRegionsWhateverTheWindingNumber) {
  const Classified scene(small::nested(false));
  Options options;
  EXPECT_EQ(scene.choose(options).region, (Flags{false, true, false}));
  options.regions = {{{1.5, 1.5, 1.5}, 5}};
  const Kept kept = scene.choose(options);
  EXPECT_EQ(kept.region, (Flags{false, true, true}));
  EXPECT_EQ(kept.id, (Ids{0, 1, 5}));
  EXPECT_EQ(kept.rule, Keep::winding);
}

TEST(Seeds, AreInTheUnitsOfTheComplex) {
  const Classified scene(small::nested(true), -4);
  Options options;
  options.holes = {{1.5, 1.5, 1.5}};
  EXPECT_EQ(scene.choose(options, -4).region, (Flags{false, true, false}));
  // A coordinate that the scaled doubles do not hold.
  options.holes = {{1.5, 1.5, 1 + 0x1p-52}};
  EXPECT_EQ(scene.choose(options, -4).region, (Flags{false, true, false}));
}

}  // namespace
}  // namespace holdfast::classify_test
