// Partition and elimination: every constraint stands, covered exactly; nothing else is on it; volume stays.
#include "enforce/enforce.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numeric>
#include <random>

#include "enforce/collapse_within.h"
#include "enforce/cut_and_cone.h"
#include "enforce/facet_section.h"
#include "enforce/fictitious_cut.h"
#include "enforce/partition_facet.h"
#include "enforce/partition_segment.h"
#include "hard_surfaces.h"
#include "mesh/assembly.h"
#include "mesh/validate.h"
#include "mesh_fixtures.h"

namespace holdfast {
namespace {

using namespace testing;
using exact::Dyadic;
using Random = std::mt19937_64;
using Ends = std::array<Vertex, 2>;

// A complex, and the Delaunay mesh of its vertices, a box's and some Steiner points.
struct Task {
  Surface surface;
  TetMesh mesh;
  SegmentTable table;
  Standing standing;
  Vertex first_free = 0;
  Dyadic volume;
};

Task task(const Surface& surface, const std::vector<Point>& steiner = {}) {
  Task t;
  t.surface = surface;
  double reach = 0;
  for (const Point& p : surface.vertices) {
    MeshEditor(t.mesh).add_vertex(p);
    for (const double x : p) reach = std::max(reach, 2 * std::abs(x));
  }
  for (unsigned k = 0; k < 8; ++k)
    MeshEditor(t.mesh).add_vertex(Point{(k & 1u) != 0 ? reach : -reach, (k & 2u) != 0 ? reach : -reach,
                                        (k & 4u) != 0 ? reach : -reach});
  t.first_free = static_cast<Vertex>(t.mesh.vertex_count());
  for (const Point& p : steiner) MeshEditor(t.mesh).add_vertex(p);
  EXPECT_TRUE(build_delaunay(t.mesh, {}, nullptr));
  t.table = segment_table(surface.view());
  t.standing = mark_present(t.mesh, t.table);
  t.volume = volume_of(t.mesh);
  return t;
}

EnforceStats run(Task& t, const EnforceOptions& how) {
  const Options options;
  Monitor monitor(options);
  return enforce(t.mesh, t.table, t.surface.facets, t.standing, t.first_free, how, monitor);
}

// --- what lies where, exactly

bool on_line(const TetMesh& mesh, Vertex a, Vertex b, Vertex v) {
  for (int axis = 0; axis < 3; ++axis)
    if (exact::orient2d(mesh.point(a), mesh.point(b), mesh.point(v), axis) != 0) return false;
  return true;
}

// Orders the points of the line ab from a to b.
bool before(const TetMesh& mesh, Vertex a, Vertex b, Vertex v, Vertex w) {
  const auto pa = mesh.exact_position(a), pb = mesh.exact_position(b);
  const auto pv = mesh.exact_position(v), pw = mesh.exact_position(w);
  for (std::size_t k = 0; k < 3; ++k)
    if (pa.c[k] != pb.c[k]) return pa.c[k] < pb.c[k] ? pv.c[k] < pw.c[k] : pw.c[k] < pv.c[k];
  return false;
}

// All vertices of the mesh on the closed segment ab, from a to b.
std::vector<Vertex> vertices_on(const TetMesh& mesh, Vertex a, Vertex b) {
  std::vector<Vertex> out;
  for (Vertex v = 0; v < mesh.vertex_count(); ++v)
    if (mesh.in_mesh(v) && on_line(mesh, a, b, v) && !before(mesh, a, b, v, a) && !before(mesh, a, b, b, v))
      out.push_back(v);
  std::sort(out.begin(), out.end(), [&](Vertex v, Vertex w) { return before(mesh, a, b, v, w); });
  return out;
}

// A facet, turned so that `above` sees it positively.
struct Plane {
  Triangle corners{};
  Vertex above = 0;

