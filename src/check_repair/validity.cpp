#include "check_repair/validity.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "check/findings.h"
#include "check/intersect.h"
#include "check_repair/sheets.h"
#include "exact/predicates.h"

namespace holdfast::checking {
namespace {

const char* kind_of(const Part& part) {
  return part.size == 3 ? "triangle" : part.size == 2 ? "segment" : "vertex";
}

class ComplexTest {
 public:
  ComplexTest(const Complex& surface, bool merges, std::span<const Index> sheet, const FoundInvalid& found,
              Pulse& pulse)
      : surface_(surface), merges_(merges), sheet_(sheet), found_(found), pulse_(pulse) {}

  void run() {
    if (!find_parts()) return;
    find_places();
    if (goes_on_) take_parts();
    if (goes_on_) find_repeats();
    if (goes_on_) find_meetings();
  }

 private:
  template <class Sentence>
  void report(Sentence&& sentence) {
    if (goes_on_) goes_on_ = found_(std::forward<Sentence>(sentence));
  }
  [[nodiscard]] const double* at(Index v) const { return surface_.vertices[v].data(); }
  [[nodiscard]] std::string told(const Part& part) const {
    return words(kind_of(part), part.id, part.span(), surface_.vertices);
  }

  /// False if some index is out of range.
  bool find_parts() {
    used_.assign(surface_.vertices.size(), 0);
    bool follows = true;
    const auto use = [&](const char* kind, std::size_t id, std::span<const Index> corners) {
      for (const Index v : corners) {
        if (v < used_.size()) {
          used_[v] = 1;
          continue;
        }
        follows = false;
        report([&] { return words(kind, id, corners, surface_.vertices) + " names no vertex"; });
      }
    };
    for (std::size_t f = 0; f < surface_.facets.size(); ++f) use("triangle", f, surface_.facets[f]);
    for (std::size_t s = 0; s < surface_.segments.size(); ++s) use("segment", s, surface_.segments[s]);
    for (std::size_t v = 0; v < used_.size(); ++v)
      if (const Point& p = surface_.vertices[v];
          used_[v] != 0 && !(std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]))) {
        follows = false;
        report([&] { return "vertex " + std::to_string(v) + " " + words(p) + " is not finite"; });
      }
    return follows;
  }

