// Triangles of a polygon by cutting off its corners.
//
// Corners belong to a closed walk round a face; several may lie at one vertex. Corner b, between corners a
// and c, is an ear if abc is positive and contains no vertex of the walk but a, b and c, not even on its
// sides: then no edge can enter it, because an edge that enters through ac would have to leave through ac.
// Only corners that are reflex or straight need testing: nothing of the walk lies beyond the vertex in abc
// that is furthest from ac, so its corner on that side has 180 degrees or more. Vertices are numbered from
// left to right, so a set of them shows which may lie between the ends of a triangle.
#include "plane/ears.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

#include "plane/point_tree.h"
#include "plane/vertex_set.h"

namespace holdfast::plane {
namespace {

using Corner = std::uint32_t;
constexpr Corner kNone = ~Corner{0};

/// What lies outside the side from corner i to the next: the edge of a triangle, or a side of the walk.
class Beyond {
 public:
  [[nodiscard]] static Beyond triangle(EdgeCode e) { return Beyond(e, false); }
  [[nodiscard]] static Beyond walk(Corner side) { return Beyond(side, true); }
  [[nodiscard]] bool is_walk() const { return is_walk_; }
  [[nodiscard]] std::uint32_t number() const { return number_; }

 private:
  Beyond(std::uint32_t number, bool is_walk) : number_(number), is_walk_(is_walk) {}
  std::uint32_t number_;
  bool is_walk_;
};

class Clipper {
 public:
  Clipper(const Points& points, PlaneEars choice, EarMesh& ears)
      : points_(points), choice_(choice), ears_(ears), reflex_(points), first_at_(points.size()) {}

  void cut(std::span<const Vertex> walk, std::span<const std::uint32_t> sides) {
    sides_ = sides;
    take_in(walk);
    cut_all();
  }

 private:
  struct Place {
    Vertex v;
    Corner before, behind;
    Beyond beyond;  // outside the side to the next corner
    bool reflex = false, removed = false, queued = false;
    std::uint32_t waiting = kNone;  // first in the list of corners that have this one as witness
    Corner witness = kNone;         // a corner in this corner's triangle when it was last examined
    std::uint32_t item = kNone;     // in the tree, for the first reflex corner at a vertex
    Corner twin = kNone;            // another corner at the vertex that is or was reflex
  };
  struct Waiting {
    Corner corner;
    std::uint32_t next;
  };

  void take_in(std::span<const Vertex> walk) {
    const auto n = static_cast<Corner>(walk.size());
    corners_.clear();
    candidates_.clear();
    queue_.clear();
    late_queue_.clear();
    next_ = next_late_ = 0;
    waiting_.clear();
    tree_.reset();
    corners_.reserve(n);
    for (Corner i = 0; i < n; ++i)
      corners_.push_back({walk[i], i > 0 ? i - 1 : n - 1, i + 1 < n ? i + 1 : 0, Beyond::walk(i)});
    for (Corner i = 0; i < n; ++i)
      if (turn(i) <= 0) mark_reflex(i);
    for (Corner i = 0; i < n; ++i) look_at(i);
  }

  void cut_all() {
    const std::size_t before = ears_.mesh.size(), corners = corners_.size();
    for (Corner b = take(); b != kNone; b = take()) {
      if (corners_[b].removed || corners_[b].reflex) continue;
      const Corner a = corners_[b].before, c = corners_[b].behind;
      if (a == corners_[c].behind) {  // the last triangle of a part
        meet(code(emit(a, b, c), 1), corners_[c].beyond);
        for (const Corner i : {a, b, c}) remove(i);
        continue;
      }
      // Even with new neighbours, corner b waits for its witness.
      if (const Corner witness = corners_[b].witness; witness != kNone && blocks(witness, a, b, c)) continue;
      const std::optional<Corner> found = blocker(a, b, c);
      if (!found) {
        postpone(b);
        continue;
      }
      const Corner witness = *found;
      if (witness == kNone) {
        cut(a, b, c);
      } else if (choice_ == PlaneEars::join) {
        join(a, b, c);
      } else {
        // With these neighbours the corner is no ear until the witness is cut off or becomes convex.
        corners_[b].witness = witness;
        waiting_.push_back({b, corners_[witness].waiting});
        corners_[witness].waiting = static_cast<std::uint32_t>(waiting_.size() - 1);
      }
    }
    if (ears_.mesh.size() - before != corners - 2)
      throw std::logic_error("holdfast: a polygon is left without an ear");
  }

