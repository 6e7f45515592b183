// The segments of the input while they are cut.
#include "plane/input_segments.h"

#include <cmath>

namespace holdfast::plane {
namespace {

Ends sorted(const Ends& e) { return {std::min(e[0], e[1]), std::max(e[0], e[1])}; }

}  // namespace

InputSegments::InputSegments(const Triangles& mesh, const std::vector<Position>& at,
                             const std::vector<Ends>& segments)
    : at_(at), ends_(segments), given_(static_cast<std::uint32_t>(segments.size())) {
  below_.assign(at.size(), kNoSegment);
  list(mesh);
  find_acute_corners();
}

void InputSegments::list(const Triangles& mesh) {
  for (std::uint32_t s = 0; s < given_; ++s) by_ends_.emplace_back(sorted(ends_[s]), s);
  std::sort(by_ends_.begin(), by_ends_.end());
  for (std::uint32_t t = 0; t < mesh.size(); ++t)
    for (std::uint32_t i = 0; i < 3; ++i) {
      const EdgeCode e = code(t, i);
      if (!mesh.constrained(e) || mesh.across(e) != kNoEdge) continue;
      const Ends key = sorted({mesh.from(e), mesh.to(e)});
      const auto last = by_ends_.begin() + given_;
      const auto found = std::lower_bound(by_ends_.begin(), last, std::pair(key, std::uint32_t{0}));
      if (found == last || found->first != key) ends_.push_back(key);
    }
  for (auto s = given_; s < ends_.size(); ++s) by_ends_.emplace_back(ends_[s], s);
  std::sort(by_ends_.begin(), by_ends_.end());
}

// The bound is slightly above 60 degrees.
void InputSegments::find_acute_corners() {
  constexpr double kCosine = 0.49;
  acute_.assign(at_.size(), false);
  for (std::uint32_t s = 0; s < ends_.size(); ++s)
    for (const Vertex v : ends_[s]) at_corners_.emplace_back(v, s);
  std::sort(at_corners_.begin(), at_corners_.end());
  for (std::size_t i = 0, j = 0; i < at_corners_.size(); i = j) {
    const Vertex v = at_corners_[i].first;
    while (j < at_corners_.size() && at_corners_[j].first == v) ++j;
    // Of seven or more segments, two are less than 60 degrees apart.
    acute_[v] = j - i > 6;
    for (std::size_t k = i; k < j && !acute_[v]; ++k)
      for (std::size_t l = k + 1; l < j && !acute_[v]; ++l) {
        const Position &p = at_[v], &q = at_[other_end(at_corners_[k].second, v)],
                       &r = at_[other_end(at_corners_[l].second, v)];
        acute_[v] = dot_from(p, q, r) > kCosine * std::sqrt(squared(p, q)) * std::sqrt(squared(p, r));
      }
  }
}

std::uint32_t InputSegments::of(Vertex a, Vertex b) const {
  for (const Vertex v : {a, b})
    if (below_[v] != kNoSegment) return below_[v];
  const std::pair key(sorted({a, b}), std::uint32_t{0});
  return std::lower_bound(by_ends_.begin(), by_ends_.end(), key)->second;
}

Position InputSegments::cut_of(Vertex a, Vertex b) const {
  if (is_acute(b)) std::swap(a, b);
  if (!is_acute(a) || is_acute(b)) return middle(at_[a], at_[b]);
  const double length = std::sqrt(squared(at_[a], at_[b]));
  // The power of two 2^k nearest to half the length: between 0.35 and 0.71 of the whole.
  const double part = std::scalbn(1.0, std::ilogb(length * 0x1.6a09e667f3bcdp-1)) / length;
  return {at_[a][0] + part * (at_[b][0] - at_[a][0]), at_[a][1] + part * (at_[b][1] - at_[a][1])};
}

Vertex InputSegments::common_corner(std::uint32_t s, std::uint32_t r) const {
  for (const Vertex v : ends_[s])
    if (v == ends_[r][0] || v == ends_[r][1]) return v;
  return kNoVertex;
}

bool InputSegments::make_needle(std::uint32_t s, std::uint32_t r) const {
  constexpr double kNeedle = 0.05;  // sine of 2.9 degrees
  const Vertex v = s == r ? kNoVertex : common_corner(s, r);
  if (v == kNoVertex) return false;
  const Position &p = at_[v], &q = at_[other_end(s, v)], &o = at_[other_end(r, v)];
  return dot_from(p, q, o) > 0 &&
         std::abs(cross_from(p, q, o)) < kNeedle * std::sqrt(squared(p, q)) * std::sqrt(squared(p, o));
}

template <typename Visit>
void InputSegments::each_at(Vertex v, Visit&& visit) const {
  if (below_[v] != kNoSegment) return visit(below_[v]);
  auto it = std::lower_bound(at_corners_.begin(), at_corners_.end(), std::pair(v, std::uint32_t{0}));
  constexpr int kMost = 64;  // bounds the time: at a vertex with more segments, the first ones stand for all
  for (int k = 0; k < kMost && it != at_corners_.end() && it->first == v; ++it, ++k) visit(it->second);
}

bool InputSegments::any_make_needle(Vertex a, Vertex b) const {
  bool any = false;
  each_at(a, [&](std::uint32_t s) { each_at(b, [&](std::uint32_t r) { any = any || make_needle(s, r); }); });
  return any;
}

}  // namespace holdfast::plane
