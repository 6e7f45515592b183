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

#include "plane/point_tree.h"

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
    plant_tree();
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
        for (const Corner i : {a, b, c}) remove(i);
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
    std::uint32_t item = kNone;     // in the tree, if it was reflex in the beginning
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

  void plant_tree() {
    std::vector<Vertex> reflex;
    for (Corner i = 0; i < corners_.size(); ++i) {
      if (!corners_[i].reflex) continue;
      corners_[i].item = static_cast<std::uint32_t>(reflex.size());
      corner_of_.push_back(i);
      reflex.push_back(corners_[i].v);
    }
    tree_.emplace(points_, reflex);
  }

  /// Of a corner that is removed, or not reflex any more. Twins stand for each other.
  void take_out(Corner i) {
    if (corners_[i].item != kNone && corners_[i].twin == kNone) tree_->erase(corners_[i].item);
  }

  /// Calls `visit` for reflex corners in the triangle, but those at its own vertices, until it returns false.
  template <typename Visit>
  void each_inside(Corner a, Corner b, Corner c, Visit&& visit) const {
    const Vertex va = corners_[a].v, vb = corners_[b].v, vc = corners_[c].v;
    tree_->each_near(va, vb, vc, [&](std::uint32_t item) {
      const Vertex v = corners_[corner_of_[item]].v;
      if (v == va || v == vb || v == vc) return true;
      if (points_.orient(va, vb, v) < 0 || points_.orient(vb, vc, v) < 0 || points_.orient(vc, va, v) < 0)
        return true;
      for (Corner i = corner_of_[item]; i != kNone; i = corners_[i].twin)
        if (corners_[i].reflex && !corners_[i].removed && !visit(i)) return false;
      return true;
    });
  }

  [[nodiscard]] Corner blocker(Corner a, Corner b, Corner c) const {
    Corner found = kNone;
    each_inside(a, b, c, [&](Corner i) {
      found = i;
      return false;
    });
    return found;
  }

  // --- Triangles ---------------------------------------------------------------------------------------

  void emit(Corner a, Corner b, Corner c) {
    triangles_.push_back({corners_[a].v, corners_[b].v, corners_[c].v});
    ++counts_.ears;
  }

  void remove(Corner i) {
    corners_[i].removed = true;
    take_out(i);
  }

  void connect(Corner a, Corner b) {
    corners_[a].behind = b;
    corners_[b].before = a;
  }

  // Only convex corners become convex and no others reflex, as corners of a part are parts of its own.
  void refresh(Corner i) {
    if (corners_[i].reflex && turn(i) > 0) {
      corners_[i].reflex = false;
      take_out(i);
      wake(i);
    }
    look_at(i);
  }

  void cut(Corner a, Corner b, Corner c) {
    emit(a, b, c);
    remove(b);
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
    place.item = kNone;
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
        remove(k);
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
  std::vector<Corner> corner_of_;  // of the tree's items
  std::optional<PointTree> tree_;  // of reflex corners
};

}  // namespace

void cut_ears(const Points& points, std::span<const Vertex> walk, PlaneEars choice,
              std::vector<std::array<Vertex, 3>>& triangles, EarCounts& counts) {
  Clipper(points, walk, choice, triangles, counts).run();
}

}  // namespace holdfast::plane
