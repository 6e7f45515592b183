// The bounded faces of a connected graph in the plane.
#include "plane/faces.h"

#include <algorithm>
#include <numeric>
#include <span>

namespace holdfast::plane {
namespace {

/// Half-edge 2 i leads from the first end of edge i to the second, 2 i + 1 back.
class Graph {
 public:
  Graph(const Points& points, const std::vector<Ends>& edges) : points_(points), edges_(edges) {
    std::vector<std::uint32_t> first(points.size() + 1, 0);
    for (const Ends& e : edges)
      for (const Vertex v : e) ++first[v];
    std::partial_sum(first.begin(), first.end(), first.begin());
    std::vector<std::uint32_t> around(2 * edges.size());
    for (std::uint32_t h = 0; h < around.size(); ++h) around[--first[from(h)]] = h;
    next_.resize(around.size());
    for (Vertex v = 0; v < points.size(); ++v)
      link_around(v, std::span(around).subspan(first[v], first[v + std::size_t{1}] - first[v]));
  }

  [[nodiscard]] std::size_t size() const { return next_.size(); }
  [[nodiscard]] Vertex from(std::uint32_t h) const { return edges_[h / 2][h % 2]; }
  [[nodiscard]] Vertex to(std::uint32_t h) const { return edges_[h / 2][1 - h % 2]; }
  /// The next half-edge after h on the border of the face on its left: the first one clockwise from h
  /// reversed.
  [[nodiscard]] std::uint32_t next(std::uint32_t h) const { return next_[h]; }

 private:
  void link_around(Vertex v, std::span<std::uint32_t> around) {
    if (around.size() > 2) sort_around(v, around);  // two are in cyclic order anyway
    for (std::size_t i = 0; i < around.size(); ++i)
      next_[around[i + 1 < around.size() ? i + 1 : 0] ^ 1] = around[i];
  }

  // Counterclockwise from straight down, so what lies to the right in the order of the sweep comes first.
  void sort_around(Vertex v, std::span<std::uint32_t> around) const {
    std::sort(around.begin(), around.end(), [&](std::uint32_t g, std::uint32_t h) {
      const bool g_left = to(g) < v, h_left = to(h) < v;
      if (g_left != h_left) return h_left;
      return points_.orient(v, to(g), to(h)) > 0;
    });
  }

  const Points& points_;
  const std::vector<Ends>& edges_;
  std::vector<std::uint32_t> next_;
};

/// The outer face is the one whose walk has it on the outer side at the leftmost vertex.
bool is_bounded(const Points& points, const std::vector<Vertex>& walk, std::size_t first) {
  const std::size_t n = walk.size() - first;
  const Vertex least = *std::min_element(walk.begin() + static_cast<std::ptrdiff_t>(first), walk.end());
  for (std::size_t i = 0; i < n; ++i)
    if (walk[first + i] == least && points.orient(walk[first + (i > 0 ? i - 1 : n - 1)], least,
                                                  walk[first + (i + 1 < n ? i + 1 : 0)]) <= 0)
      return false;
  return true;
}

}  // namespace

Walks find_faces(const Points& points, const std::vector<Ends>& edges) {
  const Graph graph(points, edges);
  Walks walks;
  walks.first.push_back(0);
  walks.vertices.reserve(graph.size());
  walks.sides.reserve(graph.size());
  std::vector<bool> seen(graph.size(), false);
  for (std::uint32_t start = 0; start < graph.size(); ++start) {
    if (seen[start]) continue;
    for (std::uint32_t h = start; !seen[h]; h = graph.next(h)) {
      seen[h] = true;
      walks.vertices.push_back(graph.from(h));
      walks.sides.push_back(h);
    }
    if (is_bounded(points, walks.vertices, walks.first.back())) {
      walks.first.push_back(walks.vertices.size());
    } else {
      walks.vertices.resize(walks.first.back());
      walks.sides.resize(walks.first.back());
    }
  }
  return walks;
}

}  // namespace holdfast::plane
