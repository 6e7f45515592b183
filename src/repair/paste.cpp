// The common triangles of patches: of a plane one at once, of a curved one facet by facet.
#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_map>

#include "numbers/sorted.h"
#include "plane/triangulate.h"
#include "repair/patches.h"
#include "surface/aabb_tree.h"
#include "surface/complex.h"

namespace holdfast::repairing {
namespace {

constexpr double kAlike = 0.5;  // cosine of an angle between facets that are known to belong together
constexpr double kFlat = 8;     // of what rounding makes: how thick a plane patch may be

using Side = std::array<Index, 2>;

bool is_flat(const PartFacets& facets, const std::vector<Index>& patch, double rounding) {
  const Index widest = facets.widest(patch);
  const Point& origin = facets.at(facets.corners(widest)[0]);
  return std::all_of(patch.begin(), patch.end(), [&](Index f) {
    const Triangle& t = facets.corners(f);
    return std::all_of(t.begin(), t.end(), [&](Index v) {
      return std::fabs(dot(minus(facets.at(v), origin), facets.plane(widest)->normal)) <= kFlat * rounding;
    });
  });
}

/// Cuts one patch after the other.
class PatchCutter {
 public:
  PatchCutter(const PartFacets& facets, const LedSides& sides, double gap, const Step& step)
      : facets_(facets), sides_(sides), gap_(gap), step_(step) {}

  /// A patch that is plane. False where that fails.
  bool cut_flat(const std::vector<Index>& patch);
  /// One that is not: what several parts have in common is cut in the planes of the facets of the first of
  /// them, and the rest of the others' facets in their own.
  bool cut_curved(const std::vector<Index>& patch);

  [[nodiscard]] std::vector<Pasted> pasted() && { return std::move(pasted_); }
  /// The furthest distance of a corner of a triangle from a facet that it stands for.
  [[nodiscard]] double most() const { return most_; }

 private:
  [[nodiscard]] std::map<int, std::vector<Index>> facets_of_cells(const std::vector<Index>& patch,
                                                                  std::size_t axis,
                                                                  const std::vector<Index>& vertices,
                                                                  const PlaneMesh& mesh) const;
  [[nodiscard]] std::map<Index, std::vector<Index>> vertices_inside(const std::vector<Index>& patch) const;
  bool cut_one(Index f, const std::vector<Index>& inside, const std::vector<Index>& patch,
               const std::vector<Box>& boxes, std::vector<Pasted>& pasted);
  [[nodiscard]] std::vector<Index> facets_at(const Triangle& piece, Index f, const std::vector<Index>& patch,
                                             const std::vector<Box>& boxes) const;
  [[nodiscard]] PlaneResult triangulate(const Plane& plane) const;

  const PartFacets& facets_;
  const LedSides& sides_;
  const double gap_;
  const Step& step_;
  std::vector<Pasted> pasted_;
  double most_ = 0;
};

PlaneResult PatchCutter::triangulate(const Plane& plane) const {
  PlaneOptions options;
  options.delaunay = true;
  return plane::triangulate(plane, options, [&](double) { step_(0.7); });
}

bool PatchCutter::cut_flat(const std::vector<Index>& patch) {
  const std::size_t axis = facets_.plane(facets_.widest(patch))->axis;
  Plane plane;
  std::unordered_map<Index, Index> number;
  std::vector<Index> vertices;
  const auto number_of = [&](Index v) {
    const auto [found, is_new] = number.try_emplace(v, static_cast<Index>(vertices.size()));
    if (is_new) {
      vertices.push_back(v);
      plane.points.push_back(facets_.flat(v, axis));
    }
    return found->second;
  };
  std::vector<Side> pieces;
  for (const Index f : patch)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::vector<Index> along = sides_.chain(facets_.corners(f)[i], facets_.corners(f)[(i + 1) % 3]);
      for (std::size_t k = 0; k + 1 < along.size(); ++k)
        pieces.push_back(ascending(Side{number_of(along[k]), number_of(along[k + 1])}));
    }
  sort_unique(pieces);
  plane.segments.assign(pieces.begin(), pieces.end());
  const PlaneResult result = triangulate(plane);
  if (result.outcome != Outcome::done || result.mesh.points.size() != plane.points.size()) return false;

