// The triangles of one polygon, or of a facet of several outlines.
//
// Points are first renumbered from left to right, and edges sorted by their ends. So the result depends on
// places alone.
#include "plane/polygon.h"

#include <algorithm>
#include <numeric>

#include "plane/ears.h"
#include "plane/faces.h"
#include "plane/regions.h"
#include "plane/sorted.h"
#include "plane/swaps.h"

namespace holdfast::plane {
namespace {

/// How often a walk passes an edge from its lower end to the upper one, minus how often it passes back.
struct EdgeUse {
  Ends ends;
  int net;
};

std::vector<EdgeUse> sides_of(std::span<const Vertex> walk, const std::vector<Vertex>& number) {
  std::vector<EdgeUse> sides;
  sides.reserve(walk.size());
  for (std::size_t i = 0; i < walk.size(); ++i) {
    const Vertex a = number[walk[i]], b = number[walk[i + 1 < walk.size() ? i + 1 : 0]];
    sides.push_back({{std::min(a, b), std::max(a, b)}, a < b ? 1 : -1});
  }
  std::sort(sides.begin(), sides.end(), [](const EdgeUse& s, const EdgeUse& t) { return s.ends < t.ends; });
  std::size_t count = 0;
  for (const EdgeUse& side : sides) {
    if (count > 0 && sides[count - 1].ends == side.ends)
      sides[count - 1].net += side.net;
    else
      sides[count++] = side;
  }
  sides.resize(count);
  return sides;
}

/// Winding numbers of a walk round the faces between its sides. The graph is connected, so each face but the
/// outer one has one border.
class Windings {
 public:
  Windings(const std::vector<EdgeUse>& sides, const Walks& faces) : sides_(sides), faces_(faces) {
    face_of_.assign(2 * sides.size(), kOuter);
    for (std::uint32_t f = 0; f < faces.count(); ++f)
      each_side(f, [&](std::size_t half) { face_of_[half] = f; });
    neighbours_.assign(faces.count() + 1, {});
    for (std::size_t half = 0; half < face_of_.size(); ++half)
      neighbours_[slot(face_of_[half])].push_back(half);
  }

  /// The direction, +1 or -1, of a walk whose winding numbers are all 0 or that, with no fold outside what it
  /// encloses; 0 for any other walk.
  [[nodiscard]] int direction() {
    winding_.assign(faces_.count() + 1, kUnknown);
    winding_[slot(kOuter)] = 0;
    std::vector<std::size_t> pending{slot(kOuter)};
    int direction = 0;
    while (!pending.empty()) {
      const std::size_t f = pending.back();
      pending.pop_back();
      for (const std::size_t half : neighbours_[f]) {
        const int net = half % 2 == 0 ? sides_[half / 2].net : -sides_[half / 2].net;
        const std::size_t g = slot(face_of_[half ^ 1]);
        // The face on the right of the side has a winding number lower by the net passages with f on the
        // left.
        const int beyond = winding_[f] - net;
        if (winding_[g] == kUnknown) {
          if (beyond != 0 && direction == 0) direction = beyond;
          if (beyond != 0 && (beyond != direction || std::abs(beyond) != 1)) return 0;
          winding_[g] = beyond;
          pending.push_back(g);
        }
        // A fold outside what the walk encloses leaves corners without triangles.
        if (net == 0 && winding_[f] == 0) return 0;
      }
    }
    return direction;
  }
  [[nodiscard]] bool encloses(std::size_t face) const { return winding_[face] != 0; }

 private:
  static constexpr std::uint32_t kOuter = ~std::uint32_t{0};
  static constexpr int kUnknown = 1 << 30;

  [[nodiscard]] std::size_t slot(std::uint32_t face) const { return face == kOuter ? faces_.count() : face; }

