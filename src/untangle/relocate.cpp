#include "untangle/relocate.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <queue>

#include "mesh/kernel.h"
#include "numbers/vector.h"
#include "untangle/tuning.h"

namespace holdfast {
namespace {

class Relocation {
 public:
  Relocation(Tangle& tangle, Watch& watch)
      : tangle_(tangle), watch_(watch), visits_(tangle.vertex_count(), 0) {}

  std::size_t run() {
    for (const Tet t : tangle_.nonpositive()) push_corners(t);
    while (!queue_.empty()) {
      const Entry next = queue_.top();
      queue_.pop();
      watch_.poll();
      // An entry is stale if its vertex has been handled or its ball has changed; then there is a newer
      // entry.
      if (next.version != versions_[next.vertex]) continue;
      if (move_to_better_place(next.vertex)) {
        ++moves_;
        for (const Tet t : tangle_.star(next.vertex))
          if (tangle_.sign(t) <= 0) push_corners(t);
      }
    }
    return moves_;
  }

 private:
  struct Entry {
    double volume;
    Vertex vertex;
    unsigned version;
    bool operator<(const Entry& other) const {
      return volume != other.volume ? volume < other.volume : vertex > other.vertex;
    }
  };

  void push_corners(Tet t) {
    for (const Vertex v : tangle_.corners(t)) {
      if (tangle_.is_fixed(v) || visits_[v] == tuning::kMostVisits) continue;
      versions_.resize(tangle_.vertex_count(), 0);
      queue_.push({tangle_.deficit(tangle_.star(v)).volume.value, v, ++versions_[v]});
    }
  }

  bool move_to_better_place(Vertex v) {
    const Deficit before = tangle_.deficit(tangle_.star(v));
    if (before.count == 0) return false;
    ++visits_[v];
    const Point old = tangle_.position(v);
    collect_candidates(v);
    std::optional<Point> best;
    Deficit least = before;
    for (const Point& p : candidates_) {
      if (!std::isfinite(p[0] + p[1] + p[2])) continue;
      tangle_.move_vertex(v, p);
      const Deficit found = tangle_.deficit(tangle_.star(v));
      if (!found.better_than(least)) continue;
      best = p;
      least = found;
      if (found.count == 0) break;
    }
    tangle_.move_vertex(v, best.value_or(old));
    return best.has_value();
  }

  // The kernel's point comes first, because it ends the search.
  void collect_candidates(Vertex v) {
    candidates_.clear();
    const Point& p = tangle_.position(v);
    const auto star = tangle_.star(v);
    if (star.size() <= tuning::kMostFacesOfKernel &&
        std::all_of(star.begin(), star.end(), [&](Tet t) { return has_area(t, v); })) {
      Kernel kernel(tangle_.points());
      for (const Tet t : star) {
        const auto f = tangle_.face(t, tangle_.index_of(t, v));
        kernel.add(f[0], f[1], f[2]);
      }
      const Kernel::Centre centre = kernel.centre({p.data(), nullptr});
      if (centre.radius > 0)
        if (const auto inside = kernel.double_at({p.data(), nullptr}, centre)) {
          candidates_.push_back(*inside);
          return;
        }
      candidates_.push_back(
          towards(p, {p[0] + centre.offset[0], p[1] + centre.offset[1], p[2] + centre.offset[2]}, 1));
    }
    candidates_.push_back(mean_of_neighbours(v));
    const Point star_point = papers_place(v);
    for (const double omega : tuning::kOmegas) candidates_.push_back(towards(p, star_point, 1 - omega));
  }

  // Whether the face opposite v has an area. Nothing sees a face without one, and a kernel must not be asked.
  [[nodiscard]] bool has_area(Tet t, Vertex v) const {
    const auto f = tangle_.face(t, tangle_.index_of(t, v));
    const TetMesh& points = tangle_.points();
    for (const int axis : {0, 1, 2})
      if (exact::orient2d(points.point(f[0]), points.point(f[1]), points.point(f[2]), axis) != 0) return true;
    return false;
  }

  static Point towards(const Point& from, const Point& to, double share) {
    return {from[0] + share * (to[0] - from[0]), from[1] + share * (to[1] - from[1]),
            from[2] + share * (to[2] - from[2])};
  }

  [[nodiscard]] Point mean_of_neighbours(Vertex v) const {
    Point sum{};
    double count = 0;
    for (const Tet t : tangle_.star(v))
      for (const Vertex w : tangle_.corners(t)) {
        if (w == v) continue;
        for (std::size_t k = 0; k < 3; ++k) sum[k] += tangle_.position(w)[k];
        ++count;
      }
    return {sum[0] / count, sum[1] / count, sum[2] / count};
  }

  // P* of equation (4): the mean of the mirror images of v in the opposite faces of its negative tetrahedra
  // (5). If there are only null ones, the mean of the centroids of the opposite faces of the positive ones.
  [[nodiscard]] Point papers_place(Vertex v) const {
    Point mirrored{}, centroids{};
    double negative = 0, positive = 0;
    for (const Tet t : tangle_.star(v)) {
      const auto f = tangle_.face(t, tangle_.index_of(t, v));
      if (tangle_.sign(t) < 0) {
        const Point image = mirror(tangle_.position(v), f);
        for (std::size_t k = 0; k < 3; ++k) mirrored[k] += image[k];
        ++negative;
      } else if (tangle_.sign(t) > 0) {
        for (const Vertex w : f)
          for (std::size_t k = 0; k < 3; ++k) centroids[k] += tangle_.position(w)[k] / 3;
        ++positive;
      }
    }
    Point& sum = negative > 0 ? mirrored : centroids;
    const double count = negative > 0 ? negative : positive;
    return {sum[0] / count, sum[1] / count, sum[2] / count};
  }

  [[nodiscard]] Point mirror(const Point& p, const std::array<Vertex, 3>& f) const {
    const Point& a = tangle_.position(f[0]);
    const Vector n = cross(tangle_.position(f[1]) - a, tangle_.position(f[2]) - a);
    const double twice = 2 * dot(p - a, n) / dot(n, n);
    return {p[0] - twice * n[0], p[1] - twice * n[1], p[2] - twice * n[2]};
  }

  Tangle& tangle_;
  Watch& watch_;
  std::vector<int> visits_;
  std::vector<unsigned> versions_;
  std::priority_queue<Entry> queue_;
  std::vector<Point> candidates_;
  std::size_t moves_ = 0;
};

}  // namespace

std::size_t relocate(Tangle& tangle, Watch& watch) { return Relocation(tangle, watch).run(); }

}  // namespace holdfast
