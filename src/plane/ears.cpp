// Triangles of a polygon by cutting off its corners.
//
// Corners are those of a closed walk round a face; several may lie at one vertex. Corner b with a before and
// c behind it is an ear if abc is positive and holds no vertex of the walk but a, b and c, on its sides
// neither: no edge can then enter it, as an edge that enters by ac would have to leave by ac. It is enough to
// ask corners that are reflex or straight. For of the vertices in abc, the one furthest from ac has nothing
// of the walk beyond it, and so its corner on that side is of 180 degrees or more.
#include "plane/ears.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "plane/grid.h"

namespace holdfast::plane {
namespace {

using Corner = std::uint32_t;
constexpr Corner kNone = ~Corner{0};

class Clipper {
 public:
  Clipper(const Points& points, std::span<const Vertex> walk, PlaneEars choice,
          std::vector<std::array<Vertex, 3>>& triangles, EarCounts& counts)
      : points_(points), choice_(choice), triangles_(triangles), counts_(counts) {
    const auto n = static_cast<Corner>(walk.size());
    corners_.reserve(n);
    for (Corner i = 0; i < n; ++i)
      corners_.push_back({walk[i], i > 0 ? i - 1 : n - 1, i + 1 < n ? i + 1 : 0});
    for (Corner i = 0; i < n; ++i) corners_[i].reflex = turn(i) <= 0;
    make_cells(walk);
    // The last is looked at first, so that ears come in the order of the walk.
    for (Corner i = n; i-- > 0;) look_at(i);
  }

  void run() {
    const std::size_t before = triangles_.size(), corners = corners_.size();
    while (!candidates_.empty()) {
      const Candidate candidate = take();
      const Corner b = candidate.corner;
      if (corners_[b].removed || corners_[b].reflex) continue;
      // With other neighbours by now, it comes again.
      if (choice_ == PlaneEars::best && candidate.quality != quality(b)) continue;
      const Corner a = corners_[b].before, c = corners_[b].behind;
      if (a == corners_[c].behind) {  // the last triangle of a part
        emit(a, b, c);
        for (const Corner i : {a, b, c}) corners_[i].removed = true;
        continue;
      }
      const Corner witness = blocker(a, b, c);
      if (witness == kNone) {
        cut(a, b, c);
      } else if (choice_ == PlaneEars::join) {
        join(a, b, c);
      } else {
        // Not before the witness is cut off, or convex, can this corner be an ear with these neighbours.
        waiting_.push_back({b, corners_[witness].waiting});
        corners_[witness].waiting = static_cast<std::uint32_t>(waiting_.size() - 1);
      }
    }
    if (triangles_.size() - before != corners - 2)
      throw std::logic_error("holdfast: a polygon is left without an ear");
  }

 private:
  struct Place {
    Vertex v;
    Corner before, behind;
    bool reflex = false, removed = false;
    std::uint32_t waiting = kNone;  // first of a list of corners of which this one is the witness
    Corner twin = kNone;            // another corner at the vertex, by the second construction
  };
  struct Waiting {
    Corner corner;
    std::uint32_t next;
  };

  [[nodiscard]] int turn(Corner i) const {
    const Place& p = corners_[i];
    return points_.orient(corners_[p.before].v, p.v, corners_[p.behind].v);
  }

  // --- Which corner comes next -------------------------------------------------------------------------

  /// Of the triangle that a corner would make, the least height over the longest side, roughly.
  [[nodiscard]] double quality(Corner i) const {
    const Place& p = corners_[i];
    const Position &a = points_[corners_[p.before].v], &b = points_[p.v], &c = points_[corners_[p.behind].v];
    const double ux = b[0] - a[0], uy = b[1] - a[1], vx = c[0] - b[0], vy = c[1] - b[1];
    const double wx = a[0] - c[0], wy = a[1] - c[1];
    const double scale =
        std::max({std::abs(ux), std::abs(uy), std::abs(vx), std::abs(vy), std::abs(wx), std::abs(wy)});
    const auto part = [&](double x) { return x / scale; };
    const double area = part(ux) * part(vy) - part(uy) * part(vx);
    const double squares = part(ux) * part(ux) + part(uy) * part(uy) + part(vx) * part(vx) +
                           part(vy) * part(vy) + part(wx) * part(wx) + part(wy) * part(wy);
    const double q = area / squares;
    return q > 0 ? q : 0;  // also where the doubles tell nothing
  }

