// Interfaces of parts that nearly coincide, cut alike.
//
// What each side is led through is decided once for all facets that have it, so that no crack can open: a
// vertex of another part lies on at most one side of a part, and two sides cross in one vertex. From then on
// nothing is compared with a tolerance. The common triangulation of a plane patch is a constrained Delaunay
// triangulation with the pieces of all sides of all its parts, in two of the three coordinates, which are
// exact. Distances are computed in floating point: they choose what is joined, never whether the result is
// valid, which an exact test tells afterwards.
#include "repair/fuse.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <unordered_map>

#include "mesh/disjoint_sets.h"
#include "numbers/elementary.h"
#include "numbers/sorted.h"
#include "plane/triangulate.h"
#include "repair/near.h"
#include "surface/aabb_tree.h"
#include "surface/complex.h"
#include "surface/places.h"

namespace holdfast::repairing {
namespace {

using plane::Poll;
using Side = std::array<Index, 2>;

constexpr double kParallel = 0.9;  // cosine of an angle between facets of one patch
constexpr double kAlike = 0.5;     // the same where they are known to belong together
constexpr double kFlat = 8;        // of what rounding makes: how thick a plane patch may be

/// A facet's plane.
struct PlaneOf {
  Vector normal{};    // of length 1
  double height = 0;  // the facet's least
  std::size_t axis = 0;
};

class Fusing {
 public:
  Fusing(State& state, std::span<const Index> part, double gap, double rounding, const Step& step)
      : state_(state), part_(part), gap_(gap), rounding_(rounding), step_(step) {}

  double run() {
    name_places();
    list_facets();
    find_patches();
    if (close_.empty()) return 0;
    list_sides();
    put_vertices_on_sides();
    cross_sides();
    for (auto& [side, on] : sides_) std::sort(on.points.begin(), on.points.end());
    for (auto& [side, on] : sides_) part_from_itself(side, on);
    triangulate_patches();
    deliver();
    return most_ == 0 ? 0
                      : std::nextafter(2 * most_ * (1 + 0x1p-30), std::numeric_limits<double>::infinity());
  }

 private:
  [[nodiscard]] const Point& at(Index v) const { return state_.vertices[v]; }
  [[nodiscard]] Index part_of(Index facet) const { return part_[state_.facet_parents.of(facet)[0]]; }
  /// Facets that parts have in common already stay as they are.
  [[nodiscard]] bool is_shared(Index facet) const { return state_.facet_parents.of(facet).size() > 1; }

  /// Each place has one vertex, the first.
  void name_places() {
    const std::vector<Index> first = first_at_places(state_.vertices);
    const auto rename = [&](auto& entities) {
      for (auto& corners : entities)
        for (Index& v : corners)
          if (v < first.size() && first[v] != no_index) v = first[v];
    };
    rename(state_.facets);
    rename(state_.segments);
  }

  void list_facets() {
    planes_.resize(state_.facets.size());
    parts_at_.resize(state_.vertices.size());
    for (Index f = 0; f < state_.facets.size(); ++f) {
      planes_[f] = plane_of(state_.facets[f]);
      if (!planes_[f]) continue;
      for (const Index v : state_.facets[f])
        for (const Index p : state_.facet_parents.of(f)) parts_at_[v].push_back(part_[p]);
    }
    for (std::vector<Index>& parts : parts_at_) sort_unique(parts);
  }

  [[nodiscard]] std::optional<PlaneOf> plane_of(const Triangle& t) const {
    for (const Index v : t)
      if (v >= state_.vertices.size() || !is_finite(at(v))) return std::nullopt;
    const Vector u = minus(at(t[1]), at(t[0])), v = minus(at(t[2]), at(t[0])), w = minus(at(t[2]), at(t[1]));
    const double longest = std::max({length(u), length(v), length(w)});
    if (!(longest > 0) || !std::isfinite(longest)) return std::nullopt;
    Vector n = cross(over(u, longest), over(v, longest));
    const double twice_area = length(n);
    if (!(twice_area > 0x1p-40)) return std::nullopt;
    PlaneOf plane{over(n, twice_area), twice_area * longest, 0};
    for (std::size_t k = 1; k < 3; ++k)
      if (std::fabs(plane.normal[k]) > std::fabs(plane.normal[plane.axis])) plane.axis = k;
    return plane;
  }

  // --- Patches ----------------------------------------------------------------------------------------

