#include "repair/flat_fans.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "repair/projection.h"

namespace holdfast::repairing {
namespace {

constexpr std::size_t kLeast = 12;  // facets of a fan: fewer have few pairs to leave out

/// A facet at a vertex, which may be part of a fan.
struct Blade {
  std::uint64_t fan;  // the vertex, the axis and the sense of rotation: equal in all blades of a fan
  Index item;         // in the list of facets
  Index corner;       // the vertex in the facet
};

/// The open arc that a blade covers on a small circle round its vertex, from one corner counterclockwise to
/// another. It is less than half of the circle.
struct Arc {
  Index from, to;
};

/// Arcs round a vertex in a projection. All comparisons are exact.
class Arcs {
 public:
  Arcs(const State& state, Index vertex, unsigned axis) : state_(state), vertex_(vertex), axis_(axis) {}

  /// Whether no two arcs share an inner point. They do not if none of them holds the start of the next.
  [[nodiscard]] bool are_apart(std::vector<Arc>& arcs) const {
    std::sort(arcs.begin(), arcs.end(),
              [&](const Arc& a, const Arc& b) { return is_before(a.from, b.from); });
    for (std::size_t k = 0; k < arcs.size(); ++k)
      if (holds(arcs[k], arcs[(k + 1) % arcs.size()].from)) return false;
    return true;
  }

 private:
  /// Whether the direction to a lies at a smaller angle than that to b, from the first axis of the
  /// projection.
  [[nodiscard]] bool is_before(Index a, Index b) const {
    const bool low_a = is_low(a), low_b = is_low(b);
    return low_a == low_b ? turn(a, b) > 0 : low_b;
  }
  /// Whether the direction has an angle of at least 180 degrees.
  [[nodiscard]] bool is_low(Index a) const {
    const auto [x, y] = projected(state_.vertices[a], axis_);
    const auto [x0, y0] = projected(state_.vertices[vertex_], axis_);
    return y < y0 || (y == y0 && x < x0);
  }
  [[nodiscard]] bool holds(const Arc& arc, Index start) const {
    const int turn_from = turn(arc.from, start);
    return turn(start, arc.to) > 0 &&
           (turn_from > 0 || (turn_from == 0 && is_low(arc.from) == is_low(start)));
  }
  [[nodiscard]] int turn(Index a, Index b) const {
    return turn_of(state_.vertices[vertex_], state_.vertices[a], state_.vertices[b], axis_);
  }

  const State& state_;
  Index vertex_;
  unsigned axis_;
};

std::vector<std::uint8_t> vertices_of_many(const State& state, std::span<const Index> facets) {
  std::vector<Index> degree(state.vertices.size(), 0);
  for (const Index f : facets)
    for (const Index v : state.facets[f]) ++degree[v];
  std::vector<std::uint8_t> are_many(degree.size());
  std::transform(degree.begin(), degree.end(), are_many.begin(),
                 [](Index n) { return static_cast<std::uint8_t>(n >= kLeast); });
  return are_many;
}

/// All blades at vertices of many facets, those of a fan one after the other.
std::vector<Blade> list_blades(const State& state, std::span<const Index> facets,
                               std::span<const std::uint8_t> axis) {
  const std::vector<std::uint8_t> are_many = vertices_of_many(state, facets);
  std::vector<Blade> blades;
  for (Index item = 0; item < facets.size(); ++item) {
    const Triangle& t = state.facets[facets[item]];
    if (std::none_of(t.begin(), t.end(), [&](Index v) { return are_many[v] != 0; })) continue;
    const int turn = turn_of(state.vertices[t[0]], state.vertices[t[1]], state.vertices[t[2]], axis[item]);
    if (turn == 0) continue;
    for (Index i = 0; i < 3; ++i)
      if (are_many[t[i]] != 0)
        blades.push_back({std::uint64_t{t[i]} * 8 + axis[item] * 2u + (turn > 0 ? 1u : 0u), item, i});
  }
  std::sort(blades.begin(), blades.end(), [](const Blade& a, const Blade& b) {
    return std::pair(a.fan, a.item) < std::pair(b.fan, b.item);
  });
  return blades;
}

}  // namespace

FlatFans::FlatFans(const State& state, std::span<const Index> facets, std::span<const std::uint8_t> axis) {
  const std::vector<Blade> blades = list_blades(state, facets, axis);
  std::vector<Arc> arcs;
  Index fans = 0;
  for (auto first = blades.begin(); first != blades.end();) {
    const auto end = std::find_if(first, blades.end(), [&](const Blade& b) { return b.fan != first->fan; });
    const std::span<const Blade> fan(first, end);
    first = end;
    if (fan.size() < kLeast) continue;
    arcs.clear();
    for (const auto& [key, item, corner] : fan) {
      const Triangle& t = state.facets[facets[item]];
      const Index next = t[(corner + 1) % 3], last = t[(corner + 2) % 3];
      arcs.push_back(key % 2 != 0 ? Arc{next, last} : Arc{last, next});
    }
    const auto vertex = static_cast<Index>(fan[0].fan / 8);
    if (!Arcs(state, vertex, axis[fan[0].item]).are_apart(arcs)) continue;
    if (of_.empty()) of_.assign(facets.size(), {no_index, no_index, no_index});
    for (const Blade& blade : fan)
      *std::find(of_[blade.item].begin(), of_[blade.item].end(), no_index) = fans;
    ++fans;
  }
}

std::vector<Index> FlatFans::first() const {
  std::vector<Index> first(of_.size());
  std::transform(of_.begin(), of_.end(), first.begin(), [](const auto& fans) { return fans[0]; });
  return first;
}

}  // namespace holdfast::repairing
