// Finds what makes points and segments in the plane invalid: first defects of single entities, then of pairs,
// found by a tree of boxes.
#include "plane/defects.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "text/decimal.h"

namespace holdfast::plane {
namespace {

struct Box {
  Position low, high;
  [[nodiscard]] bool meets(const Box& other) const {
    return low[0] <= other.high[0] && other.low[0] <= high[0] && low[1] <= other.high[1] &&
           other.low[1] <= high[1];
  }
};

/// Boxes in a balanced binary tree: node k has the children 2 k + 1 and 2 k + 2, its items are contiguous.
class BoxTree {
 public:
  explicit BoxTree(std::vector<Box> boxes) : boxes_(std::move(boxes)), order_(boxes_.size()) {
    std::iota(order_.begin(), order_.end(), Index{0});
    if (!order_.empty()) build(0, 0, order_.size());
  }

  /// Calls `visit` for each item whose box meets `box`.
  template <typename Visit>
  void meet(const Box& box, Visit&& visit) const {
    if (!order_.empty()) meet(0, 0, order_.size(), box, visit);
  }

 private:
  static constexpr std::size_t kLeaf = 4;

  void build(std::size_t node, std::size_t first, std::size_t last) {
    Box all = boxes_[order_[first]];
    for (std::size_t i = first + 1; i < last; ++i)
      for (std::size_t k = 0; k < 2; ++k) {
        all.low[k] = std::min(all.low[k], boxes_[order_[i]].low[k]);
        all.high[k] = std::max(all.high[k], boxes_[order_[i]].high[k]);
      }
    if (nodes_.size() <= node) nodes_.resize(node + 1);
    nodes_[node] = all;
    if (last - first <= kLeaf) return;
    const std::size_t axis = all.high[0] / 2 - all.low[0] / 2 < all.high[1] / 2 - all.low[1] / 2 ? 1 : 0;
    const auto middle = order_.begin() + static_cast<std::ptrdiff_t>((first + last) / 2);
    std::nth_element(order_.begin() + static_cast<std::ptrdiff_t>(first), middle,
                     order_.begin() + static_cast<std::ptrdiff_t>(last), [&](Index i, Index j) {
                       return boxes_[i].low[axis] / 2 + boxes_[i].high[axis] / 2 <
                              boxes_[j].low[axis] / 2 + boxes_[j].high[axis] / 2;
                     });
    build(2 * node + 1, first, (first + last) / 2);
    build(2 * node + 2, (first + last) / 2, last);
  }

  template <typename Visit>
  void meet(std::size_t node, std::size_t first, std::size_t last, const Box& box, Visit&& visit) const {
    if (!nodes_[node].meets(box)) return;
    if (last - first <= kLeaf) {
      for (std::size_t i = first; i < last; ++i)
        if (boxes_[order_[i]].meets(box)) visit(order_[i]);
      return;
    }
    meet(2 * node + 1, first, (first + last) / 2, box, visit);
    meet(2 * node + 2, (first + last) / 2, last, box, visit);
  }

  std::vector<Box> boxes_, nodes_;
  std::vector<Index> order_;
};

class Diagnosis {
 public:
  Diagnosis(const Plane& plane, std::size_t most, const Poll& poll)
      : plane_(plane), most_(most), poll_(poll), points_(plane.points) {}

  std::vector<Defect> run() {
    find_not_finite();
    find_repeated_points();
    find_flawed_segments();
    const BoxTree tree = tree_of_segments();
    find_points_in_segments(tree);
    find_pairs(tree);
    find_places_on_segments(tree);
    return std::move(defects_);
  }

 private:
  [[nodiscard]] std::string number(std::size_t i) const {
    return std::to_string(static_cast<std::int64_t>(i) + plane_.base);
  }
  [[nodiscard]] std::string segment_text(Index s) const {
    return "segment " + number(s) + " (" + number(plane_.segments[s][0]) + "-" +
           number(plane_.segments[s][1]) + ")";
  }
  static std::string place(const PlanePoint& p) { return "(" + decimal(p[0]) + ", " + decimal(p[1]) + ")"; }
  [[nodiscard]] std::string point_text(Index v) const {
    return "point " + number(v) + " " + place(plane_.points[v]);
  }