  Plane(const Task& t, const Triangle& f) : corners(f), above(t.first_free - 8) {
    while (t.mesh.orient(f[0], f[1], f[2], above) == 0) ++above;
    if (t.mesh.orient(f[0], f[1], f[2], above) < 0) std::swap(corners[1], corners[2]);
  }
  [[nodiscard]] bool holds(const TetMesh& mesh, Vertex v) const {
    const auto [a, b, c] = corners;
    return mesh.orient(a, b, c, v) == 0 && mesh.orient(a, b, v, above) >= 0 &&
           mesh.orient(b, c, v, above) >= 0 && mesh.orient(c, a, v, above) >= 0;
  }
  [[nodiscard]] bool holds(const TetMesh& mesh, const FaceKey& f) const {
    return holds(mesh, f[0]) && holds(mesh, f[1]) && holds(mesh, f[2]);
  }
};

// Faces of a mesh do not overlap, so that they cover a facet where they lie in it and their areas add up to
// its own; volumes under one apex stand for areas.
std::size_t expect_covered(const Task& t, const Triangle& facet, const std::set<FaceKey>& faces) {
  const Plane plane(t, facet);
  std::vector<TetMesh::Corners> pieces;
  for (const FaceKey& f : faces) {
    if (!plane.holds(t.mesh, f)) continue;
    const bool turned = t.mesh.orient(f[0], f[1], f[2], plane.above) < 0;
    pieces.push_back({f[0], f[turned ? 2 : 1], f[turned ? 1 : 2], plane.above});
  }
  EXPECT_TRUE(all_positive(t.mesh, pieces));
  const auto [a, b, c] = plane.corners;
  const std::vector<TetMesh::Corners> whole{{a, b, c, plane.above}};
  EXPECT_EQ(volume_of(t.mesh, pieces), volume_of(t.mesh, whole));
  return pieces.size();
}

// Segments as chains of segment edges, facets covered by facet faces, and no such edge or face elsewhere.
void expect_laid(const Task& t) {
  ASSERT_EQ(find_fault(t.mesh), "");
  ASSERT_EQ(volume_of(t.mesh), t.volume);
  std::size_t exact_ones = 0;
  for (Vertex v = t.first_free; v < t.mesh.vertex_count(); ++v)
    exact_ones += t.mesh.in_mesh(v) && !t.mesh.is_explicit(v) ? 1 : 0;
  ASSERT_EQ(t.mesh.exact_vertex_count(), exact_ones);
  std::set<EdgeEnds> chains;
  for (const auto& [a, b] : t.table.segments) {
    const std::vector<Vertex> chain = vertices_on(t.mesh, a, b);
    for (std::size_t k = 1; k < chain.size(); ++k) chains.insert(sorted(EdgeEnds{chain[k - 1], chain[k]}));
  }
  ASSERT_EQ(segment_edges(t.mesh), chains);
  const std::set<FaceKey> faces = facet_faces(t.mesh);
  std::size_t pieces = 0;
  for (const Triangle& f : t.surface.facets) pieces += expect_covered(t, f, faces);
  ASSERT_EQ(pieces, faces.size());
}

void expect_off_constraints(const Task& t, Vertex v) {
  for (const auto& [a, b] : t.table.segments)
    ASSERT_FALSE(on_line(t.mesh, a, b, v) && !before(t.mesh, a, b, v, a) && !before(t.mesh, a, b, b, v));
  for (const Triangle& f : t.surface.facets) ASSERT_FALSE(Plane(t, f).holds(t.mesh, v));
}

// Every segment is one edge, every facet one face, and all Steiner points are off them.
void expect_enforced(const Task& t) {
  expect_laid(t);
  std::set<FaceKey> facets;
  for (const Triangle& f : t.surface.facets) facets.insert(sorted(FaceKey{f[0], f[1], f[2]}));
  std::set<EdgeEnds> segments;
  for (const auto& [a, b] : t.table.segments) segments.insert(sorted(EdgeEnds{a, b}));
  EXPECT_EQ(facet_faces(t.mesh), facets);
  EXPECT_EQ(segment_edges(t.mesh), segments);
  for (Vertex v = t.first_free; v < t.mesh.vertex_count(); ++v)
    if (t.mesh.in_mesh(v)) expect_off_constraints(t, v);
}

// --- partition

// A grid among random points: segments between its points leave through edges, too.
std::vector<Point> points_and_grid(std::uint64_t seed) {
  std::vector<Point> points = random_points(40, seed);
  for (int k = 0; k < 27; ++k)
    points.push_back({0.25 * (k % 3 - 1), 0.25 * (k / 3 % 3 - 1), 0.25 * (k / 9 - 1)});
  return points;
}

TEST(PartitionSegment, MakesAChainThroughFacesAndEdges) {
  Surface surface;
  surface.vertices = points_and_grid(1);
  const Task start = task(surface);
  Random random(1);
  std::size_t through_faces = 0, through_edges = 0, missing = 0;
  for (int trial = 0; trial < 150; ++trial) {
    const auto a = static_cast<Vertex>(random() % 67),
               b = static_cast<Vertex>(trial % 2 * 40 + random() % 27);
    if (a == b || vertices_on(start.mesh, a, b).size() != 2) continue;
    Task t = start;
    t.surface.segments = {{a, b}};
    t.table = segment_table(t.surface.view());
    missing += find_edge(t.mesh, a, b) == kNone ? 1 : 0;
    const std::size_t tets = t.mesh.tet_count();
    const std::vector<Vertex> chain = partition_segment(t.mesh, a, b, t.first_free);
    EXPECT_EQ(chain, vertices_on(t.mesh, a, b));
    EXPECT_EQ(chain.size(), t.mesh.vertex_count() - start.mesh.vertex_count() + 2);
    expect_laid(t);
    // Every face makes 4 tetrahedra more, every edge as many as it has round it, 3 at least.
    if (t.mesh.tet_count() == tets + 4 * (chain.size() - 2)) ++through_faces;
    if (t.mesh.tet_count() > tets + 4 * (chain.size() - 2)) ++through_edges;
  }
  EXPECT_GT(missing, 50u);
  EXPECT_GT(through_faces, 20u);
  EXPECT_GT(through_edges, 5u);
}

TEST(PartitionSegment, TakesUpSteinerPointsAndRefusesInputVertices) {
  Surface surface;
  surface.vertices = random_points(40, 2);
  surface.vertices.insert(surface.vertices.end(), {{-1, -1, -1}, {1, 1, 1}});
  surface.segments = {{40, 41}};
  Task t = task(surface, {{0.25, 0.25, 0.25}, {-0.5, -0.5, -0.5}});
  const std::vector<Vertex> chain = partition_segment(t.mesh, 40, 41, t.first_free);
  for (Vertex v = t.first_free; v < t.first_free + 2; ++v)
    EXPECT_EQ(std::count(chain.begin(), chain.end(), v), 1);
  EXPECT_EQ(chain, vertices_on(t.mesh, 40, 41));
  expect_laid(t);
  Task refused = task(surface, {{0.25, 0.25, 0.25}});
  EXPECT_THROW(partition_segment(refused.mesh, 40, 41, refused.first_free + 1), std::logic_error);
  EXPECT_EQ(find_fault(refused.mesh), "");
}

// The facet 0 1 2 among random points, grid points and, with `trap`, Steiner points inside it.
Task facet_task(std::uint64_t seed, bool trap) {
  Surface surface;
  surface.vertices = {{-1, 0.75, 0.125}, {1, 0.5, 0.125}, {0.125, -1, 0.125}};
  for (const Point& p : points_and_grid(seed)) surface.vertices.push_back({p[0], p[1], p[2] + 0.03125});
  surface.facets = {{0, 1, 2}};
  if (!trap) return task(surface);
  return task(surface, {{0, 0, 0.125}, {0.25, 0.25, 0.125}, {0, 0.625, 0.125}});  // the last one on a side
}

// The vertices strictly inside the facet, whose sides are chains.
std::vector<Vertex> inside(const Task& t, const FacetFrame& frame) {
  std::vector<Vertex> out;
  for (Vertex v = t.first_free; v < t.mesh.vertex_count(); ++v)
    if (Plane(t, frame.corners).holds(t.mesh, v) &&
        std::none_of(frame.sides.begin(), frame.sides.end(),
                     [&](const auto& side) { return std::count(side.begin(), side.end(), v) > 0; }))
      out.push_back(v);
  return out;
}

// The edges through the inside of the facet, from above to below.
std::set<EdgeEnds> piercing(const Task& t, const FacetFrame& frame) {
  const auto [a, b, c] = frame.corners;
  std::set<EdgeEnds> out;
  for (const Tet tet : living(t.mesh))
    for (const Vertex u : t.mesh.corners(tet))
      for (const Vertex v : t.mesh.corners(tet))
        if (!t.mesh.is_ghost(tet) && t.mesh.orient(a, b, c, u) > 0 && t.mesh.orient(a, b, c, v) < 0 &&
            t.mesh.orient(a, b, v, u) > 0 && t.mesh.orient(b, c, v, u) > 0 && t.mesh.orient(c, a, v, u) > 0)
          out.insert({u, v});
  return out;
}

TEST(PartitionFacet, CoversTheFacetAndFindsAllThatIsInside) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    Task t = facet_task(seed, seed % 2 == 0);
    FacetFrame frame{{0, 1, 2}, {}};
    for (Vertex i = 0; i < 3; ++i)
      frame.sides[i] = partition_segment(t.mesh, (i + 1) % 3, (i + 2) % 3, t.first_free);
    const FacetSection section = facet_section(t.mesh, frame);
    EXPECT_EQ(section.inner, inside(t, frame));
    std::set<EdgeEnds> found;
    for (const auto& e : section.piercing) found.insert({e.above, e.below});
    EXPECT_EQ(found, piercing(t, frame));
    EXPECT_GT(found.size(), 0u);
    EXPECT_EQ(found.size(), section.piercing.size());
    const FacetPieces pieces = partition_facet(t.mesh, frame);
    EXPECT_EQ(pieces.added, found.size());
    EXPECT_EQ(pieces.inner, inside(t, frame));
    EXPECT_EQ(pieces.faces.size(), facet_section(t.mesh, frame).faces.size());
    expect_laid(t);
    EXPECT_TRUE(facet_section(t.mesh, frame).stands());
  }
}