  struct Candidate {
    double quality;
    Corner corner;
    bool operator<(const Candidate& other) const {
      return quality != other.quality ? quality < other.quality : corner > other.corner;
    }
  };

  void look_at(Corner i) {
    if (corners_[i].reflex || corners_[i].removed) return;
    candidates_.push_back({choice_ == PlaneEars::best ? quality(i) : 0, i});
    if (choice_ == PlaneEars::best) std::push_heap(candidates_.begin(), candidates_.end());
  }

  Candidate take() {
    if (choice_ == PlaneEars::best) std::pop_heap(candidates_.begin(), candidates_.end());
    const Candidate candidate = candidates_.back();
    candidates_.pop_back();
    return candidate;
  }

  void wake(Corner witness) {
    std::uint32_t i = corners_[witness].waiting;
    corners_[witness].waiting = kNone;
    for (; i != kNone; i = waiting_[i].next) look_at(waiting_[i].corner);
  }

  // --- Corners in a triangle ------------------------------------------------------------------------------

  // Reflex corners by cells of a grid, about one in each.
  void make_cells(std::span<const Vertex> walk) {
    std::vector<Position> places;
    for (Corner i = 0; i < corners_.size(); ++i)
      if (corners_[i].reflex) places.push_back(points_[walk[i]]);
    if (places.empty()) return;
    side_ = 1;
    while (std::size_t{side_} * side_ < places.size() && side_ < 4096) side_ *= 2;
    grid_.emplace(places, side_);
    first_.assign(std::size_t{side_} * side_ + 1, 0);
    const auto cell = [&](Corner i) {
      const Position& p = points_[corners_[i].v];
      return std::size_t{grid_->cell(p[1], 1)} * side_ + grid_->cell(p[0], 0);
    };
    for (Corner i = 0; i < corners_.size(); ++i)
      if (corners_[i].reflex) ++first_[cell(i) + 1];
    for (std::size_t k = 1; k < first_.size(); ++k) first_[k] += first_[k - 1];
    in_cells_.resize(places.size());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for (Corner i = 0; i < corners_.size(); ++i)
      if (corners_[i].reflex) in_cells_[next[cell(i)]++] = i;
  }

  /// Calls `visit` for reflex corners in the triangle, but those at its own vertices, until it returns false.
  template <typename Visit>
  void each_inside(Corner a, Corner b, Corner c, Visit&& visit) const {
    if (!grid_) return;
    const Vertex va = corners_[a].v, vb = corners_[b].v, vc = corners_[c].v;
    const Position &pa = points_[va], &pb = points_[vb], &pc = points_[vc];
    const double left = std::min({pa[0], pb[0], pc[0]}), right = std::max({pa[0], pb[0], pc[0]});
    const double low = std::min({pa[1], pb[1], pc[1]}), high = std::max({pa[1], pb[1], pc[1]});
    const std::uint32_t x0 = grid_->cell(left, 0), x1 = grid_->cell(right, 0);
    const std::uint32_t y0 = grid_->cell(low, 1), y1 = grid_->cell(high, 1);
    for (std::uint32_t y = y0; y <= y1; ++y) {
      const std::size_t row = std::size_t{y} * side_;
      for (std::uint32_t k = first_[row + x0]; k < first_[row + x1 + 1]; ++k) {
        const Vertex v = corners_[in_cells_[k]].v;
        const Position& p = points_[v];
        if (p[0] < left || p[0] > right || p[1] < low || p[1] > high) continue;
        if (v == va || v == vb || v == vc) continue;
        for (Corner i = in_cells_[k]; i != kNone; i = corners_[i].twin) {
          if (!corners_[i].reflex || corners_[i].removed) continue;
          if (points_.orient(va, vb, v) < 0 || points_.orient(vb, vc, v) < 0 || points_.orient(vc, va, v) < 0)
            break;
          if (!visit(i)) return;
        }
      }
    }
  }