  [[nodiscard]] Box box_of(std::span<const Index> corners, double margin) const {
    Box box{at(corners[0]), at(corners[0])};
    for (const Index v : corners) box.extend({at(v), at(v)});
    for (std::size_t k = 0; k < 3; ++k) {
      box.low[k] -= margin;
      box.high[k] += margin;
    }
    return box;
  }

  /// Calls visit(f, g) for facets of different parts whose boxes come nearer than the gap.
  template <class Visit>
  void for_each_close(Visit&& visit) const {
    std::vector<Box> boxes;
    std::vector<Index> ids;
    for (Index f = 0; f < state_.facets.size(); ++f) {
      if (!planes_[f] || is_shared(f)) continue;
      boxes.push_back(box_of(state_.facets[f], gap_ / 2));
      ids.push_back(f);
    }
    AabbTree(boxes).for_each_overlap(
        [&](Index i, Index j) {
          if (part_of(ids[i]) != part_of(ids[j])) visit(ids[i], ids[j]);
          return true;
        },
        [](Index, Index) { return false; }, step_);
  }

  void find_patches() {
    DisjointSets sets(state_.facets.size());
    std::vector<std::uint8_t> is_close(state_.facets.size(), 0);
    for_each_close([&](Index f, Index g) {
      is_close[f] = is_close[g] = 1;
      if (overlap(f, g)) sets.unite(f, g);
    });
    std::map<Index, std::vector<Index>> patches;
    for (Index f = 0; f < state_.facets.size(); ++f) {
      if (is_close[f] != 0) close_.push_back(f);
      if (is_close[f] != 0) patches[sets.root(f)].push_back(f);
    }
    patch_of_.assign(state_.facets.size(), no_index);
    for (auto& [root, facets] : patches) {
      if (facets.size() < 2) continue;
      for (const Index f : facets) patch_of_[f] = static_cast<Index>(patches_.size());
      patches_.push_back(std::move(facets));
    }
  }

  [[nodiscard]] double above(Index v, const Point& origin, const Vector& normal) const {
    return std::fabs(dot(minus(at(v), origin), normal));
  }

  /// Whether two facets nearly lie in one plane, and share more of it than rounding makes.
  [[nodiscard]] bool overlap(Index f, Index g) const {
    if (std::fabs(dot(planes_[f]->normal, planes_[g]->normal)) < kParallel) return false;
    const auto lies_in = [&](Index inner, Index outer) {
      const Point& origin = at(state_.facets[outer][0]);
      const auto& t = state_.facets[inner];
      return std::all_of(t.begin(), t.end(),
                         [&](Index v) { return above(v, origin, planes_[outer]->normal) <= gap_; });
    };
    const bool is_near = gap_ > rounding_ && touch(state_.facets[f], state_.facets[g]);
    if (!lies_in(f, g) && !lies_in(g, f) && !is_near) return false;
    const Index wide = planes_[f]->height >= planes_[g]->height ? f : g;
    return share_area(state_.facets[f], state_.facets[g], planes_[wide]->axis);
  }

  /// Whether a corner of one comes within the gap of the other, or a side of one passes a side of the other
  /// so.
  [[nodiscard]] bool touch(const Triangle& f, const Triangle& g) const {
    const auto near = [&](const Triangle& corners, const Triangle& t) {
      return std::any_of(corners.begin(), corners.end(),
                         [&](Index v) { return distance_to(at(v), at(t[0]), at(t[1]), at(t[2])) <= gap_; });
    };
    if (near(f, g) || near(g, f)) return true;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        if (pass(at(f[i]), at(f[(i + 1) % 3]), at(g[j]), at(g[(j + 1) % 3])).distance <= gap_) return true;
    return false;
  }

  [[nodiscard]] PlanePoint flat(Index v, std::size_t axis) const {
    return {at(v)[(axis + 1) % 3], at(v)[(axis + 2) % 3]};
  }