// --- elimination, one point at a time

// k triangles round the segment 0 1, evenly, at random or all in one quarter, in a cloud of points.
Surface pages(int k, std::uint64_t seed) {
  Random random(seed);
  Surface surface;
  surface.vertices = {{0, 0, -1}, {0, 0, 1}};
  for (int i = 0; i < k; ++i) {
    const double even = 2 * hard::kPi * i / k;
    const double angle = seed % 3 == 0 ? even : seed % 3 == 1 ? even / 4 : even + hard::uniform(random, 0, 1);
    surface.vertices.push_back({std::cos(angle), std::sin(angle), hard::uniform(random, -0.9, 0.9)});
    surface.facets.push_back({0, 1, static_cast<Index>(i) + 2});
  }
  if (k == 0) surface.segments = {{0, 1}};
  for (const Point& p : random_points(25, seed)) surface.vertices.push_back({0.6 * p[0], 0.6 * p[1], p[2]});
  return surface;
}

// The neighbours of a point on its segment's chain, where it is on a segment.
std::optional<Ends> ends_of(const Task& t, Vertex p) {
  for (const auto& [a, b] : t.table.segments) {
    const std::vector<Vertex> chain = vertices_on(t.mesh, a, b);
    const auto at = std::find(chain.begin(), chain.end(), p);
    if (at != chain.end()) return Ends{*(at - 1), *(at + 1)};
  }
  return std::nullopt;
}