  void add(DefectKind kind, std::vector<Index> points, std::vector<Index> segments,
           const std::vector<PlanePoint>& where, std::string message) {
    if (count_[kind]++ >= most_) return;
    Defect defect{kind, std::move(points), {}, std::move(segments), {}, std::move(message)};
    for (const PlanePoint& p : where) defect.where.push_back({p[0], p[1], 0});
    defects_.push_back(std::move(defect));
  }

  void find_not_finite() {
    for (Index v = 0; v < plane_.points.size(); ++v) {
      const PlanePoint& p = plane_.points[v];
      const bool finite = std::isfinite(p[0]) && std::isfinite(p[1]);
      finite_.push_back(finite);
      if (!finite)
        add(DefectKind::non_finite_coordinate, {v}, {}, {},
            point_text(v) + " is not finite: give it two finite coordinates, or remove it");
    }
  }

  void find_repeated_points() {
    std::vector<Index> order;
    for (Index v = 0; v < plane_.points.size(); ++v)
      if (finite_[v]) order.push_back(v);
    std::sort(order.begin(), order.end(), [&](Index v, Index w) {
      const int sign = points_.compare(v, w);
      return sign != 0 ? sign < 0 : v < w;
    });
    place_.resize(plane_.points.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
      const bool repeats = i > 0 && points_.compare(order[i - 1], order[i]) == 0;
      const Index first = repeats ? place_[order[i - 1]] : order[i];
      place_[order[i]] = first;
      if (repeats)
        add(DefectKind::repeated_vertex, {first, order[i]}, {}, {plane_.points[first]},
            "points " + number(first) + " and " + number(order[i]) + " are both at " +
                place(plane_.points[first]) + ": remove one of them");
    }
  }

  void find_flawed_segments() {
    for (Index s = 0; s < plane_.segments.size(); ++s) {
      const auto [a, b] = plane_.segments[s];
      for (const Index v : {a, b})
        if (v >= plane_.points.size())
          add(DefectKind::index_out_of_range, {}, {s}, {},
              "segment " + number(s) + " names point " + number(v) + ", but there are " +
                  std::to_string(plane_.points.size()) + " points");
      if (a >= plane_.points.size() || b >= plane_.points.size() || !finite_[a] || !finite_[b]) continue;
      if (place_[a] == place_[b])
        add(DefectKind::degenerate_segment, {a, b}, {s}, {plane_.points[a]},
            segment_text(s) + " has no length: remove it");
      else
        sound_.push_back(s);
    }
  }

  [[nodiscard]] Box box_of(Index s) const {
    const PlanePoint &a = plane_.points[plane_.segments[s][0]], &b = plane_.points[plane_.segments[s][1]];
    return {{std::min(a[0], b[0]), std::min(a[1], b[1])}, {std::max(a[0], b[0]), std::max(a[1], b[1])}};
  }

  [[nodiscard]] BoxTree tree_of_segments() const {
    std::vector<Box> boxes;
    for (const Index s : sound_) boxes.push_back(box_of(s));
    return BoxTree(std::move(boxes));
  }

  // There may be quadratically many pairs; the search ends at the most that is reported.

  void find_points_in_segments(const BoxTree& tree) {
    for (Index v = 0; v < plane_.points.size() && !is_full(DefectKind::vertex_in_segment); ++v) {
      if (v % 1024 == 0) tell_progress(v);
      if (!finite_[v] || place_[v] != v) continue;
      tree.meet({plane_.points[v], plane_.points[v]}, [&](Index i) { judge_point(v, sound_[i]); });
    }
  }

  void find_pairs(const BoxTree& tree) {
    std::vector<Index> others;
    std::size_t judged = 0;  // since the last poll
    for (std::size_t i = 0; i < sound_.size(); ++i) {
      others.clear();
      tree.meet(box_of(sound_[i]), [&](Index j) {
        if (j > i) others.push_back(sound_[j]);
      });
      judged += others.size() + 1;
      if (judged > 10'000) {
        tell_progress(plane_.points.size() + i);
        judged = 0;
      }
      std::sort(others.begin(), others.end());
      for (const Index other : others) {
        judge_pair(sound_[i], other);
        if (is_full(DefectKind::segments_cross) || is_full(DefectKind::segments_overlap)) return;
      }
    }
  }

  void tell_progress(std::size_t judged) const {
    const std::size_t all = sound_.size() + plane_.points.size();
    if (poll_) poll_(static_cast<double>(judged) / static_cast<double>(all));
  }
  [[nodiscard]] bool is_full(DefectKind kind) const {
    const auto found = count_.find(kind);
    return found != count_.end() && found->second >= most_;
  }