  /// No line along a side parts them, nor cuts off a strip alone.
  [[nodiscard]] bool share_area(const Triangle& f, const Triangle& g, std::size_t axis) const {
    const auto extent = [&](const Triangle& t, const PlanePoint& n) {
      double low = std::numeric_limits<double>::infinity(), high = -low;
      for (const Index v : t) {
        const PlanePoint p = flat(v, axis);
        const double x = p[0] * n[0] + p[1] * n[1];
        low = std::min(low, x);
        high = std::max(high, x);
      }
      return std::array{low, high};
    };
    for (const Triangle& t : {f, g})
      for (std::size_t i = 0; i < 3; ++i) {
        const PlanePoint p = flat(t[i], axis), q = flat(t[(i + 1) % 3], axis);
        const double long_pq = numbers::hypot(q[0] - p[0], q[1] - p[1]);
        if (!(long_pq > 0)) return false;
        const PlanePoint n{(p[1] - q[1]) / long_pq, (q[0] - p[0]) / long_pq};
        const auto a = extent(f, n), b = extent(g, n);
        if (!(std::min(a[1], b[1]) - std::max(a[0], b[0]) > rounding_)) return false;
      }
    return true;
  }

  [[nodiscard]] bool is_flat(const std::vector<Index>& facets) const {
    const PlaneOf& plane = *planes_[widest(facets)];
    const Point& origin = at(state_.facets[widest(facets)][0]);
    return std::all_of(facets.begin(), facets.end(), [&](Index f) {
      const auto& t = state_.facets[f];
      return std::all_of(t.begin(), t.end(),
                         [&](Index v) { return above(v, origin, plane.normal) <= kFlat * rounding_; });
    });
  }

  [[nodiscard]] Index widest(const std::vector<Index>& facets) const {
    return *std::max_element(facets.begin(), facets.end(), [&](Index f, Index g) {
      return planes_[f]->height != planes_[g]->height ? planes_[f]->height < planes_[g]->height : f > g;
    });
  }

  // --- Sides ------------------------------------------------------------------------------------------

  /// What a side is led through, by how far along it.
  struct OnSide {
    std::vector<Index> parts;
    std::vector<std::pair<double, Index>> points;
    enum { fresh, open, done } state = fresh;  // of part_from_itself
  };

  void list_sides() {
    for (const Index f : close_)
      for (std::size_t i = 0; i < 3; ++i) sides_[side_of(f, i)].parts.push_back(part_of(f));
    for (auto& [side, on] : sides_) sort_unique(on.parts);
    for (const Index f : close_)
      for (const Index v : state_.facets[f]) close_vertices_.push_back(v);
    sort_unique(close_vertices_);
  }

  [[nodiscard]] Side side_of(Index f, std::size_t i) const {
    return ascending(Side{state_.facets[f][i], state_.facets[f][(i + 1) % 3]});
  }

  static bool meet(const std::vector<Index>& a, const std::vector<Index>& b) {
    return std::any_of(a.begin(), a.end(),
                       [&](Index p) { return std::binary_search(b.begin(), b.end(), p); });
  }

  /// Of the sides of a part near a vertex the nearest.
  void put_vertices_on_sides() {
    std::vector<Box> boxes;
    std::vector<std::map<Side, OnSide>::iterator> sides;
    for (const Index v : close_vertices_) boxes.push_back(box_of(std::array{v}, gap_));
    for (auto side = sides_.begin(); side != sides_.end(); ++side) {
      sides.push_back(side);
      boxes.push_back(box_of(side->first, 0));
    }
    struct Best {
      double distance, t;
      std::map<Side, OnSide>::iterator side;
    };
    std::map<std::pair<Index, Index>, Best> best;  // by vertex and part
    const auto first = static_cast<Index>(close_vertices_.size());
    AabbTree(boxes).for_each_overlap(
        [&](Index i, Index j) {
          if (i > j) std::swap(i, j);
          if (i >= first || j < first) return true;
          const Index v = close_vertices_[i];
          const auto side = sides[j - first];
          const auto [a, b] = side->first;
          if (v == a || v == b || meet(parts_at_[v], side->second.parts)) return true;
          const Nearness near = beside_side(at(v), at(a), at(b));
          if (!(near.distance <= gap_) || is_led_back(v, a) || is_led_back(v, b)) return true;
          for (const Index p : side->second.parts) {
            const auto [there, is_new] = best.try_emplace({v, p}, Best{near.distance, near.t, side});
            if (!is_new && std::pair(near.distance, side->first) <
                               std::pair(there->second.distance, there->second.side->first))
              there->second = {near.distance, near.t, side};
          }
          return true;
        },
        [](Index, Index) { return false; }, step_);
    for (const auto& [key, found] : best) {
      on_side_.insert(key);
      auto& points = found.side->second.points;
      const std::pair<double, Index> point{found.t, key.first};
      if (std::find(points.begin(), points.end(), point) == points.end()) points.push_back(point);
      most_ = std::max(most_, found.distance);
    }
  }