// A laid complex and its partition points in random order.
std::pair<Task, std::vector<Vertex>> laid(const Surface& surface, std::uint64_t seed) {
  Task t = task(surface);
  run(t, {.seed = seed, .eliminate = false});
  std::vector<Vertex> points(t.mesh.vertex_count() - t.first_free);
  std::iota(points.begin(), points.end(), t.first_free);
  Random random(seed);
  std::shuffle(points.begin(), points.end(), random);
  return {t, points};
}

TEST(CutAndCone, TakesEveryPointOffAnyNumberOfFacets) {
  for (int k = 0; k <= 5; ++k)
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      auto [t, points] = laid(pages(k, seed), seed);
      EXPECT_GT(points.size(), 0u);
      for (const Vertex p : points) {
        const auto before = static_cast<Vertex>(t.mesh.vertex_count());
        const std::vector<Vertex> created = cut_and_cone(t.mesh, p, ends_of(t, p));
        ASSERT_FALSE(t.mesh.in_mesh(p));
        for (Vertex v = before; v < t.mesh.vertex_count(); ++v) {
          EXPECT_EQ(std::count(created.begin(), created.end(), v), t.mesh.in_mesh(v) ? 1 : 0);
          expect_off_constraints(t, v);
        }
        ASSERT_EQ(find_fault(t.mesh), "");
        if (t.mesh.vertex_count() % 8 == 0) expect_laid(t);
      }
      expect_enforced(t);
    }
}