  /// Identifies used vertices at one place. Unused vertices do not count.
  void find_places() {
    place_.resize(used_.size());
    std::iota(place_.begin(), place_.end(), Index{0});
    std::vector<Index> order;
    for (Index v = 0; v < used_.size(); ++v)
      if (const Point& p = surface_.vertices[v];
          std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]))
        order.push_back(v);
      else
        place_[v] = no_entity;
    std::sort(order.begin(), order.end(), [&](Index a, Index b) {
      pulse_();
      return std::tuple(surface_.vertices[a], used_[a] == 0, a) <
             std::tuple(surface_.vertices[b], used_[b] == 0, b);
    });
    for (std::size_t i = 1; i < order.size(); ++i) {
      const Index v = order[i], before = order[i - 1];
      if (surface_.vertices[v] != surface_.vertices[before]) continue;
      place_[v] = place_[before];
      if (used_[v] != 0 && !merges_)
        report([&] {
          return "vertices " + std::to_string(place_[v]) + " and " + std::to_string(v) + " are both at " +
                 words(surface_.vertices[v]);
        });
    }
  }

  void take_parts() {
    for (std::size_t f = 0; f < surface_.facets.size(); ++f) {
      const Triangle& t = surface_.facets[f];
      const Part part{{place_[t[0]], place_[t[1]], place_[t[2]]}, 3, f};
      const auto& [a, b, c] = part.corners;
      if (a == b || b == c || c == a || collinear(at(a), at(b), at(c)))
        report([&] { return told(part) + " has no area"; });
      else
        parts_.push_back(part);
    }
    for (std::size_t s = 0; s < surface_.segments.size(); ++s) {
      const Part part{{place_[surface_.segments[s][0]], place_[surface_.segments[s][1]], 0}, 2, s};
      if (part.corners[0] == part.corners[1])
        report([&] { return told(part) + " has no length"; });
      else
        parts_.push_back(part);
    }
    for (Index v = 0; v < used_.size(); ++v)
      if (used_[v] == 0 && place_[v] == v) parts_.push_back({{v, 0, 0}, 1, v});
  }

  void find_repeats() {
    std::vector<std::pair<std::array<Index, 3>, std::size_t>> keys;
    for (const Part& part : parts_) {
      if (part.size != 3) continue;
      std::array<Index, 3> key = part.corners;
      std::sort(key.begin(), key.end());
      keys.emplace_back(key, part.id);
    }
    std::sort(keys.begin(), keys.end());
    for (std::size_t i = 1; i < keys.size(); ++i)
      if (keys[i].first == keys[i - 1].first)
        report([&] {
          return "triangles " + std::to_string(keys[i - 1].second) + " and " +
                 std::to_string(keys[i].second) + " have the same corners";
        });
  }

  void find_meetings() {
    std::vector<Index> sheets;
    sheets.reserve(parts_.size());
    for (const Part& part : parts_)
      sheets.push_back(part.size == 3 && part.id < sheet_.size() ? sheet_[part.id] : no_entity);
    for_each_near_pair(surface_.vertices, parts_, sheets, [&](Index i, Index j) {
      pulse_();
      if (!goes_on_) return;
      const Part &x = parts_[i].size >= parts_[j].size ? parts_[i] : parts_[j],
                 &y = &x == &parts_[i] ? parts_[j] : parts_[i];
      if (meet(x, y)) report([&] { return told(x) + " meets " + told(y) + " outside what they share"; });
    });
  }

  /// x has at least as many corners as y.
  [[nodiscard]] bool meet(const Part& x, const Part& y) const {
    const auto corners = [&](const Part& part) {
      return Corners{at(part.corners[0]), at(part.corners[1]), at(part.corners[2])};
    };
    if (y.size == 3) {
      std::array<Index, 3> a = x.corners, b = y.corners;
      std::sort(a.begin(), a.end());
      std::sort(b.begin(), b.end());
      return a != b && meet_badly(x.corners, corners(x), y.corners, corners(y));
    }
    if (x.size == 3 && y.size == 2)
      return meet_badly(Segment{y.corners[0], y.corners[1]}, at(y.corners[0]), at(y.corners[1]), x.corners,
                        corners(x));
    if (x.size == 3) return on_triangle(at(y.corners[0]), corners(x));
    if (x.size == 2 && y.size == 2) return segments_meet(x, y);
    return x.size == 2 && on_segment(at(y.corners[0]), at(x.corners[0]), at(x.corners[1]));
  }

  [[nodiscard]] bool segments_meet(const Part& x, const Part& y) const {
    const std::array<Index, 2> p{x.corners[0], x.corners[1]}, q{y.corners[0], y.corners[1]};
    const auto is_end = [](Index v, const std::array<Index, 2>& s) { return v == s[0] || v == s[1]; };
    if (is_end(p[0], q) && is_end(p[1], q)) return false;  // the same segment twice
    // An end of one segment on the other: segments with a common end can only meet again this way.
    for (const Index v : p)
      if (!is_end(v, q) && on_segment(at(v), at(q[0]), at(q[1]))) return true;
    for (const Index v : q)
      if (!is_end(v, p) && on_segment(at(v), at(p[0]), at(p[1]))) return true;
    if (is_end(p[0], q) || is_end(p[1], q)) return false;
    if (exact::orient3d(at(p[0]), at(p[1]), at(q[0]), at(q[1])) != 0) return false;
    // Four points of one plane, no end on the other segment: a projection that keeps some area decides.
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const int a = orient_along(axis, at(p[0]), at(p[1]), at(q[0]));
      const int b = orient_along(axis, at(p[0]), at(p[1]), at(q[1]));
      if (a == 0 || b == 0) continue;
      return a != b && orient_along(axis, at(q[0]), at(q[1]), at(p[0])) !=
                           orient_along(axis, at(q[0]), at(q[1]), at(p[1]));
    }
    return false;
  }

  const Complex& surface_;
  const bool merges_;
  const std::span<const Index> sheet_;
  const FoundInvalid& found_;
  Pulse& pulse_;
  bool goes_on_ = true;
  std::vector<std::uint8_t> used_;
  std::vector<Index> place_;
  std::vector<Part> parts_;
};

}  // namespace

void examine_complex(const Complex& surface, bool merges, std::span<const Index> sheet,
                     const FoundInvalid& found, Pulse& pulse) {
  ComplexTest(surface, merges, sheet, found, pulse).run();
}

}  // namespace holdfast::checking