  /// Two vertices that are within the gap may each pass a side of the other: the later one goes on the side.
  [[nodiscard]] bool is_led_back(Index v, Index end) const {
    return v < end && length(minus(at(v), at(end))) <= gap_;
  }

  [[nodiscard]] static bool has(const Side& side, const OnSide& on, Index v) {
    return v == side[0] || v == side[1] ||
           std::any_of(on.points.begin(), on.points.end(), [&](const auto& p) { return p.second == v; });
  }

  /// Whether two sides have a vertex in common by now: then they meet there, and nowhere else.
  [[nodiscard]] static bool are_joined(const Side& s, const OnSide& on_s, const Side& t, const OnSide& on_t) {
    if (has(s, on_s, t[0]) || has(s, on_s, t[1])) return true;
    return has(t, on_t, s[0]) || has(t, on_t, s[1]) ||
           std::any_of(on_s.points.begin(), on_s.points.end(),
                       [&](const auto& p) { return has(t, on_t, p.second); });
  }

  void cross_sides() {
    std::vector<Box> boxes;
    std::vector<std::map<Side, OnSide>::iterator> sides;
    for (auto side = sides_.begin(); side != sides_.end(); ++side) {
      sides.push_back(side);
      boxes.push_back(box_of(side->first, gap_ / 2));
    }
    struct Crossing {
      Index first, second;
      double t, s;
      Point where;
    };
    std::vector<Crossing> crossings;
    AabbTree(boxes).for_each_overlap(
        [&](Index i, Index j) {
          if (i > j) std::swap(i, j);
          const auto& [s, on_s] = *sides[i];
          const auto& [t, on_t] = *sides[j];
          if (meet(on_s.parts, on_t.parts) || are_joined(s, on_s, t, on_t)) return true;
          const bool earlier = on_s.parts[0] < on_t.parts[0];  // whose side the new vertex is put on
          const Passing passing = pass(at(s[0]), at(s[1]), at(t[0]), at(t[1]));
          if (!(passing.distance <= gap_)) return true;
          crossings.push_back({i, j, passing.t, passing.s, earlier ? passing.on_first : passing.on_second});
          most_ = std::max(most_, passing.distance);
          return true;
        },
        [](Index, Index) { return false; }, step_);
    std::sort(crossings.begin(), crossings.end(), [](const Crossing& a, const Crossing& b) {
      return std::pair(a.first, a.second) < std::pair(b.first, b.second);
    });
    for (const Crossing& crossing : crossings) {
      auto& [s, on_s] = *sides[crossing.first];
      auto& [t, on_t] = *sides[crossing.second];
      // Where three sides meet in a point, two of them found it first.
      Index v = near_on(s, on_s, crossing.where);
      if (v == no_index) v = near_on(t, on_t, crossing.where);
      if (v == no_index) v = add_vertex(crossing.where);
      if (!has(s, on_s, v)) on_s.points.emplace_back(crossing.t, v);
      if (!has(t, on_t, v)) on_t.points.emplace_back(crossing.s, v);
    }
  }

  [[nodiscard]] Index near_on(const Side& side, const OnSide& on, const Point& p) const {
    for (const Index v : side)
      if (length(minus(at(v), p)) <= gap_) return v;
    for (const auto& [t, v] : on.points)
      if (length(minus(at(v), p)) <= gap_) return v;
    return no_index;
  }

  Index add_vertex(const Point& p) {
    state_.vertices.push_back(p);
    return static_cast<Index>(state_.vertices.size() - 1);
  }

  /// A piece of a side may be a side, which is led through vertices in its turn. Where that would lead back
  /// to the first one, a vertex is left out.
  void part_from_itself(const Side& side, OnSide& on) {
    if (on.state == OnSide::done || on.points.empty()) return;
    on.state = OnSide::open;
    for (std::size_t k = 0; k <= on.points.size();) {
      const Index a = k == 0 ? side[0] : on.points[k - 1].second;
      const Index b = k == on.points.size() ? side[1] : on.points[k].second;
      const auto piece = sides_.find(ascending(Side{a, b}));
      if (piece != sides_.end() && piece->second.state == OnSide::open) {
        on.points.erase(on.points.begin() + static_cast<std::ptrdiff_t>(k == 0 ? 0 : k - 1));
        if (on.points.empty()) break;
        k = k == 0 ? 0 : k - 1;
        continue;
      }
      if (piece != sides_.end()) part_from_itself(piece->first, piece->second);
      ++k;
    }
    on.state = OnSide::done;
  }