  [[nodiscard]] Corner blocker(Corner a, Corner b, Corner c) const {
    Corner found = kNone;
    each_inside(a, b, c, [&](Corner i) {
      found = i;
      return false;
    });
    return found;
  }

  // --- Triangles
  // --------------------------------------------------------------------------------------------

  void emit(Corner a, Corner b, Corner c) {
    triangles_.push_back({corners_[a].v, corners_[b].v, corners_[c].v});
    ++counts_.ears;
  }

  void connect(Corner a, Corner b) {
    corners_[a].behind = b;
    corners_[b].before = a;
  }

  // Only convex corners become convex and no others reflex, as corners of a part are parts of its own.
  void refresh(Corner i) {
    if (corners_[i].reflex && turn(i) > 0) {
      corners_[i].reflex = false;
      wake(i);
    }
    look_at(i);
  }

  void cut(Corner a, Corner b, Corner c) {
    emit(a, b, c);
    corners_[b].removed = true;
    wake(b);
    connect(a, c);
    refresh(a);
    refresh(c);
  }

  /// The second construction of §2.1.2: side ab with the reflex corner of the triangle abc nearest to it, as
  /// the angle at a sees it, makes a triangle that holds no vertex, and splits the polygon. The angle, and
  /// not the height, decides: below a vertex of less height an edge may pass that enters by ac.
  void join(Corner a, Corner b, Corner c) {
    Corner nearest = kNone;
    each_inside(a, b, c, [&](Corner i) {
      if (!in_cone(i, corners_[a].v) || !in_cone(i, corners_[b].v)) return true;
      if (nearest == kNone || nearer(a, i, nearest)) nearest = i;
      return true;
    });
    const Corner r = nearest;
    if (r == kNone) throw std::logic_error("holdfast: no corner sees the side of a triangle that holds some");
    triangles_.push_back({corners_[a].v, corners_[b].v, corners_[r].v});
    ++counts_.joined;
    // One part is b, c, ..., r; the other one r', ..., a, with a corner of its own at r.
    const auto other = static_cast<Corner>(corners_.size());
    Place place = corners_[r];
    place.before = a;
    place.waiting = kNone;
    corners_.push_back(place);
    corners_[r].twin = other;
    if (corners_[other].behind == a) {  // a part of two corners, which is an edge
      corners_[a].behind = other;
    } else {
      corners_[corners_[other].behind].before = other;
      connect(a, other);
    }
    connect(r, b);
    close(a, other);
    close(r, b);
  }

  /// Whether the direction from a reflex corner to a vertex does not leave the polygon.
  [[nodiscard]] bool in_cone(Corner i, Vertex to) const {
    const Vertex v = corners_[i].v, before = corners_[corners_[i].before].v,
                 behind = corners_[corners_[i].behind].v;
    return points_.orient(v, before, to) <= 0 || points_.orient(v, to, behind) <= 0;
  }

  /// Whether, from corner a, reflex corner i comes before j when one turns from the side behind a inward.
  [[nodiscard]] bool nearer(Corner a, Corner i, Corner j) const {
    const Vertex va = corners_[a].v, vi = corners_[i].v, vj = corners_[j].v;
    const int side = points_.orient(va, vi, vj);
    return side != 0 ? side > 0 : points_.between(va, vj, vi);
  }

  void close(Corner i, Corner j) {
    if (corners_[j].behind == i) {
      for (const Corner k : {i, j}) {
        corners_[k].removed = true;
        wake(k);
      }
      return;
    }
    refresh(i);
    refresh(j);
  }

  const Points& points_;
  PlaneEars choice_;
  std::vector<std::array<Vertex, 3>>& triangles_;
  EarCounts& counts_;
  std::vector<Place> corners_;
  std::vector<Candidate> candidates_;
  std::vector<Waiting> waiting_;
  std::uint32_t side_ = 0;
  std::optional<Grid> grid_;
  std::vector<std::uint32_t> first_;
  std::vector<Corner> in_cells_;
};

}  // namespace

void cut_ears(const Points& points, std::span<const Vertex> walk, PlaneEars choice,
              std::vector<std::array<Vertex, 3>>& triangles, EarCounts& counts) {
  Clipper(points, walk, choice, triangles, counts).run();
}

}  // namespace holdfast::plane