  std::map<int, std::vector<Index>> of_cell = facets_of_cells(patch, axis, vertices, result.mesh);
  std::vector<Pasted> pasted;
  std::vector<Index> children(patch.size(), 0);
  for (std::size_t t = 0; t < result.mesh.triangles.size(); ++t) {
    const std::vector<Index>& of = of_cell[result.mesh.regions[t]];
    if (of.empty()) continue;
    Triangle corners = result.mesh.triangles[t];
    for (Index& v : corners) v = vertices[v];
    if (facets_.area(facets_.corners(of[0]), axis) < 0) std::swap(corners[1], corners[2]);
    for (const Index f : of) {
      most_ = std::max(most_, facets_.distance(corners, f));
      ++children[static_cast<std::size_t>(std::lower_bound(patch.begin(), patch.end(), f) - patch.begin())];
    }
    pasted.push_back({corners, of});
  }
  if (std::count(children.begin(), children.end(), 0u) != 0) return false;
  pasted_.insert(pasted_.end(), pasted.begin(), pasted.end());
  return true;
}

bool PatchCutter::cut_curved(const std::vector<Index>& patch) {
  std::vector<Index> in_order = patch;
  std::stable_sort(in_order.begin(), in_order.end(),
                   [&](Index f, Index g) { return facets_.part_of(f) < facets_.part_of(g); });
  const std::map<Index, std::vector<Index>> inside = vertices_inside(patch);
  std::vector<Box> boxes;
  for (const Index f : in_order) boxes.push_back(box_round(facets_.state(), facets_.corners(f), gap_));
  std::vector<Pasted> pasted;
  for (const Index f : in_order) {
    step_(0.7);
    const auto found = inside.find(f);
    if (!cut_one(f, found == inside.end() ? std::vector<Index>{} : found->second, in_order, boxes, pasted))
      return false;
  }
  for (const Pasted& p : pasted)
    for (const Index f : p.facets) most_ = std::max(most_, facets_.distance(p.corners, f));
  pasted_.insert(pasted_.end(), pasted.begin(), pasted.end());
  return true;
}

// By facet the vertices of other parts that lie on it, and on no side of its part.
std::map<Index, std::vector<Index>> PatchCutter::vertices_inside(const std::vector<Index>& patch) const {
  std::vector<Index> vertices;
  for (const Index f : patch)
    vertices.insert(vertices.end(), facets_.corners(f).begin(), facets_.corners(f).end());
  sort_unique(vertices);
  std::vector<Box> boxes;
  for (const Index v : vertices) boxes.push_back(box_round(facets_.state(), std::array{v}, gap_));
  for (const Index f : patch) boxes.push_back(box_round(facets_.state(), facets_.corners(f), 0));
  std::map<std::pair<Index, Index>, std::pair<double, Index>> best;  // by vertex and part
  const auto first = static_cast<Index>(vertices.size());
  AabbTree(boxes).for_each_overlap(
      [&](Index i, Index j) {
        if (i > j) std::swap(i, j);
        if (i >= first || j < first) return true;
        const Index v = vertices[i], f = patch[j - first], part = facets_.part_of(f);
        if (std::binary_search(facets_.parts_at(v).begin(), facets_.parts_at(v).end(), part)) return true;
        if (sides_.is_on_side(v, part)) return true;
        const auto& [a, b, c] = facets_.corners(f);
        const std::pair near{
            beside_facet(facets_.at(v), facets_.at(a), facets_.at(b), facets_.at(c)).distance, f};
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

// A facet with the vertices inside it, and all pieces of other parts' sides between its vertices.
bool PatchCutter::cut_one(Index f, const std::vector<Index>& inside, const std::vector<Index>& patch,
                          const std::vector<Box>& boxes, std::vector<Pasted>& pasted) {
  const std::size_t axis = facets_.plane(f)->axis;
  Plane plane;
  std::map<Index, Index> number;
  std::map<Index, unsigned> sides;  // by vertex, a mask of the facet's sides that it is on
  std::vector<Index> vertices;
  const auto add = [&](Index v, unsigned mask) {
    sides[v] |= mask;
    if (!number.try_emplace(v, static_cast<Index>(vertices.size())).second) return;
    vertices.push_back(v);
    plane.points.push_back(facets_.flat(v, axis));
  };
  std::vector<Side> pieces;
  for (unsigned i = 0; i < 3; ++i) {
    const std::vector<Index> along = sides_.chain(facets_.corners(f)[i], facets_.corners(f)[(i + 1) % 3]);
    for (const Index v : along) add(v, 1u << i);
    for (std::size_t k = 0; k + 1 < along.size(); ++k)
      pieces.push_back(ascending(Side{along[k], along[k + 1]}));
  }
  for (const Index v : inside) add(v, 0);
  const auto is_within = [&](Index v, Index w) {
    const auto a = sides.find(v), b = sides.find(w);
    return a != sides.end() && b != sides.end() && (a->second & b->second) == 0;
  };
  const Box box = box_round(facets_.state(), facets_.corners(f), gap_);
  for (std::size_t k = 0; k < patch.size(); ++k) {
    if (facets_.part_of(patch[k]) == facets_.part_of(f) || !boxes[k].overlaps(box)) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::vector<Index> along =
          sides_.chain(facets_.corners(patch[k])[i], facets_.corners(patch[k])[(i + 1) % 3]);
      for (std::size_t n = 0; n + 1 < along.size(); ++n)
        if (is_within(along[n], along[n + 1])) pieces.push_back(ascending(Side{along[n], along[n + 1]}));
    }
  }
  sort_unique(pieces);
  for (const Side& piece : pieces) plane.segments.push_back({number[piece[0]], number[piece[1]]});
  const PlaneResult result = triangulate(plane);
  if (result.outcome != Outcome::done || result.mesh.points.size() != plane.points.size()) return false;
  std::map<int, std::pair<double, std::vector<Index>>> cells;  // largest triangle, and the facets there
  for (std::size_t t = 0; t < result.mesh.triangles.size(); ++t) {
    Triangle corners = result.mesh.triangles[t];
    for (Index& v : corners) v = vertices[v];
    const double size = facets_.area(corners, axis);
    const auto [there, is_new] = cells.try_emplace(result.mesh.regions[t]);
    if (is_new || size > there->second.first) there->second = {size, facets_at(corners, f, patch, boxes)};
  }
  for (std::size_t t = 0; t < result.mesh.triangles.size(); ++t) {
    const std::vector<Index>& of = cells.at(result.mesh.regions[t]).second;
    if (of.empty() || facets_.part_of(of[0]) != facets_.part_of(f))
      continue;  // an earlier part's facet has it
    Triangle corners = result.mesh.triangles[t];
    for (Index& v : corners) v = vertices[v];
    if (facets_.area(facets_.corners(f), axis) < 0) std::swap(corners[1], corners[2]);
    std::vector<Index> parents = of;
    std::sort(parents.begin(), parents.end());
    pasted.push_back({corners, std::move(parents)});
  }
  return true;
}

// The facet itself and, of each other part, the one that is nearest to the middle of a piece of it; in the
// order of parts.
std::vector<Index> PatchCutter::facets_at(const Triangle& piece, Index f, const std::vector<Index>& patch,
                                          const std::vector<Box>& boxes) const {
  Point middle{};
  for (const Index v : piece)
    for (std::size_t k = 0; k < 3; ++k) middle[k] += facets_.at(v)[k] / 3;
  std::map<Index, std::pair<double, Index>> nearest;  // by part
  for (std::size_t k = 0; k < patch.size(); ++k) {
    const Index g = patch[k];
    if (facets_.part_of(g) == facets_.part_of(f) || !boxes[k].overlaps({middle, middle})) continue;
    if (std::fabs(dot(facets_.plane(f)->normal, facets_.plane(g)->normal)) < kAlike) continue;
    const auto& [a, b, c] = facets_.corners(g);
    const std::pair near{distance_to(middle, facets_.at(a), facets_.at(b), facets_.at(c)), g};
    if (!(near.first <= gap_)) continue;
    const auto [there, is_new] = nearest.try_emplace(facets_.part_of(g), near);
    if (!is_new) there->second = std::min(there->second, near);
  }
  nearest[facets_.part_of(f)] = {0, f};
  std::vector<Index> facets;
  for (const auto& [part, near] : nearest) facets.push_back(near.second);
  return facets;
}

// For each cell between the sides the facets that it is in, told by the middle of its largest triangle.
std::map<int, std::vector<Index>> PatchCutter::facets_of_cells(const std::vector<Index>& patch,
                                                               std::size_t axis,
                                                               const std::vector<Index>& vertices,
                                                               const PlaneMesh& mesh) const {
  std::map<int, std::pair<double, Triangle>> largest;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    Triangle corners = mesh.triangles[t];
    for (Index& v : corners) v = vertices[v];
    const double size = facets_.area(corners, axis);
    const auto [there, is_new] = largest.try_emplace(mesh.regions[t], size, corners);
    if (!is_new && size > there->second.first) there->second = {size, corners};
  }
  std::vector<Box> boxes;
  std::vector<std::pair<int, PlanePoint>> middles;
  for (const auto& [cell, best] : largest) {
    PlanePoint middle{};
    for (const Index v : best.second)
      for (std::size_t k = 0; k < 2; ++k) middle[k] += facets_.flat(v, axis)[k] / 3;
    middles.emplace_back(cell, middle);
    boxes.push_back({{middle[0], middle[1], 0}, {middle[0], middle[1], 0}});
  }
  for (const Index f : patch) {
    const PlanePoint a = facets_.flat(facets_.corners(f)[0], axis);
    Box box{{a[0], a[1], 0}, {a[0], a[1], 0}};
    for (const Index v : facets_.corners(f)) {
      const PlanePoint p = facets_.flat(v, axis);
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
        const Index f = patch[j - first];
        if (facets_.holds(facets_.corners(f), middles[i].second, axis))
          of_cell[middles[i].first].push_back(f);
        return true;
      },
      [](Index, Index) { return false; }, step_);
  for (auto& [cell, of] : of_cell) sort_unique(of);
  return of_cell;
}

}  // namespace

std::vector<Pasted> paste(const PartFacets& facets, const LedSides& sides, Patches& patches, double gap,
                          double rounding, const Step& step, double& most) {
  PatchCutter cutter(facets, sides, gap, step);
  for (const std::vector<Index>& patch : patches.facets) {
    step(0.6);
    if (is_flat(facets, patch, rounding) ? !cutter.cut_flat(patch) : !cutter.cut_curved(patch))
      for (const Index f : patch) patches.of[f] = no_index;
  }
  most = std::max(most, cutter.most());
  return std::move(cutter).pasted();
}

}  // namespace holdfast::repairing