  /// The vertices of a side from one end to the other.
  [[nodiscard]] std::vector<Index> chain(Index from, Index to) const {
    std::vector<Index> chain{from};
    const auto found = sides_.find(ascending(Side{from, to}));
    if (found != sides_.end()) {
      for (const auto& [t, v] : found->second.points) chain.push_back(v);
      if (from > to) std::reverse(chain.begin() + 1, chain.end());
    }
    chain.push_back(to);
    return chain;
  }

  // --- Patches triangulated ---------------------------------------------------------------------------

  void triangulate_patches() {
    for (Index p = 0; p < patches_.size(); ++p) {
      step_(0.6);
      if (is_flat(patches_[p]) ? !triangulate(p) : !triangulate_curved(patches_[p]))
        for (const Index f : patches_[p]) patch_of_[f] = no_index;
    }
  }

  struct Pasted {
    Triangle corners;
    std::vector<Index> facets;  // ascending, in the state
  };

  bool triangulate(Index patch) {
    const std::vector<Index>& facets = patches_[patch];
    const std::size_t axis = planes_[widest(facets)]->axis;
    Plane plane;
    std::unordered_map<Index, Index> number;
    std::vector<Index> vertices;
    const auto number_of = [&](Index v) {
      const auto [found, is_new] = number.try_emplace(v, static_cast<Index>(vertices.size()));
      if (is_new) {
        vertices.push_back(v);
        plane.points.push_back(flat(v, axis));
      }
      return found->second;
    };
    std::vector<Side> pieces;
    for (const Index f : facets)
      for (std::size_t i = 0; i < 3; ++i) {
        const std::vector<Index> along = chain(state_.facets[f][i], state_.facets[f][(i + 1) % 3]);
        for (std::size_t k = 0; k + 1 < along.size(); ++k)
          pieces.push_back(ascending(Side{number_of(along[k]), number_of(along[k + 1])}));
      }
    sort_unique(pieces);
    plane.segments.assign(pieces.begin(), pieces.end());
    PlaneOptions options;
    options.delaunay = true;
    const PlaneResult result = plane::triangulate(plane, options, [&](double) { step_(0.7); });
    if (result.outcome != Outcome::done || result.mesh.points.size() != plane.points.size()) return false;

    std::map<int, std::vector<Index>> of_cell = facets_of_cells(facets, axis, vertices, result.mesh);
    std::vector<Pasted> pasted;
    std::vector<Index> children(facets.size(), 0);
    for (std::size_t t = 0; t < result.mesh.triangles.size(); ++t) {
      const std::vector<Index>& of = of_cell[result.mesh.regions[t]];
      if (of.empty()) continue;
      Triangle corners = result.mesh.triangles[t];
      for (Index& v : corners) v = vertices[v];
      if (area(state_.facets[of[0]], axis) < 0) std::swap(corners[1], corners[2]);
      for (const Index f : of) {
        note_distance(corners, state_.facets[f]);
        ++children[static_cast<std::size_t>(std::lower_bound(facets.begin(), facets.end(), f) -
                                            facets.begin())];
      }
      pasted.push_back({corners, of});
    }
    if (std::count(children.begin(), children.end(), 0u) != 0) return false;
    pasted_.insert(pasted_.end(), pasted.begin(), pasted.end());
    return true;
  }

  // A patch that is not plane: what several parts have in common is cut in the planes of the facets of the
  // first of them, and the rest of the others' facets in their own.

  bool triangulate_curved(const std::vector<Index>& facets) {
    std::vector<Index> in_order = facets;
    std::stable_sort(in_order.begin(), in_order.end(),
                     [&](Index f, Index g) { return part_of(f) < part_of(g); });
    const std::map<Index, std::vector<Index>> inside = vertices_inside(facets);
    std::vector<Box> boxes;
    for (const Index f : in_order) boxes.push_back(box_of(state_.facets[f], gap_));
    std::vector<Pasted> pasted;
    for (const Index f : in_order) {
      step_(0.7);
      const auto found = inside.find(f);
      if (!cut_one(f, found == inside.end() ? std::vector<Index>{} : found->second, in_order, boxes, pasted))
        return false;
    }
    for (const Pasted& p : pasted)
      for (const Index f : p.facets) note_distance(p.corners, state_.facets[f]);
    pasted_.insert(pasted_.end(), pasted.begin(), pasted.end());
    return true;
  }

