// check(): good meshes pass; a mesh that breaks a rule fails it.
#include "holdfast/check.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "unit/check_cases.h"

namespace holdfast::check_cases::check_test {
namespace {

// ---- Good meshes

TEST(GoodMesh, OneTetrahedronHolds) {
  const Case c = one_tetrahedron();
  EXPECT_EQ(broken(c), Names{});
  EXPECT_EQ(c.checked().rules.size(), 13U);
  EXPECT_TRUE(c.checked().holds());
}

TEST(GoodMesh, GridWithIsolatedPointHolds) {
  const Case c = grid({2, 2, 2});  // the middle vertex is on no facet
  EXPECT_EQ(broken(c), Names{});
  EXPECT_EQ(detail(c, "regions numbered"), "1 region, 1 different id");
}

TEST(GoodMesh, SteinerPointInsideHolds) {
  const Case c = with_steiner();
  EXPECT_EQ(broken(c), Names{});
  EXPECT_EQ(detail(c, "Steiner points inside regions"), "1 Steiner points");
}

TEST(GoodMesh, RegionsHold) {
  Case c = grid({3, 1, 1}, [](int x, int, int) { return x + 1; });
  EXPECT_EQ(broken(c), Names{});
  EXPECT_EQ(detail(c, "regions numbered"), "3 regions, 3 different ids");
  std::ranges::replace(c.volume.regions, 3, 1);  // two regions with one id, as a user may ask for
  EXPECT_EQ(broken(c), Names{});
  EXPECT_EQ(detail(c, "regions numbered"), "3 regions, 2 different ids");
}

TEST(GoodMesh, DanglingFacetAndSegmentHold) {
  Case c = grid({2, 2, 2});
  const Tetrahedron& t = c.volume.tetrahedra[0];
  c.surface.facets.push_back({t[3], t[0], t[1]});
  c.surface.segments.push_back({vertex_at(c.volume, {1, 1, 1}), vertex_at(c.volume, {2, 1, 1})});
  c.surface.segments.push_back({c.surface.facets[0][0], c.surface.facets[0][1]});  // a facet's side
  EXPECT_EQ(broken(c), Names{});
}

TEST(GoodMesh, NestedShellsHold) {
  const Case c = grid({5, 5, 5}, [](int x, int y, int z) { return 1 + depth(x, y, z, 5); });
  EXPECT_EQ(broken(c), Names{});
  EXPECT_EQ(detail(c, "nothing dropped"), "no input facet or segment is outside");
}

TEST(GoodMesh, EnclosedVoidsHoldAndAreReported) {
  const auto hollow = [](int x, int y, int z) { return (x == 1 || x == 3) && y == 1 && z == 1 ? 0 : 1; };
  const Case c = grid({5, 3, 3}, hollow);
  EXPECT_EQ(broken(c), Names{});
  EXPECT_TRUE(contains(detail(c, "nothing dropped"), "; 2 enclosed regions are left empty"));
}

TEST(GoodMesh, VoidWithAnIslandIsOneVoid) {
  const Case c = grid({5, 5, 5}, [](int x, int y, int z) { return depth(x, y, z, 5) == 1 ? 0 : 1; });
  EXPECT_EQ(broken(c), Names{});
  EXPECT_TRUE(contains(detail(c, "nothing dropped"), "; 1 enclosed regions are left empty"));
}

TEST(GoodMesh, CheckerboardHolds) {
  // Every inner side belongs to two blocks, and no two blocks share a face.
  const Case c = grid({4, 4, 4}, [](int x, int y, int z) { return (x + y + z) % 2; });
  EXPECT_EQ(broken(c), Names{});
  EXPECT_EQ(detail(c, "regions numbered"), "32 regions, 1 different id");
  // The empty cells that are closed on all sides are half of the inner 2x2x2.
  EXPECT_TRUE(contains(detail(c, "nothing dropped"), "; 4 enclosed regions are left empty"));
}

TEST(GoodMesh, BlocksThatTouchInOneEdgeOrVertexHold) {
  const Case edge = grid({2, 2, 1}, [](int x, int y, int) { return x == y ? 1 : 0; });
  EXPECT_EQ(broken(edge), Names{});
  const Case vertex = grid({2, 2, 2}, [](int x, int y, int z) { return x == y && y == z ? 1 : 0; });
  EXPECT_EQ(broken(vertex), Names{});
  EXPECT_EQ(detail(vertex, "nothing dropped"), "no input facet or segment is outside");
}

TEST(GoodMesh, BoxHoldsOnlyWhenAllowed) {
  Case c = in_box();
  ASSERT_EQ(c.surface.facets.size(), 12U);
  EXPECT_EQ(broken(c), (Names{"boundary is input"}));
  c.options.box = true;
  EXPECT_EQ(broken(c), Names{});
  EXPECT_EQ(detail(c, "regions numbered"), "2 regions, 2 different ids");
  EXPECT_EQ(detail(c, "boundary is input"), "0 boundary faces are input facets, 108 in the sides of the box");
  drop_tetrahedron(c.volume, 0);
  EXPECT_EQ(broken(c), (Names{"boundary is input"})) << "a piece of the box is missing";
}

// As in OpenFOAM's format, which has a patch for each face of the boundary.
TEST(GoodMesh, FacesOfTheBoxMayBeListed) {
  Case c = in_box();
  std::map<Triangle, int> tetrahedra_at;
  for (const Tetrahedron& t : c.volume.tetrahedra)
    for (std::size_t k = 0; k < 4; ++k) {
      Triangle face{t[(k + 1) % 4], t[(k + 2) % 4], t[(k + 3) % 4]};
      std::sort(face.begin(), face.end());
      ++tetrahedra_at[face];
    }
  for (const auto& [face, count] : tetrahedra_at)
    if (count == 1) c.volume.facets.push_back({face[1], face[0], face[2]});
  c.volume.facet_markers.assign(c.volume.facets.size(), 0);
  c.options.box = true;
  EXPECT_EQ(broken(c), Names{});
  const auto inside = std::find_if(tetrahedra_at.begin(), tetrahedra_at.end(),
                                   [](const auto& face) { return face.second == 2; });
  c.volume.facets.push_back(inside->first);
  c.volume.facet_markers.push_back(0);
  EXPECT_EQ(broken(c), (Names{"markers kept"}));
}

TEST(GoodMesh, BoxMayHaveSteinerPointsOnItsSides) {
  Case c = in_box();
  for (int i = 0; i < 8; ++i)  // input vertices first
    exchange(c.volume, vertex_at(c.volume, {1.0 + i % 2, 1.0 + i / 2 % 2, 1.0 + i / 4}),
             static_cast<Index>(i));
  c.surface = boundary_of(c.volume);
  std::erase_if(c.surface.facets,
                [](const Triangle& facet) { return *std::ranges::max_element(facet) >= 8; });
  c.surface.vertices.resize(8);
  c.options.box = true;
  EXPECT_EQ(broken(c), Names{});
  EXPECT_EQ(detail(c, "Steiner points inside regions"), "56 Steiner points, 56 of them on the box");
  c.options.box = false;
  EXPECT_EQ(broken(c), (Names{"boundary is input", "Steiner points inside regions"}));
}

TEST(GoodMesh, ExtremeCoordinatesHold) {
  for (const double scale : {0x1p-1060, 0x1p-400, 0x1p400, 0x1p1020}) {
    Case c = with_steiner();
    for (auto* vertices : {&c.volume.vertices, &c.surface.vertices})
      for (Point& p : *vertices)
        for (double& x : p) x *= scale;
    EXPECT_EQ(broken(c), Names{}) << scale;
  }
}

// ---- Vertices and form

TEST(Vertices, ChangeByOneUlpIsTold) {
  Case c = grid({2, 1, 1});
  double& x = c.volume.vertices[3][0];
  x = std::nextafter(x, 10);
  EXPECT_EQ(broken(c), (Names{"input vertices kept"}));
  EXPECT_TRUE(
      contains(detail(c, "input vertices kept"), "1 input vertices changed or missing: input vertex 3 ("));
}

TEST(Vertices, SignOfZeroIsTold) {
  Case c = one_tetrahedron();
  c.volume.vertices[1][1] = -0.0;
  EXPECT_EQ(broken(c), (Names{"input vertices kept"}));
}

TEST(Vertices, PermutationIsTold) {
  Case c = grid({2, 1, 1});
  exchange(c.volume, 2, 5);
  EXPECT_TRUE(broken(c).contains("input vertices kept"));
  EXPECT_TRUE(broken(c).contains("facets kept"));
}

TEST(Vertices, MissingIsTold) {
  Case c = one_tetrahedron();
  c.surface.vertices.push_back({5, 5, 5});
  EXPECT_EQ(broken(c), (Names{"input vertices kept"}));
  EXPECT_EQ(detail(c, "input vertices kept"),
            "1 input vertices changed or missing: input vertex 4 (5, 5, 5) is missing");
}

TEST(Vertices, UnusedIsTold) {
  Case steiner = one_tetrahedron();
  steiner.volume.vertices.push_back({0.125, 0.125, 0.125});
  EXPECT_EQ(broken(steiner), (Names{"no vertex unused"}));
  Case isolated = steiner;
  isolated.surface.vertices = isolated.volume.vertices;
  EXPECT_EQ(broken(isolated), (Names{"no vertex unused"}));
  isolated.options.outside_dropped = true;
  EXPECT_EQ(broken(isolated), (Names{"no vertex unused"})) << "it is not outside";
}

TEST(Vertices, UnusedIsAcceptedOutsideOnlyAndWhenDropped) {
  const auto with_point = [](const Point& point) {
    Case c = one_tetrahedron();
    c.volume.vertices.push_back(point);
    c.surface.vertices.push_back(point);
    return c;
  };
  const std::vector<Point> outside{{2, 2, 2}, {-1, 0, 0}, {0.25, -1, 0.25}, {2, 0, 0}, {0.5, 0.5, 0.5}};
  for (const Point& point : outside) {
    Case c = with_point(point);
    EXPECT_EQ(broken(c), (Names{"no vertex unused"}));
    c.options.outside_dropped = true;
    EXPECT_EQ(broken(c), Names{});
  }
  const std::vector<Point> touching{{0.25, 0.25, 0.25}, {0.25, 0.25, 0}, {0, 0, 0.5}, {0.25, 0.25, 0.5}};
  for (const Point& point : touching) {
    Case c = with_point(point);
    c.options.outside_dropped = true;
    EXPECT_EQ(broken(c), (Names{"no vertex unused"}));
  }
}

TEST(Form, GarbageIsToldAndNeverFollowed) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  constexpr double inf = std::numeric_limits<double>::infinity();
  constexpr Index huge = std::numeric_limits<Index>::max();
  const std::vector<std::function<void(Case&)>> spoils{
      [](Case& c) { c.volume.tetrahedra[0][2] = 4; },
      [](Case& c) { c.volume.tetrahedra[0][2] = huge; },
      [](Case& c) { c.volume.tetrahedra[0][2] = 1; },
      [](Case& c) { drop_tetrahedron(c.volume, 0); },
      [](Case& c) { c.volume = {}; },
      [](Case& c) { c.volume.vertices[2][1] = nan; },
      [](Case& c) {
        c.volume.vertices.push_back({0, inf, 0});
      },
      [](Case& c) { c.surface.vertices[3][2] = -inf; },
      [](Case& c) { c.surface.facets[3][0] = 77; },
      [](Case& c) {
        c.surface.segments.push_back({0, huge});
      },
  };
  for (std::size_t i = 0; i < spoils.size(); ++i) {
    Case c = one_tetrahedron();
    c.surface.facet_markers.assign(4, 7);
    c.volume.facets = c.surface.facets;
    c.volume.facet_markers = c.surface.facet_markers;
    spoils[i](c);
    EXPECT_TRUE(broken(c).contains("well formed")) << i;
    EXPECT_TRUE(contains(detail(c, "no overlap"), "not examined")) << i;
  }
}

TEST(Form, DegenerateInputEntitiesAreLost) {
  Case c = one_tetrahedron();
  c.surface.facets.push_back({1, 1, 2});
  c.surface.segments.push_back({3, 3});
  c.options.outside_dropped = true;
  EXPECT_EQ(broken(c), (Names{"facets kept", "segments kept"}));
}

TEST(Form, EmptyIsNotAMesh) {
  EXPECT_TRUE(broken(check({}, {})).contains("well formed"));
  CheckOptions allowing_all;
  allowing_all.outside_dropped = allowing_all.box = true;
  EXPECT_FALSE(check({}, {}, allowing_all).holds());
}

// ---- Tetrahedra

TEST(Volumes, NegativeIsTold) {
  Case c = grid({2, 1, 1});
  std::swap(c.volume.tetrahedra[4][0], c.volume.tetrahedra[4][1]);
  EXPECT_EQ(broken(c), (Names{"volumes positive", "no overlap"}));
  EXPECT_EQ(detail(c, "no overlap"), "not examined: some tetrahedra are not positive");
  EXPECT_TRUE(contains(detail(c, "volumes positive"), "1 tetrahedra are not positive: tetrahedron 4 ("));
}

TEST(Volumes, ZeroIsTold) {
  Case c = with_steiner();
  c.volume.vertices.back() = {1, 1, 0};
  EXPECT_TRUE(broken(c).contains("volumes positive"));
  EXPECT_TRUE(broken(c).contains("Steiner points inside regions"));
}

TEST(Volumes, TinyPositiveVolumeIsPositive) {
  Volume volume = one_tetrahedron().volume;
  volume.vertices = {{1, 1, 1}, {2, 1, 1}, {1, 2, 1}, {1.5, 1.5, std::nextafter(1.0, 2.0)}};
  EXPECT_EQ(broken(filled(volume)), Names{});
  volume.vertices[3][2] = 1;
  EXPECT_TRUE(broken(filled(volume)).contains("volumes positive"));
}

TEST(Faces, DuplicateTetrahedronIsTold) {
  Case inside = grid({2, 2, 2});
  inside.volume.tetrahedra.push_back(inside.volume.tetrahedra[7]);
  inside.volume.regions.push_back(1);
  EXPECT_TRUE(broken(inside).contains("faces matched"));
  Case alone = one_tetrahedron();
  alone.volume.tetrahedra.push_back({1, 2, 0, 3});
  alone.volume.regions.push_back(1);
  EXPECT_TRUE(broken(alone).contains("faces matched"));
  EXPECT_TRUE(contains(detail(alone, "faces matched"), "4 faces with both tetrahedra on one side"));
}

TEST(Faces, ThreeTetrahedraAtOneFaceAreTold) {
  Volume volume = one_tetrahedron().volume;
  volume.vertices.push_back({1, 1, 1});
  volume.vertices.push_back({2, 2, 2});
  volume.tetrahedra.push_back({1, 2, 3, 4});
  volume.tetrahedra.push_back({1, 2, 3, 5});
  volume.regions.assign(3, 1);
  Case c = filled(std::move(volume));
  c.surface.facets.push_back({1, 2, 3});
  EXPECT_EQ(broken(c), (Names{"faces matched", "no overlap"}));
  EXPECT_TRUE(contains(detail(c, "faces matched"), "1 faces of more than two tetrahedra: face (1, 2, 3)"));
}

TEST(Faces, TwoTetrahedraOnOneSideAreTold) {
  Volume volume = one_tetrahedron().volume;
  volume.vertices.push_back({0.25, 0.25, 2});
  volume.tetrahedra.push_back({0, 1, 2, 4});
  volume.regions.push_back(1);
  EXPECT_EQ(broken(filled(std::move(volume))), (Names{"faces matched", "no overlap"}));
}

TEST(Faces, MissingTetrahedronIsTold) {
  const Case whole = with_steiner();
  for (std::size_t i = 0; i < whole.volume.tetrahedra.size(); ++i) {
    Case c = whole;
    const bool at_steiner = std::ranges::max(c.volume.tetrahedra[i]) == c.surface.vertices.size();
    drop_tetrahedron(c.volume, i);
    EXPECT_TRUE(broken(c).contains("boundary is input")) << i;
    EXPECT_EQ(broken(c).contains("Steiner points inside regions"), at_steiner) << i;
  }
}

// ---- Overlap

TEST(Overlap, BlocksThatCrossAreTold) {
  Volume volume = grid({2, 2, 2}).volume;
  append_grid(volume, {2, 2, 2}, {0.5, 0.25, 0.125});
  const Case c = filled(std::move(volume));
  EXPECT_EQ(broken(c), (Names{"no overlap"}));
  EXPECT_TRUE(contains(detail(c, "no overlap"), "pairs of boundary faces intersect"));
}

TEST(Overlap, BlockInsideAnotherIsTold) {
  Volume volume = grid({3, 3, 3}).volume;
  append_grid(volume, {1, 1, 1}, {1.25, 0.5, 0.75});
  const Case c = filled(std::move(volume));
  EXPECT_EQ(broken(c), (Names{"no overlap"}));
  EXPECT_TRUE(contains(detail(c, "no overlap"), "there are 2 tetrahedra"));
}

TEST(Overlap, BlockInsideAVoidHolds) {
  Volume volume = grid({5, 5, 5}, [](int x, int y, int z) { return depth(x, y, z, 5) > 0 ? 0 : 1; }).volume;
  append_grid(volume, {1, 1, 1}, {1.25, 2.5, 1.75});
  EXPECT_EQ(broken(filled(std::move(volume))), Names{});
}

TEST(Overlap, BlocksThatTouchWithoutSharingFacesAreTold) {
  Volume volume = grid({1, 1, 1}).volume;
  append_grid(volume, {1, 1, 1}, {1, 0, 0});
  const Names names = broken(filled(std::move(volume)));
  EXPECT_TRUE(names.contains("no overlap"));
  EXPECT_TRUE(names.contains("input vertices kept")) << "each place is asked for once";
}

TEST(Overlap, OneVertexWithTwoIndicesIsTold) {
  Volume volume = grid({1, 1, 1}).volume;
  append_grid(volume, {1, 1, 1}, {1, 1, 1});
  const Names names = broken(filled(std::move(volume)));
  EXPECT_TRUE(names.contains("no overlap"));
  EXPECT_TRUE(names.contains("input vertices kept")) << "each place is asked for once";
}

TEST(Overlap, TwoTurnsAboutAnEdgeAreTold) {
  // A fan of tetrahedra that closes after two turns: every face is matched and all are positive.
  Volume volume;
  constexpr int corners = 12;
  volume.vertices = {{0, 0, -1}, {0, 0, 1}};
  for (int i = 0; i < corners; ++i) {
    const double angle = 4 * M_PI * i / corners;
    const double radius = 1 + 0.1 * i;
    volume.vertices.push_back({radius * std::cos(angle), radius * std::sin(angle), 0.3 * i});
    volume.tetrahedra.push_back({0, 1, static_cast<Index>(2 + i), static_cast<Index>(2 + (i + 1) % corners)});
  }
  volume.regions.assign(corners, 1);
  const Case c = filled(std::move(volume));
  ASSERT_EQ(c.surface.facets.size(), 2U * corners);
  EXPECT_EQ(broken(c), (Names{"no overlap"}));
}

}  // namespace
}  // namespace holdfast::check_cases::check_test
