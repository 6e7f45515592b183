// A sweep over points and segments, from left to right and, on one vertical line, upwards.
#include "plane/sweep.h"

#include <algorithm>
#include <numeric>
#include <set>

namespace holdfast::plane {
namespace {

class Sweep {
 public:
  Sweep(const Points& points, const std::vector<Ends>& segments)
      : points_(points), ends_(segments), helper_(segments.size()), status_(Above{this}) {
    part_.resize(points.size());
    std::iota(part_.begin(), part_.end(), Vertex{0});
    for (Ends& e : ends_) {
      if (points_.compare(e[0], e[1]) > 0) std::swap(e[0], e[1]);
      unite(e[0], e[1]);
    }
  }

  [[nodiscard]] bool run(const Poll& poll) {
    order_points();
    list_starts();
    for (std::size_t i = 0; i < order_.size(); ++i) {
      if (i % 4096 == 0 && poll) poll(static_cast<double>(i) / static_cast<double>(order_.size()));
      if (i > 0 && points_.compare(order_[i - 1], order_[i]) == 0) return false;
      if (!pass(order_[i])) return false;
    }
    return true;
  }

  std::vector<Ends> links;

 private:
  using Item = std::uint32_t;  // a segment

  // Order from below of what the sweep line crosses.
  struct Above {
    using is_transparent = void;
    const Sweep* sweep;
    // Two segments that the line crosses, of which neither is crossed by the other.
    bool operator()(Item s, Item t) const {
      if (s == t) return false;
      const Ends &p = sweep->ends_[s], &q = sweep->ends_[t];
      if (p[0] == q[0]) return sweep->points_.orient(p[0], p[1], q[1]) > 0;
      if (sweep->points_.compare(p[0], q[0]) > 0) return sweep->points_.orient(q[0], q[1], p[0]) < 0;
      return sweep->points_.orient(p[0], p[1], q[0]) > 0;
    }
    // Segment s is below the point.
    bool operator()(Item s, const Vertex* v) const {
      return sweep->points_.orient(sweep->ends_[s][0], sweep->ends_[s][1], *v) > 0;
    }
  };
  using Status = std::set<Item, Above>;

  // --- Parts of the graph: trees of disjoint sets, with path halving -----------------------------------

  Vertex part_of(Vertex v) {
    while (part_[v] != v) v = part_[v] = part_[part_[v]];
    return v;
  }
  /// False where both are in one part already.
  bool unite(Vertex v, Vertex w) {
    v = part_of(v);
    w = part_of(w);
    if (v == w) return false;
    part_[std::max(v, w)] = std::min(v, w);
    return true;
  }

  void order_points() {
    order_.resize(points_.size());
    std::iota(order_.begin(), order_.end(), Vertex{0});
    std::sort(order_.begin(), order_.end(), [&](Vertex v, Vertex w) { return points_.compare(v, w) < 0; });
  }

  // Segments by their first ends.
  void list_starts() {
    first_.assign(points_.size() + 1, 0);
    for (const Ends& e : ends_) ++first_[e[0] + std::size_t{1}];
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    starts_.resize(ends_.size());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for (Item s = 0; s < ends_.size(); ++s) starts_[next[ends_[s][0]]++] = s;
  }

  // False where two segments have a point in common other than a common end.
  [[nodiscard]] bool fit(Item s, Item t) const {
    const Ends &p = ends_[s], &q = ends_[t];
    const int c = points_.orient(p[0], p[1], q[0]), d = points_.orient(p[0], p[1], q[1]);
    if (c * d > 0) return true;
    const int a = points_.orient(q[0], q[1], p[0]), b = points_.orient(q[0], q[1], p[1]);
    if (a * b > 0) return true;
    if (c * d < 0 && a * b < 0) return false;
    // On one line: from the later of the first ends to the earlier of the last ones.
    if (c == 0 && d == 0) {
      const Vertex low = points_.compare(p[0], q[0]) > 0 ? p[0] : q[0];
      const Vertex high = points_.compare(p[1], q[1]) < 0 ? p[1] : q[1];
      return points_.compare(low, high) >= 0;
    }
    // One end at most touches: it must be an end of both.
    return p[0] == q[0] || p[0] == q[1] || p[1] == q[0] || p[1] == q[1];
  }

  bool pass(Vertex v) {
    // What ends here stands together, and above what is below v.
    auto it = status_.lower_bound(&v);
    bool ends = false;
    while (it != status_.end() && points_.orient(ends_[*it][0], ends_[*it][1], v) == 0) {
      if (ends_[*it][1] != v) return false;  // v lies inside it
      it = status_.erase(it);
      ends = true;
    }
    const bool has_below = it != status_.begin();
    const Item below = has_below ? *std::prev(it) : 0;
    // The last vertex that came between the two segments is seen from v. A part is linked by its leftmost
    // vertex; further links would only make cycles, outside of all faces, too.
    if (!ends && has_below && it != status_.end() && unite(helper_[below], v))
      links.push_back({helper_[below], v});
    if (has_below) helper_[below] = v;
    return start_segments(v, it, has_below, below);
  }

  bool start_segments(Vertex v, Status::iterator above, bool has_below, Item below) {
    Item* const first = starts_.data() + first_[v];
    Item* const last = starts_.data() + first_[v + std::size_t{1}];
    if (first == last) return !has_below || above == status_.end() || fit(below, *above);
    std::sort(first, last, [&](Item s, Item t) { return points_.orient(v, ends_[s][1], ends_[t][1]) > 0; });
    for (Item* s = first; s + 1 < last; ++s)
      if (points_.orient(v, ends_[s[0]][1], ends_[s[1]][1]) == 0) return false;
    if (has_below && !fit(below, *first)) return false;
    if (above != status_.end() && !fit(last[-1], *above)) return false;
    for (Item* s = first; s < last; ++s) {
      helper_[*s] = v;
      status_.emplace_hint(above, *s);
    }
    return true;
  }

  const Points& points_;
  std::vector<Ends> ends_;  // in the order of the sweep
  std::vector<Vertex> part_;
  std::vector<Vertex> helper_;  // of what is just above a segment, the last vertex that came
  std::vector<Vertex> order_;
  std::vector<std::uint32_t> first_;
  std::vector<Item> starts_;
  Status status_;
};

}  // namespace

std::optional<std::vector<Ends>> sweep(const Points& points, const std::vector<Ends>& segments,
                                       const Poll& poll) {
  Sweep sweep(points, segments);
  if (!sweep.run(poll)) return std::nullopt;
  return std::move(sweep.links);
}

}  // namespace holdfast::plane