  /// By facet the vertices of other parts that lie on it, and on no side of its part.
  [[nodiscard]] std::map<Index, std::vector<Index>> vertices_inside(const std::vector<Index>& facets) const {
    std::vector<Index> vertices;
    for (const Index f : facets)
      vertices.insert(vertices.end(), state_.facets[f].begin(), state_.facets[f].end());
    sort_unique(vertices);
    std::vector<Box> boxes;
    for (const Index v : vertices) boxes.push_back(box_of(std::array{v}, gap_));
    for (const Index f : facets) boxes.push_back(box_of(state_.facets[f], 0));
    std::map<std::pair<Index, Index>, std::pair<double, Index>> best;  // by vertex and part
    const auto first = static_cast<Index>(vertices.size());
    AabbTree(boxes).for_each_overlap(
        [&](Index i, Index j) {
          if (i > j) std::swap(i, j);
          if (i >= first || j < first) return true;
          const Index v = vertices[i], f = facets[j - first], part = part_of(f);
          if (std::binary_search(parts_at_[v].begin(), parts_at_[v].end(), part)) return true;
          if (on_side_.count({v, part}) != 0) return true;
          const auto& [a, b, c] = state_.facets[f];
          const std::pair near{beside_facet(at(v), at(a), at(b), at(c)).distance, f};
          if (!(near.first <= gap_)) return true;
          const auto [there, is_new] = best.try_emplace({v, part}, near);
          if (!is_new) there->second = std::min(there->second, near);
          return true;
        },
        [](Index, Index) { return false; }, step_);
    std::map<Index, std::vector<Index>> inside;
    for (const auto& [key, near] : best) inside[near.second].push_back(key.first);
    return inside;
  }

  /// A facet with the vertices inside it, and all pieces of other parts' sides between its vertices.
  bool cut_one(Index f, const std::vector<Index>& inside, const std::vector<Index>& patch,
               const std::vector<Box>& boxes, std::vector<Pasted>& pasted) {
    const std::size_t axis = planes_[f]->axis;
    Plane plane;
    std::map<Index, Index> number;
    std::map<Index, unsigned> sides;  // by vertex, a mask of the facet's sides that it is on
    std::vector<Index> vertices;
    const auto add = [&](Index v, unsigned mask) {
      sides[v] |= mask;
      if (!number.try_emplace(v, static_cast<Index>(vertices.size())).second) return;
      vertices.push_back(v);
      plane.points.push_back(flat(v, axis));
    };
    std::vector<Side> pieces;
    for (unsigned i = 0; i < 3; ++i) {
      const std::vector<Index> along = chain(state_.facets[f][i], state_.facets[f][(i + 1) % 3]);
      for (const Index v : along) add(v, 1u << i);
      for (std::size_t k = 0; k + 1 < along.size(); ++k)
        pieces.push_back(ascending(Side{along[k], along[k + 1]}));
    }
    for (const Index v : inside) add(v, 0);
    const auto is_within = [&](Index v, Index w) {
      const auto a = sides.find(v), b = sides.find(w);
      return a != sides.end() && b != sides.end() && (a->second & b->second) == 0;
    };
    const Box box = box_of(state_.facets[f], gap_);
    for (std::size_t k = 0; k < patch.size(); ++k) {
      if (part_of(patch[k]) == part_of(f) || !boxes[k].overlaps(box)) continue;
      for (std::size_t i = 0; i < 3; ++i) {
        const std::vector<Index> along =
            chain(state_.facets[patch[k]][i], state_.facets[patch[k]][(i + 1) % 3]);
        for (std::size_t n = 0; n + 1 < along.size(); ++n)
          if (is_within(along[n], along[n + 1])) pieces.push_back(ascending(Side{along[n], along[n + 1]}));
      }
    }
    sort_unique(pieces);
    for (const Side& piece : pieces) plane.segments.push_back({number[piece[0]], number[piece[1]]});
    PlaneOptions options;
    options.delaunay = true;
    const PlaneResult result = plane::triangulate(plane, options, [&](double) { step_(0.7); });
    if (result.outcome != Outcome::done || result.mesh.points.size() != plane.points.size()) return false;
    std::map<int, std::pair<double, std::vector<Index>>> cells;  // largest triangle, and the facets there
    for (std::size_t t = 0; t < result.mesh.triangles.size(); ++t) {
      Triangle corners = result.mesh.triangles[t];
      for (Index& v : corners) v = vertices[v];
      const double size = area(corners, axis);
      const auto [there, is_new] = cells.try_emplace(result.mesh.regions[t]);
      if (is_new || size > there->second.first) there->second = {size, facets_at(corners, f, patch, boxes)};
    }
    for (std::size_t t = 0; t < result.mesh.triangles.size(); ++t) {
      const std::vector<Index>& of = cells.at(result.mesh.regions[t]).second;
      if (of.empty() || part_of(of[0]) != part_of(f)) continue;  // an earlier part's facet has it
      Triangle corners = result.mesh.triangles[t];
      for (Index& v : corners) v = vertices[v];
      if (area(state_.facets[f], axis) < 0) std::swap(corners[1], corners[2]);
      std::vector<Index> parents = of;
      std::sort(parents.begin(), parents.end());
      pasted.push_back({corners, std::move(parents)});
    }
    return true;
  }

