// The bounded faces of a connected graph in the plane.
#include "plane/faces.h"

#include <algorithm>
#include <numeric>

namespace holdfast::plane {
namespace {

/// Half-edge 2 i leads from the first end of edge i to the second, 2 i + 1 back.
class Graph {
 public:
  Graph(const Points& points, const std::vector<Ends>& edges) : points_(points), edges_(edges) {
    first_.assign(points.size() + 1, 0);
    for (const Ends& e : edges)
      for (const Vertex v : e) ++first_[v + std::size_t{1}];
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    around_.resize(2 * edges.size());
    place_.resize(2 * edges.size());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for (std::uint32_t h = 0; h < around_.size(); ++h) around_[next[from(h)]++] = h;
    for (Vertex v = 0; v < points.size(); ++v) sort_around(v);
    for (std::uint32_t i = 0; i < around_.size(); ++i) place_[around_[i]] = i;
  }

  [[nodiscard]] std::size_t size() const { return around_.size(); }
  [[nodiscard]] Vertex from(std::uint32_t h) const { return edges_[h / 2][h % 2]; }
  [[nodiscard]] Vertex to(std::uint32_t h) const { return edges_[h / 2][1 - h % 2]; }
  /// The half-edge behind h on the border of the face on its left: clockwise from where h came from.
  [[nodiscard]] std::uint32_t next(std::uint32_t h) const {
    const std::uint32_t back = place_[h ^ 1];
    const Vertex v = to(h);
    return back == first_[v] ? around_[first_[v + std::size_t{1}] - 1] : around_[back - 1];
  }

 private:
  // Counterclockwise, from straight down: first what lies to the right in the order of the sweep.
  void sort_around(Vertex v) {
    const auto begin = around_.begin() + first_[v], end = around_.begin() + first_[v + std::size_t{1}];
    if (end - begin < 3) return;  // any order of two is cyclic
    std::sort(begin, end, [&](std::uint32_t g, std::uint32_t h) {
      const bool g_left = points_.compare(to(g), v) < 0, h_left = points_.compare(to(h), v) < 0;
      if (g_left != h_left) return h_left;
      return points_.orient(v, to(g), to(h)) > 0;
    });
  }

  const Points& points_;
  const std::vector<Ends>& edges_;
  std::vector<std::uint32_t> first_, around_, place_;
};

/// The outer face is that of a walk whose leftmost vertex has the side away from the others in the face.
bool is_bounded(const Points& points, const std::vector<Vertex>& walk, std::size_t first) {
  const std::size_t n = walk.size() - first;
  Vertex least = walk[first];
  for (std::size_t i = first; i < walk.size(); ++i)
    if (points.compare(walk[i], least) < 0) least = walk[i];
  for (std::size_t i = 0; i < n; ++i)
    if (walk[first + i] == least &&
        points.orient(walk[first + (i + n - 1) % n], least, walk[first + (i + 1) % n]) <= 0)
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