  // A hole or seed on a segment lies in no region.
  void find_places_on_segments(const BoxTree& tree) {
    for (std::size_t i = 0; i < plane_.holes.size(); ++i)
      judge_place(tree, plane_.holes[i], "hole " + number(i), "that it shall empty");
    for (std::size_t i = 0; i < plane_.regions.size(); ++i)
      judge_place(tree, plane_.regions[i].where, "the point of region " + number(i), "that it is of");
  }

  void judge_place(const BoxTree& tree, const PlanePoint& p, const std::string& what, const char* purpose) {
    if (!std::isfinite(p[0]) || !std::isfinite(p[1])) return;
    const Vertex v = points_.add(p);
    std::optional<Index> on;
    tree.meet({p, p}, [&](Index i) {
      const auto [a, b] = plane_.segments[sound_[i]];
      const bool holds =
          points_.orient(a, b, v) == 0 &&
          (points_.between(a, b, v) || points_.compare(a, v) == 0 || points_.compare(b, v) == 0);
      if (holds && (!on || sound_[i] < *on)) on = sound_[i];
    });
    points_.shrink(plane_.points.size());
    if (!on) return;
    add(DefectKind::vertex_in_segment, {}, {*on}, {p},
        what + " " + place(p) + " lies on " + segment_text(*on) + ": move it into the region " + purpose);
  }

  void judge_point(Index v, Index s) {
    const auto [a, b] = plane_.segments[s];
    if (points_.orient(a, b, v) != 0 || !points_.between(a, b, v)) return;
    add(DefectKind::vertex_in_segment, {v}, {s}, {plane_.points[v]},
        point_text(v) + " lies inside " + segment_text(s) +
            ": split the segment at this point, or move the point");
  }

  void judge_pair(Index s, Index t) {
    const auto [a, b] = plane_.segments[s];
    const auto [c, d] = plane_.segments[t];
    const int sc = points_.orient(a, b, c), sd = points_.orient(a, b, d);
    if (sc == 0 && sd == 0) return judge_collinear(s, t);
    if (sc * sd >= 0 || points_.orient(c, d, a) * points_.orient(c, d, b) >= 0) return;
    const PlanePoint where = exact::nearest(
        exact::crossing(points_.rational(a), points_.rational(b), points_.rational(c), points_.rational(d)));
    add(DefectKind::segments_cross, {}, {s, t}, {where},
        segment_text(s) + " and " + segment_text(t) + " cross at " + place(where) +
            ": split both at a new point there");
  }

  void judge_collinear(Index s, Index t) {
    std::array<Index, 2> p = plane_.segments[s], q = plane_.segments[t];
    for (std::array<Index, 2>* ends : {&p, &q})
      if (points_.compare((*ends)[0], (*ends)[1]) > 0) std::swap((*ends)[0], (*ends)[1]);
    const Index low = points_.compare(p[0], q[0]) > 0 ? p[0] : q[0];
    const Index high = points_.compare(p[1], q[1]) < 0 ? p[1] : q[1];
    if (points_.compare(low, high) >= 0) return;
    const std::vector<PlanePoint> where{plane_.points[low], plane_.points[high]};
    if (points_.compare(p[0], q[0]) == 0 && points_.compare(p[1], q[1]) == 0)
      return add(DefectKind::segments_overlap, {}, {s, t}, where,
                 segment_text(t) + " is " + segment_text(s) + " again: remove one of them");
    add(DefectKind::segments_overlap, {}, {s, t}, where,
        segment_text(s) + " and " + segment_text(t) + " overlap from " + place(where[0]) + " to " +
            place(where[1]) + ": split the longer one, or remove one");
  }

  const Plane& plane_;
  std::size_t most_;
  const Poll& poll_;
  Points points_;
  std::vector<bool> finite_;
  std::vector<Index> place_;  // by point, the first point at the same place
  std::vector<Index> sound_;  // segments that can be part of a defective pair
  std::map<DefectKind, std::size_t> count_;
  std::vector<Defect> defects_;
};

}  // namespace

std::vector<Defect> find_defects(const Plane& plane, std::size_t most, const Poll& poll) {
  return Diagnosis(plane, most, poll).run();
}

}  // namespace holdfast::plane