  /// The facet itself and, of each other part, the one that is nearest to the middle of a piece of it; in the
  /// order of parts.
  [[nodiscard]] std::vector<Index> facets_at(const Triangle& piece, Index f, const std::vector<Index>& patch,
                                             const std::vector<Box>& boxes) const {
    Point middle{};
    for (const Index v : piece)
      for (std::size_t k = 0; k < 3; ++k) middle[k] += at(v)[k] / 3;
    std::map<Index, std::pair<double, Index>> nearest;  // by part
    for (std::size_t k = 0; k < patch.size(); ++k) {
      const Index g = patch[k];
      if (part_of(g) == part_of(f) || !boxes[k].overlaps({middle, middle})) continue;
      if (std::fabs(dot(planes_[f]->normal, planes_[g]->normal)) < kAlike) continue;
      const auto& [a, b, c] = state_.facets[g];
      const std::pair near{distance_to(middle, at(a), at(b), at(c)), g};
      if (!(near.first <= gap_)) continue;
      const auto [there, is_new] = nearest.try_emplace(part_of(g), near);
      if (!is_new) there->second = std::min(there->second, near);
    }
    nearest[part_of(f)] = {0, f};
    std::vector<Index> facets;
    for (const auto& [part, near] : nearest) facets.push_back(near.second);
    return facets;
  }

  [[nodiscard]] double area(const Triangle& t, std::size_t axis) const {
    const PlanePoint a = flat(t[0], axis), b = flat(t[1], axis), c = flat(t[2], axis);
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  }

  /// For each cell between the sides the facets that it is in, told by the middle of its largest triangle.
  [[nodiscard]] std::map<int, std::vector<Index>> facets_of_cells(const std::vector<Index>& facets,
                                                                  std::size_t axis,
                                                                  const std::vector<Index>& vertices,
                                                                  const PlaneMesh& mesh) const {
    std::map<int, std::pair<double, Triangle>> largest;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      Triangle corners = mesh.triangles[t];
      for (Index& v : corners) v = vertices[v];
      const double size = area(corners, axis);
      const auto [there, is_new] = largest.try_emplace(mesh.regions[t], size, corners);
      if (!is_new && size > there->second.first) there->second = {size, corners};
    }
    std::vector<Box> boxes;
    std::vector<std::pair<int, PlanePoint>> middles;
    for (const auto& [cell, best] : largest) {
      PlanePoint middle{};
      for (const Index v : best.second)
        for (std::size_t k = 0; k < 2; ++k) middle[k] += flat(v, axis)[k] / 3;
      middles.emplace_back(cell, middle);
      boxes.push_back({{middle[0], middle[1], 0}, {middle[0], middle[1], 0}});
    }
    for (const Index f : facets) {
      const PlanePoint a = flat(state_.facets[f][0], axis);
      Box box{{a[0], a[1], 0}, {a[0], a[1], 0}};
      for (const Index v : state_.facets[f]) {
        const PlanePoint p = flat(v, axis);
        box.extend({{p[0], p[1], 0}, {p[0], p[1], 0}});
      }
      boxes.push_back(box);
    }
    std::map<int, std::vector<Index>> of_cell;
    const auto first = static_cast<Index>(middles.size());
    AabbTree(boxes).for_each_overlap(
        [&](Index i, Index j) {
          if (i > j) std::swap(i, j);
          if (i >= first || j < first) return true;
          const Index f = facets[j - first];
          if (holds(state_.facets[f], middles[i].second, axis)) of_cell[middles[i].first].push_back(f);
          return true;
        },
        [](Index, Index) { return false; }, step_);
    for (auto& [cell, of] : of_cell) sort_unique(of);
    return of_cell;
  }