TEST(CollapseWithin, TakesAPointAlongItsConstraintWhereOneSeesAll) {
  int gone = 0, stay = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    auto [t, points] = laid(pages(static_cast<int>(seed % 5), seed), seed);
    for (const Vertex p : points) {
      const std::optional<Ends> ends = ends_of(t, p);
      const auto candidates =
          ends ? std::vector<Vertex>(ends->begin(), ends->end()) : facet_neighbours(t.mesh, p);
      const std::vector<FaceKey> faces = outer_faces(t.mesh, ball_of(t.mesh, p));
      const bool possible = std::any_of(candidates.begin(), candidates.end(),
                                        [&](Vertex v) { return all_positive(t.mesh, cone(faces, v)); });
      const TetMesh before = t.mesh;
      const std::vector<Ends> edge = ends ? std::vector<Ends>{*ends} : std::vector<Ends>{};
      ASSERT_EQ(collapse_within(t.mesh, p, candidates, edge), possible);
      ASSERT_EQ(t.mesh.in_mesh(p), !possible);
      EXPECT_TRUE(possible || difference(t.mesh, before).empty());
      expect_laid(t);
      if (HasFailure()) return;
      ++(possible ? gone : stay);
    }
  }
  EXPECT_GT(gone, 50);
  EXPECT_GT(stay, 50);
}

void expect_fictitious(Task& t, Vertex p, const Ends& ends, const std::vector<CutPath>& cuts) {
  std::set<EdgeEnds> taken;
  for (const CutPath& path : cuts) {
    ASSERT_GE(path.size(), 3u);
    EXPECT_EQ((Ends{path.front(), path.back()}), ends);
    for (std::size_t j = 1; j < path.size(); ++j) {
      EXPECT_EQ(t.mesh.orient(ends[0], ends[1], path[1], path[j]), 0);
      const Face f = find_face(t.mesh, p, path[j - 1], path[j]);
      ASSERT_NE(f, kNone);
      EXPECT_FALSE(t.mesh.is_facet(f));
      EXPECT_TRUE(taken.insert(sorted(EdgeEnds{path[j - 1], path[j]})).second);
    }
  }
}

TEST(FictitiousCuts, StandInForTheFacetsThatAreMissing) {
  std::size_t with_points = 0, without = 0;
  for (const int k : {0, 1, 2})
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
      auto [t, points] = laid(pages(k, seed), seed);
      for (const Vertex p : points) {
        const std::optional<Ends> ends = ends_of(t, p);
        if (!ends) continue;
        const bool on_fold = on_line(t.mesh, 0, 1, p);
        std::vector<Vertex> created;
        const auto cuts = fictitious_cuts(t.mesh, p, *ends, created);
        ASSERT_EQ(cuts.size(), on_fold ? 2 - static_cast<std::size_t>(k) : 1u);
        expect_fictitious(t, p, *ends, cuts);
        for (const Vertex v : created) expect_off_constraints(t, v);
        ++(created.empty() ? without : with_points);
        expect_laid(t);
        cut_and_cone(t.mesh, p, ends);
      }
    }
  EXPECT_GT(without, 50u);
  EXPECT_GT(with_points, 5u);
}

// Directions to the points of a grid round the origin, each once, as they turn.
std::vector<std::array<int, 2>> directions_of_grid(int reach) {
  std::vector<std::array<int, 2>> out;
  for (int x = -reach; x <= reach; ++x)
    for (int y = -reach; y <= reach; ++y)
      if (std::gcd(x, y) == 1) out.push_back({x, y});
  const auto upper = [](const std::array<int, 2>& d) { return d[1] > 0 || (d[1] == 0 && d[0] > 0); };
  std::sort(out.begin(), out.end(), [&](const auto& d, const auto& e) {
    return upper(d) != upper(e) ? upper(d) : d[0] * e[1] - d[1] * e[0] > 0;
  });
  return out;
}