  /// Half 2 i leads along side i from its lower end, 2 i + 1 back.
  template <typename Visit>
  void each_side(std::uint32_t f, Visit&& visit) const {
    const std::size_t first = faces_.first[f], last = faces_.first[f + std::size_t{1}];
    for (std::size_t i = first; i < last; ++i) {
      const Vertex a = faces_.vertices[i], b = faces_.vertices[i + 1 < last ? i + 1 : first];
      const Ends ends{std::min(a, b), std::max(a, b)};
      const auto side = std::lower_bound(sides_.begin(), sides_.end(), ends,
                                         [](const EdgeUse& s, const Ends& e) { return s.ends < e; });
      visit(2 * static_cast<std::size_t>(side - sides_.begin()) + (a < b ? 0 : 1));
    }
  }

  const std::vector<EdgeUse>& sides_;
  const Walks& faces_;
  std::vector<std::uint32_t> face_of_;                // the face on the left of each half
  std::vector<std::vector<std::size_t>> neighbours_;  // by face, the halves that have it on their left
  std::vector<int> winding_;
};

/// The corners of a triangle by the original numbers of the points.
Corners3 corners_of(const Triangles& mesh, std::size_t t, const Sorted& sorted) {
  const Corners3& v = mesh[t].v;
  return {sorted.order[v[0]], sorted.order[v[1]], sorted.order[v[2]]};
}

}  // namespace

std::optional<std::vector<Corners3>> triangles_of_walk(const GivenPoints& points,
                                                       std::span<const Vertex> walk, const Poll& poll) {
  const Sorted sorted(points);
  const std::vector<EdgeUse> sides = sides_of(walk, sorted.number);
  std::vector<Ends> edges;
  edges.reserve(sides.size());
  for (const EdgeUse& side : sides) edges.push_back(side.ends);
  if (!sweep(sorted.points, edges, poll)) return std::nullopt;
  const Walks faces = find_faces(sorted.points, edges);
  Windings windings(sides, faces);
  const int direction = windings.direction();
  if (direction == 0) return std::nullopt;
  Triangles mesh = join_faces(cut_ears(sorted.points, faces, edges.size(), PlaneEars::first,
                                       [&](std::size_t f) { return windings.encloses(f); }),
                              0);
  swap_to_delaunay(mesh, sorted.points, poll);
  std::vector<Corners3> triangles;
  triangles.reserve(mesh.size());
  for (std::size_t t = 0; t < mesh.size(); ++t) triangles.push_back(corners_of(mesh, t, sorted));
  if (direction < 0)
    for (Corners3& t : triangles) std::swap(t[1], t[2]);
  return triangles;
}

std::optional<std::vector<Corners3>> triangles_of_outlines(const GivenPoints& points,
                                                           const std::vector<Ends>& edges,
                                                           const GivenPoints& holes, const Poll& poll) {
  Sorted sorted(points);
  std::vector<Ends> segments;
  segments.reserve(edges.size());
  for (const auto& [a, b] : edges) {
    const Vertex v = sorted.number[a], w = sorted.number[b];
    segments.push_back({std::min(v, w), std::max(v, w)});
  }
  std::sort(segments.begin(), segments.end());
  std::optional<std::vector<Ends>> graph = sweep(sorted.points, segments, poll);
  if (!graph) return std::nullopt;
  const std::size_t links = graph->size();
  graph->insert(graph->end(), segments.begin(), segments.end());
  const Walks faces = find_faces(sorted.points, *graph);
  Triangles mesh = join_faces(
      cut_ears(sorted.points, faces, graph->size(), PlaneEars::first, [](std::size_t) { return true; }),
      links);
  swap_to_delaunay(mesh, sorted.points, poll);
  const Regions regions = find_regions(mesh);
  std::vector<bool> kept(regions.count + std::size_t{1}, true);
  kept[kOutside] = false;
  for (const Found& found : find_triangles(mesh, sorted.points, holes)) {
    if (found.on_constraint) return std::nullopt;
    if (found.triangle != kNoVertex) kept[regions.of_triangle[found.triangle]] = false;
  }
  std::vector<Corners3> triangles;
  for (std::size_t t = 0; t < mesh.size(); ++t)
    if (kept[regions.of_triangle[t]]) triangles.push_back(corners_of(mesh, t, sorted));
  return triangles;
}

}  // namespace holdfast::plane