  [[nodiscard]] bool holds(const Triangle& t, const PlanePoint& p, std::size_t axis) const {
    int left = 0, right = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const PlanePoint a = flat(t[i], axis), b = flat(t[(i + 1) % 3], axis);
      const double side = (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
      if (side > 0) ++left;
      if (side < 0) ++right;
    }
    return left == 0 || right == 0;
  }

  void note_distance(const Triangle& child, const Triangle& facet) {
    for (const Index v : child)
      most_ = std::max(most_, distance_to(at(v), at(facet[0]), at(facet[1]), at(facet[2])));
  }

  // --- The result -------------------------------------------------------------------------------------

  /// A facet that is in no patch, cut with its sides. Returns false where that leads back to itself, as it
  /// may in facets that are thinner than the gap.
  [[nodiscard]] bool split(const Triangle& t, std::vector<Triangle>& pieces, int depth = 0) const {
    constexpr int kDeepest = 24;  // each level is done with a side
    if (depth > kDeepest) return false;
    for (std::size_t i = 0; i < 3; ++i) {
      const Index a = t[i], b = t[(i + 1) % 3], c = t[(i + 2) % 3];
      const std::vector<Index> along = chain(a, b);
      if (along.size() == 2) continue;
      for (std::size_t k = 0; k + 1 < along.size(); ++k)
        if (along[k] != c && along[k + 1] != c && !split({along[k], along[k + 1], c}, pieces, depth + 1))
          return false;
      return true;
    }
    pieces.push_back(t);
    return true;
  }

  void deliver() {
    std::map<Index, std::vector<const Pasted*>> of_patch;  // by first facet
    for (const Pasted& p : pasted_) of_patch[p.facets[0]].push_back(&p);
    std::vector<Triangle> facets, pieces;
    Parents parents;
    std::vector<Index> list;
    const auto take = [&](const Triangle& t, std::span<const Index> of) {
      facets.push_back(t);
      list.clear();
      for (const Index f : of) {
        const auto own = state_.facet_parents.of(f);
        list.insert(list.end(), own.begin(), own.end());
      }
      sort_unique(list);
      parents.add(list);
    };
    for (Index f = 0; f < state_.facets.size(); ++f) {
      if (patch_of_[f] != no_index) {
        if (const auto own = of_patch.find(f); own != of_patch.end())
          for (const Pasted* p : own->second) take(p->corners, p->facets);
        continue;
      }
      pieces.clear();
      if (!planes_[f] || !split(state_.facets[f], pieces)) pieces.assign(1, state_.facets[f]);
      for (const Triangle& t : pieces) take(t, std::array{f});
    }
    state_.facets = std::move(facets);
    state_.facet_parents = std::move(parents);
    state_.known.clear();
    drop_unused(state_);
  }

  State& state_;
  const std::span<const Index> part_;
  const double gap_, rounding_;
  const Step& step_;
  std::vector<std::optional<PlaneOf>> planes_;  // by facet; nothing for those that are none
  std::vector<std::vector<Index>> parts_at_;    // by vertex, ascending
  std::vector<Index> close_;                    // facets near to another part
  std::vector<Index> close_vertices_;
  std::set<std::pair<Index, Index>>
      on_side_;                              // vertices, with the parts that have a side that is led through
  std::vector<std::vector<Index>> patches_;  // facets, ascending
  std::vector<Index> patch_of_;              // by facet, or no_index
  std::map<Side, OnSide> sides_;             // of close facets
  std::vector<Pasted> pasted_;
  double most_ = 0;
};

}  // namespace

double fuse(State& state, std::span<const Index> part, double gap, double rounding, const Step& step) {
  return Fusing(state, part, gap, rounding, step).run();
}

}  // namespace holdfast::repairing