// The ball of vertex 0, whose link has these triangles, each positive with it, closed by ghosts.
TetMesh mesh_of_ball(const std::vector<Point>& points, const std::vector<Triangle>& link) {
  TetMesh mesh;
  for (const Point& p : points) MeshEditor(mesh).add_vertex(p);
  std::map<FaceKey, Face> open;
  const auto add = [&](const TetMesh::Corners& corners) {
    const Tet t = MeshAssembly(mesh).add_tet(corners);
    for (int i = 0; i < 4; ++i) {
      FaceKey key{};
      std::size_t n = 0;
      for (int k = 0; k < 4; ++k)
        if (k != i) key[n++] = mesh.corner(t, k);
      const auto [at, is_first] = open.try_emplace(sorted(key), face_code(t, i));
      if (!is_first) MeshAssembly(mesh).link(face_code(t, i), at->second);
    }
    for (const Vertex v : corners)
      if (v != kGhost) MeshAssembly(mesh).set_incident(v, t);
  };
  for (const auto& [a, b, c] : link) add({a, c, b, kGhost});
  for (const auto& [a, b, c] : link) add({a, b, c, 0});
  return mesh;
}

// A point of a dangling segment where doubles are the integers. Its link has a vertex in every direction that
// an integer point near by lies in; those that are joined to one end of the segment are not joined to the
// other.
TEST(FictitiousCuts, ArePossibleWhereEveryDoubleLiesInTheDirectionOfALinkVertex) {
  constexpr double kFar = 0x1.8p52;
  const auto at = [](int x, int y, int z) { return Point{kFar + x, kFar + y, kFar + z}; };
  const auto ring = directions_of_grid(14);
  const auto n = static_cast<Index>(ring.size());
  std::vector<Point> points{at(0, 0, 0), at(0, 0, -1), at(0, 0, 1)};
  for (const auto& [x, y] : ring) points.push_back(at(x, y, -1));
  for (Index k = 0; k < n; ++k)
    points.push_back(at(ring[k][0] + ring[(k + 1) % n][0], ring[k][1] + ring[(k + 1) % n][1], 1));
  std::vector<Triangle> link;
  for (Index k = 0; k < n; ++k) {
    const Index low = 3 + k, next_low = 3 + (k + 1) % n, high = 3 + n + k, next_high = 3 + n + (k + 1) % n;
    link.insert(
        link.end(),
        {{1, low, next_low}, {low, high, next_low}, {next_low, high, next_high}, {2, next_high, high}});
  }
  Task t;
  t.mesh = mesh_of_ball(points, link);
  for (Triangle& f : link)
    if (t.mesh.orient(f[0], f[1], f[2], 0) < 0) std::swap(f[1], f[2]);
  t.mesh = mesh_of_ball(points, link);
  for (const Tet s : ball_of(t.mesh, 0)) {
    const auto& c = t.mesh.corners(s);
    ASSERT_GT(t.mesh.orient(c[0], c[1], c[2], c[3]), 0);
  }
  std::vector<Vertex> created;
  const auto cuts = fictitious_cuts(t.mesh, 0, {1, 2}, created);
  ASSERT_EQ(cuts.size(), 2u);
  EXPECT_FALSE(created.empty());
  expect_fictitious(t, 0, {1, 2}, cuts);
  cut_and_cone(t.mesh, 0, Ends{1, 2});
  EXPECT_NE(find_edge(t.mesh, 1, 2), kNone);
  for (const Tet s : living(t.mesh)) {
    if (t.mesh.is_ghost(s)) continue;
    const auto& c = t.mesh.corners(s);
    EXPECT_GT(t.mesh.orient(c[0], c[1], c[2], c[3]), 0);
  }
}

// --- all of it

Surface schoenhardt(double twist, double height) {
  Surface s;
  for (int k = 0; k < 6; ++k) {
    const double angle = 2 * hard::kPi / 3 * (k % 3) + (k < 3 ? 0 : twist);
    s.vertices.push_back({std::cos(angle), std::sin(angle), k < 3 ? 0 : height});
  }
  s.facets = {{0, 2, 1}, {3, 4, 5}};
  for (Index k = 0; k < 3; ++k) {
    const Index j = (k + 1) % 3;
    s.facets.insert(s.facets.end(), {{k, j, 3 + j}, {k, 3 + j, 3 + k}});
  }
  return s;
}

