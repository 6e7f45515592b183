// A sweep over points and segments, from left to right and, on one vertical line, upwards.
#include "plane/sweep.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <optional>

#include "plane/sequence.h"

namespace holdfast::plane {
namespace {

class Sweep {
 public:
  Sweep(const Points& points, const std::vector<Ends>& segments)
      : points_(points),
        ends_(segments),
        helper_(segments.size()),
        status_(segments.size()),
        held_by_(segments.size()),
        seat_of_(segments.size()),
        ending_(points.size(), kNone) {
    part_.resize(points.size());
    std::iota(part_.begin(), part_.end(), Vertex{0});
    for (Ends& e : ends_) {
      if (e[0] > e[1]) std::swap(e[0], e[1]);
      unite(e[0], e[1]);
    }
  }

  [[nodiscard]] bool run(const Poll& poll) {
    list_starts();
    for (Vertex v = 0; v < points_.size(); ++v) {
      if (v % 4096 == 0 && poll) poll(static_cast<double>(v) / static_cast<double>(points_.size()));
      if (v > 0 && points_.compare(v - 1, v) == 0) return false;
      if (!pass(v)) return false;
    }
    return true;
  }

  std::vector<Ends> links;

 private:
  using Item = std::uint32_t;  // the number of a segment
  // A place in the status, numbered by the segment that first held it. If one segment ends at a vertex,
  // another one nearly always starts there and takes its seat.
  using Seat = std::uint32_t;
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};

  [[nodiscard]] int side(Item s, Vertex v) const { return points_.orient(ends_[s][0], ends_[s][1], v); }

  // --- Parts of the graph: disjoint-set trees with path halving

  Vertex part_of(Vertex v) {
    while (part_[v] != v) v = part_[v] = part_[part_[v]];
    return v;
  }
  /// Returns false if both are in one part already.
  bool unite(Vertex v, Vertex w) {
    v = part_of(v);
    w = part_of(w);
    if (v == w) return false;
    part_[std::max(v, w)] = std::min(v, w);
    return true;
  }

  // Lists segments by their first ends.
  void list_starts() {
    first_.assign(points_.size() + 1, 0);
    for (const Ends& e : ends_) ++first_[e[0] + std::size_t{1}];
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    starts_.resize(ends_.size());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for (Item s = 0; s < ends_.size(); ++s) starts_[next[ends_[s][0]]++] = s;
  }

  // False if two segments meet other than in a common end.
  [[nodiscard]] bool fit(Item s, Item t) const {
    const Ends &p = ends_[s], &q = ends_[t];
    if (p[0] == q[0]) return points_.orient(p[0], p[1], q[1]) != 0;
    if (p[1] == q[1]) return points_.orient(p[0], p[1], q[0]) != 0;
    const int c = points_.orient(p[0], p[1], q[0]), d = points_.orient(p[0], p[1], q[1]);
    if (c * d > 0) return true;
    const int a = points_.orient(q[0], q[1], p[0]), b = points_.orient(q[0], q[1], p[1]);
    if (a * b > 0) return true;
    if (c * d < 0 && a * b < 0) return false;
    // Collinear: the later first end against the earlier last end.
    if (c == 0 && d == 0) return std::max(p[0], q[0]) >= std::min(p[1], q[1]);
    // One end may touch, but only as an end of both.
    return p[0] == q[1] || p[1] == q[0];
  }

  /// The segments that end at a vertex are consecutive in the status, above those below the vertex.
  struct Ending {
    Seat first, last;
    std::size_t count = 0;
  };

  // Returns nullopt if the vertex lies inside a segment.
  std::optional<Ending> find_ending(Vertex v) {
    Ending found;
    if (const Item s = ending_[v]; s != kNone) {
      found.first = seat_of_[s];
      for (Seat i = status_.previous(found.first); i != status_.end() && side(held_by_[i], v) == 0;
           i = status_.previous(i))
        found.first = i;
    } else {
      found.first = status_.find([&](Seat i) { return side(held_by_[i], v) > 0; });
    }
    for (found.last = found.first; found.last != status_.end();
         found.last = status_.next(found.last), ++found.count) {
      const Item s = held_by_[found.last];
      if (ends_[s][1] == v) continue;
      if (side(s, v) == 0) return std::nullopt;
      break;
    }
    return found;
  }

  bool pass(Vertex v) {
    const std::optional<Ending> ending = find_ending(v);
    if (!ending) return false;
    const Seat lower = status_.previous(ending->first), upper = ending->last;
    const bool has_below = lower != status_.end(), has_above = upper != status_.end();
    const Item below = has_below ? held_by_[lower] : kNone;
    const Item above = has_above ? held_by_[upper] : kNone;
    // v sees the last vertex that came between the two segments. A part is linked by its leftmost vertex;
    // further links would only make cycles, even in the outer face.
    if (ending->count == 0 && has_below && has_above && unite(helper_[below], v))
      links.push_back({helper_[below], v});
    if (has_below) helper_[below] = v;
    return start_segments(v, *ending, below, above);
  }

  bool start_segments(Vertex v, const Ending& ending, Item below, Item above) {
    Item* const first = starts_.data() + first_[v];
    Item* const last = starts_.data() + first_[v + std::size_t{1}];
    if (first == last && below != kNone && above != kNone && !fit(below, above)) return false;
    std::sort(first, last, [&](Item s, Item t) { return points_.orient(v, ends_[s][1], ends_[t][1]) > 0; });
    for (Item* s = first; last - s > 1; ++s)
      if (points_.orient(v, ends_[s[0]][1], ends_[s[1]][1]) == 0) return false;
    if (first != last && below != kNone && !fit(below, *first)) return false;
    if (first != last && above != kNone && !fit(last[-1], above)) return false;
    seat(first, last, ending);
    for (Item* s = first; s < last; ++s) {
      helper_[*s] = v;
      ending_[ends_[*s][1]] = *s;
    }
    return true;
  }

  /// Gives the seats of ending segments to starting ones, both in order from below.
  void seat(const Item* first, const Item* last, const Ending& ending) {
    Seat it = ending.first;
    for (; first < last && it != ending.last; ++first, it = status_.next(it)) {
      held_by_[it] = *first;
      seat_of_[*first] = it;
    }
    while (it != ending.last) {
      const Seat next = status_.next(it);
      status_.erase(it);
      it = next;
    }
    for (; first < last; ++first) {
      held_by_[*first] = seat_of_[*first] = *first;
      status_.insert(ending.last, *first);
    }
  }

  const Points& points_;
  std::vector<Ends> ends_;  // in the order of the sweep
  std::vector<Vertex> part_;
  std::vector<Vertex> helper_;  // by segment, the last vertex that came just above it
  std::vector<std::uint32_t> first_;
  std::vector<Item> starts_;
  Sequence status_;            // the seats that the sweep line crosses, from below
  std::vector<Item> held_by_;  // by seat
  std::vector<Seat> seat_of_;  // by segment in the status
  std::vector<Item> ending_;   // by vertex, a segment in the status that ends there
};

}  // namespace

std::optional<std::vector<Ends>> sweep(const Points& points, const std::vector<Ends>& segments,
                                       const Poll& poll) {
  Sweep sweep(points, segments);
  if (!sweep.run(poll)) return std::nullopt;
  return std::move(sweep.links);
}

}  // namespace holdfast::plane