  [[nodiscard]] int turn(Corner i) const {
    const Place& p = corners_[i];
    return points_.orient(corners_[p.before].v, p.v, corners_[p.behind].v);
  }

  // --- Which corner comes next

  /// The least height of a corner's triangle over its longest side, approximately.
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
    return q > 0 ? q : 0;  // also if the result is NaN
  }

  struct Candidate {
    double quality;
    Corner corner;
    bool operator<(const Candidate& other) const {
      return quality != other.quality ? quality < other.quality : corner > other.corner;
    }
  };

  void look_at(Corner i) {
    Place& p = corners_[i];
    if (p.reflex || p.removed) return;
    if (choice_ == PlaneEars::best) {
      candidates_.push_back({quality(i), i});
      std::push_heap(candidates_.begin(), candidates_.end());
    } else if (!p.queued) {
      p.queued = true;
      queue_.push_back(i);
    }
  }

  /// The best corner, or the one that has waited longest: corners with new neighbours join the end of the
  /// queue, so that corners are cut off all round and triangles stay small for long.
  Corner take() {
    if (choice_ != PlaneEars::best) {
      may_wait_ = next_ < queue_.size();
      if (!may_wait_ && next_late_ == late_queue_.size()) return kNone;
      const Corner b = may_wait_ ? queue_[next_++] : late_queue_[next_late_++];
      corners_[b].queued = false;
      return b;
    }
    while (!candidates_.empty()) {
      std::pop_heap(candidates_.begin(), candidates_.end());
      const Candidate candidate = candidates_.back();
      candidates_.pop_back();
      // If its neighbours have changed, the corner has a newer entry.
      if (candidate.quality == quality(candidate.corner)) return candidate.corner;
    }
    return kNone;
  }

  /// The corner waits until the first queue is empty.
  void postpone(Corner b) {
    corners_[b].queued = true;
    late_queue_.push_back(b);
  }

  void wake(Corner witness) {
    std::uint32_t i = corners_[witness].waiting;
    corners_[witness].waiting = kNone;
    for (; i != kNone; i = waiting_[i].next) look_at(waiting_[i].corner);
  }

  // --- Corners in a triangle

  [[nodiscard]] bool stands_reflex(Corner i) const { return corners_[i].reflex && !corners_[i].removed; }

  void mark_reflex(Corner i) {
    const Vertex v = corners_[i].v;
    corners_[i].reflex = true;
    if (reflex_.contains(v)) corners_[i].twin = first_at_[v];
    first_at_[v] = i;
    reflex_.insert(v);
  }

  /// Called for a reflex corner that is removed or becomes convex; the vertex may have another one.
  void take_out(Corner i) {
    const Vertex v = corners_[i].v;
    for (Corner j = first_at_[v]; j != kNone; j = corners_[j].twin)
      if (stands_reflex(j)) return;
    reflex_.erase(v);
    if (tree_) tree_->erase(corners_[first_at_[v]].item);
  }

  [[nodiscard]] const PointTree& tree() {
    if (!tree_) {
      planted_.clear();
      for (std::size_t v = reflex_.from(0); v != VertexSet::none; v = reflex_.from(v + 1)) {
        corners_[first_at_[v]].item = static_cast<std::uint32_t>(planted_.size());
        planted_.push_back(static_cast<Vertex>(v));
      }
      tree_.emplace(points_, planted_);
    }
    return *tree_;
  }

  /// Whether the vertex lies in the closed triangle but is not one of its corners.
  [[nodiscard]] bool is_inside(Vertex v, Vertex a, Vertex b, Vertex c) const {
    return v != a && v != b && v != c && points_.orient(c, a, v) >= 0 && points_.orient(a, b, v) >= 0 &&
           points_.orient(b, c, v) >= 0;
  }
  [[nodiscard]] bool blocks(Corner i, Corner a, Corner b, Corner c) const {
    return stands_reflex(i) && is_inside(corners_[i].v, corners_[a].v, corners_[b].v, corners_[c].v);
  }

  /// Calls `visit` for the reflex corners at a vertex in the triangle until it returns false.
  template <typename Visit>
  bool go_on_at(Vertex v, Vertex a, Vertex b, Vertex c, Visit&& visit) const {
    if (!is_inside(v, a, b, c)) return true;
    for (Corner i = first_at_[v]; i != kNone; i = corners_[i].twin)
      if (stands_reflex(i) && !visit(i)) return false;
    return true;
  }