std::vector<Surface> hard_ones() {
  std::vector<Surface> out;
  for (const double height : {0.2, 1.0, 5.0})
    for (int k = 1; k < 10; ++k) out.push_back(schoenhardt(k * hard::kPi / 30, height));
  Random random(1);
  for (int k = 0; k < 5; ++k) out.push_back(hard::twisted_prism(random));
  for (int n = 1; n <= 3; ++n) out.push_back(hard::chazelle(n));
  for (int k = 0; k <= 6; ++k) out.push_back(pages(k, 10 + static_cast<std::uint64_t>(k)));
  for (int k = 0; k < 2; ++k) out.push_back(hard::scattered(random));
  return out;
}

TEST(Enforce, WithoutEliminationLaysAllOnPartitionPoints) {
  std::size_t on_segments = 0, in_facets = 0;
  for (const Surface& surface : hard_ones()) {
    Task t = task(surface);
    const EnforceStats stats = run(t, {.seed = 3, .eliminate = false});
    EXPECT_EQ(t.mesh.vertex_count() - t.first_free, stats.segment_points + stats.facet_points);
    EXPECT_EQ(t.standing.missing_facets(), 0u);
    expect_laid(t);
    on_segments += stats.segment_points;
    in_facets += stats.facet_points;
  }
  EXPECT_GT(on_segments, 100u);
  EXPECT_GT(in_facets, 100u);
}

void expect_enforcement(const Surface& surface, const std::vector<Point>& steiner = {}) {
  for (const bool flips : {false, true})
    for (std::uint64_t seed = 1; seed <= 2; ++seed) {
      Task t = task(surface, steiner);
      run(t, {.seed = seed, .flips = flips});
      EXPECT_EQ(t.standing.missing_segments() + t.standing.missing_facets(), 0u);
      expect_enforced(t);
    }
}

TEST(Enforce, MakesEveryConstraintStand) {
  for (const Surface& surface : hard_ones()) expect_enforcement(surface);
}

TEST(Enforce, TheSeedAloneDecides) {
  Task one = task(hard::chazelle(2)), same = one, other = one;
  run(one, {.seed = 1, .flips = false});
  run(same, {.seed = 1, .flips = false});
  run(other, {.seed = 2, .flips = false});
  EXPECT_EQ(difference(one.mesh, same.mesh), "");
  EXPECT_NE(difference(one.mesh, other.mesh), "");
}

// Points that were moved off one constraint and by accident onto others that are missing.
TEST(Enforce, TakesSteinerPointsOffMissingConstraints) {
  Surface surface = facet_task(3, false).surface;
  for (Index above = 3; surface.segments.empty(); ++above)
    for (Index v = 3; v < above && surface.segments.empty(); ++v)
      if (surface.vertices[v][2] > 0.5 && surface.vertices[above][2] > 0.5) surface.segments = {{v, above}};
  expect_enforcement(surface, {{0, 0, 0.125}, {0.25, 0.25, 0.125}, {0, 0.625, 0.125}, {0.5, 0.5, 0.125}});
  Surface prism = schoenhardt(0.5, 2);
  for (Point& p : prism.vertices)
    for (double& x : p) x = std::round(16 * x) / 16;
  std::vector<Point> steiner;
  for (const auto& [a, b, c] : prism.facets)
    for (const std::array<double, 3>& w : {std::array{0.5, 0.25, 0.25}, std::array{0.5, 0.5, 0.0}}) {
      Point p{};
      for (std::size_t k = 0; k < 3; ++k)
        p[k] = w[0] * prism.vertices[a][k] + w[1] * prism.vertices[b][k] + w[2] * prism.vertices[c][k];
      if (std::find(steiner.begin(), steiner.end(), p) == steiner.end()) steiner.push_back(p);
    }
  expect_enforcement(prism, steiner);
}

TEST(Enforce, StopsWhenToldToWithAValidMesh) {
  Task t = task(hard::chazelle(2));
  Options options;
  options.time_limit = 1e-9;
  Monitor monitor(options);
  EXPECT_THROW(
      enforce(t.mesh, t.table, t.surface.facets, t.standing, t.first_free, {.flips = false}, monitor),
      Interrupted);
  EXPECT_EQ(find_fault(t.mesh), "");
  EXPECT_EQ(volume_of(t.mesh), t.volume);
}

}  // namespace
}  // namespace holdfast