  /// Calls `visit` for reflex corners in a triangle, but not at its own vertices.
  template <typename Visit>
  void each_inside(Corner a, Corner b, Corner c, Visit&& visit) {
    const Vertex va = corners_[a].v, vb = corners_[b].v, vc = corners_[c].v;
    tree().each_near(va, vb, vc,
                     [&](std::uint32_t item) { return go_on_at(planted_[item], va, vb, vc, visit); });
  }

  /// A reflex corner in the triangle, or kNone. If few vertices are numbered between its left and right ends,
  /// their heights decide. Otherwise the first few reflex ones among them are tested, which is usually all,
  /// and then the tree is used. Returns nullopt for a wide triangle that may wait: once other corners are cut
  /// off, little may be left in it.
  [[nodiscard]] std::optional<Corner> blocker(Corner a, Corner b, Corner c) {
    constexpr int kFew = 2, kWide = 4;  // wide: a quarter of all vertices between its ends
    constexpr std::size_t kShort = 256;
    const Vertex va = corners_[a].v, vb = corners_[b].v, vc = corners_[c].v;
    const Vertex left = std::min(std::min(va, vb), vc), right = std::max(std::max(va, vb), vc);
    std::size_t i = reflex_.from(left + std::size_t{1});
    if (i >= right) return kNone;
    const double ya = points_[va][1], yb = points_[vb][1], yc = points_[vc][1];
    const double low = std::min(std::min(ya, yb), yc), high = std::max(std::max(ya, yb), yc);
    Corner found = kNone;
    const auto take_first = [&](Corner corner) {
      found = corner;
      return false;
    };
    const bool may_wait = may_wait_ && right - left > points_.size() / kWide;
    if (!may_wait && right - i <= kShort) {
      reflex_.each_between(static_cast<Vertex>(i), right, low, high,
                           [&](Vertex v) { return go_on_at(v, va, vb, vc, take_first); });
      return found;
    }
    for (int few = kFew; i < right && few-- > 0; i = reflex_.from(i + 1)) {
      const auto v = static_cast<Vertex>(i);
      if (points_[v][1] >= low && points_[v][1] <= high && !go_on_at(v, va, vb, vc, take_first)) return found;
    }
    if (i >= right) return kNone;
    if (may_wait) return std::nullopt;
    each_inside(a, b, c, take_first);
    return found;
  }

  // --- Triangles

  /// Records what lies beyond a side of a triangle.
  void meet(EdgeCode e, Beyond beyond) {
    if (beyond.is_walk())
      ears_.sides[sides_[beyond.number()]] = e;
    else
      ears_.mesh.join(e, beyond.number());
  }

  /// The triangle on side ab with corner c.
  std::size_t make_triangle(Corner a, Corner b, Corner c) {
    const std::size_t t = ears_.mesh.size();
    ears_.mesh.all().push_back({{corners_[a].v, corners_[b].v, corners_[c].v}, {kNoEdge, kNoEdge, kNoEdge}});
    meet(code(t, 2), corners_[a].beyond);
    return t;
  }

  /// The triangle on sides ab and bc.
  std::size_t emit(Corner a, Corner b, Corner c) {
    const std::size_t t = make_triangle(a, b, c);
    meet(code(t, 0), corners_[b].beyond);
    ++ears_.counts.ears;
    return t;
  }

  void remove(Corner i) {
    corners_[i].removed = true;
    if (corners_[i].reflex) take_out(i);
  }

  void connect(Corner a, Corner b, EdgeCode beyond) {
    corners_[a].behind = b;
    corners_[a].beyond = Beyond::triangle(beyond);
    corners_[b].before = a;
  }

  // A corner only turns from reflex to convex, because each new part has corners of its own.
  void refresh(Corner i) {
    if (corners_[i].reflex && turn(i) > 0) {
      corners_[i].reflex = false;
      take_out(i);
      wake(i);
    }
    look_at(i);
  }

  void cut(Corner a, Corner b, Corner c) {
    const std::size_t t = emit(a, b, c);
    remove(b);
    wake(b);
    connect(a, c, code(t, 1));
    refresh(a);
    refresh(c);
  }

  /// The second construction of §2.1.2: side ab and the reflex corner of abc with the smallest angle at a
  /// make a triangle that contains no vertex, and it splits the polygon. The angle decides, not the height:
  /// an edge that enters through ac may pass below the vertex of least height.
  void join(Corner a, Corner b, Corner c) {
    Corner nearest = kNone;
    each_inside(a, b, c, [&](Corner i) {
      if (!in_cone(i, corners_[a].v) || !in_cone(i, corners_[b].v)) return true;
      if (nearest == kNone || nearer(a, i, nearest)) nearest = i;
      return true;
    });
    const Corner r = nearest;
    if (r == kNone) throw std::logic_error("holdfast: no corner sees the side of a triangle that holds some");
    const std::size_t t = make_triangle(a, b, r);
    ++ears_.counts.joined;
    // One part is b, c, ..., r; the other r', ..., a, with its own corner at r.
    const auto other = static_cast<Corner>(corners_.size());
    Place place = corners_[r];
    place.before = a;
    place.waiting = kNone;
    place.queued = false;
    corners_.push_back(place);  // which also copies r's twin
    corners_[r].twin = other;
    // If r is before a, this part has two corners and is an edge.
    corners_[corners_[other].behind].before = other;
    connect(a, other, code(t, 1));
    connect(r, b, code(t, 0));
    close(a, other);
    close(r, b);
  }

  /// Whether the direction from a reflex corner to a vertex does not leave the polygon.
  [[nodiscard]] bool in_cone(Corner i, Vertex to) const {
    const Vertex v = corners_[i].v, before = corners_[corners_[i].before].v,
                 behind = corners_[corners_[i].behind].v;
    return points_.orient(v, before, to) <= 0 || points_.orient(v, to, behind) <= 0;
  }

  /// Whether the turn at corner a, from its next side inward, meets reflex corner i before j.
  [[nodiscard]] bool nearer(Corner a, Corner i, Corner j) const {
    const Vertex va = corners_[a].v, vi = corners_[i].v, vj = corners_[j].v;
    const int side = points_.orient(va, vi, vj);
    return side != 0 ? side > 0 : points_.between(va, vj, vi);
  }

  void close(Corner i, Corner j) {
    if (corners_[j].behind == i) {  // an edge, with a triangle on the side that was connected
      meet(corners_[i].beyond.number(), corners_[j].beyond);
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
  EarMesh& ears_;
  VertexSet reflex_;              // vertices with a reflex corner
  std::vector<Corner> first_at_;  // by vertex, the first corner that is or was reflex
  // The current face:
  std::span<const std::uint32_t> sides_;  // edges of the graph, along the walk
  std::vector<Place> corners_;
  std::vector<Candidate> candidates_;       // a heap, for `best`
  std::vector<Corner> queue_, late_queue_;  // for the other choices
  std::size_t next_ = 0, next_late_ = 0;    // in the queues
  bool may_wait_ = false;  // whether the current corner may wait until the first queue is empty
  std::vector<Waiting> waiting_;
  std::vector<Vertex> planted_;    // in the tree
  std::optional<PointTree> tree_;  // of reflex corners, once it is asked for
};

}  // namespace

EarMesh cut_ears(const Points& points, const Walks& faces, std::size_t edges, PlaneEars choice,
                 const std::function<bool(std::size_t)>& wanted) {
  EarMesh ears(edges);
  ears.mesh.all().reserve(faces.vertices.size() - 2 * faces.count());
  Clipper clipper(points, choice, ears);
  for (std::size_t f = 0; f < faces.count(); ++f) {
    if (!wanted(f)) continue;
    const std::size_t first = faces.first[f], count = faces.first[f + 1] - first;
    clipper.cut(std::span(faces.vertices).subspan(first, count),
                std::span(faces.sides).subspan(first, count));
  }
  return ears;
}

Triangles join_faces(EarMesh&& ears, std::size_t first_segment) {
  Triangles mesh = std::move(ears.mesh);
  for (std::size_t i = 0; 2 * i < ears.sides.size(); ++i) {
    EdgeCode e = ears.sides[2 * i], f = ears.sides[2 * i + 1];
    if (e == kNoEdge) std::swap(e, f);
    if (e == kNoEdge) continue;
    if (f != kNoEdge) mesh.join(e, f);
    if (i >= first_segment) mesh.constrain(e);
  }
  return mesh;
}

}  // namespace holdfast::plane
