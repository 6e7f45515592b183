// The common triangles of a patch: of a plane one at once, of a curved one facet by facet.
#include <algorithm>
#include <map>
#include <unordered_map>

#include "numbers/sorted.h"
#include "repair/fusing.h"

namespace holdfast::repairing {
namespace {

constexpr double kAlike = 0.5;  // cosine of an angle between facets that are known to belong together

}  // namespace

void Fusing::triangulate_patches() {
  for (Index p = 0; p < patches_.size(); ++p) {
    step_(0.6);
    if (is_flat(patches_[p]) ? !triangulate(p) : !triangulate_curved(patches_[p]))
      for (const Index f : patches_[p]) patch_of_[f] = no_index;
  }
}

bool Fusing::triangulate(Index patch) {
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

bool Fusing::triangulate_curved(const std::vector<Index>& facets) {
  std::vector<Index> in_order = facets;
  std::stable_sort(in_order.begin(), in_order.end(),
                   [&](Index f, Index g) { return part_of(f) < part_of(g); });
  const std::map<Index, std::vector<Index>> inside = vertices_inside(facets);
  std::vector<Box> boxes;
  for (const Index f : in_order) boxes.push_back(box_round(state_, state_.facets[f], gap_));
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

std::map<Index, std::vector<Index>> Fusing::vertices_inside(const std::vector<Index>& facets) const {
  std::vector<Index> vertices;
  for (const Index f : facets)
    vertices.insert(vertices.end(), state_.facets[f].begin(), state_.facets[f].end());
  sort_unique(vertices);
  std::vector<Box> boxes;
  for (const Index v : vertices) boxes.push_back(box_round(state_, std::array{v}, gap_));
  for (const Index f : facets) boxes.push_back(box_round(state_, state_.facets[f], 0));
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

bool Fusing::cut_one(Index f, const std::vector<Index>& inside, const std::vector<Index>& patch,
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
  const Box box = box_round(state_, state_.facets[f], gap_);
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

std::vector<Index> Fusing::facets_at(const Triangle& piece, Index f, const std::vector<Index>& patch,
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

double Fusing::area(const Triangle& t, std::size_t axis) const {
  const PlanePoint a = flat(t[0], axis), b = flat(t[1], axis), c = flat(t[2], axis);
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

std::map<int, std::vector<Index>> Fusing::facets_of_cells(const std::vector<Index>& facets, std::size_t axis,
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

bool Fusing::holds(const Triangle& t, const PlanePoint& p, std::size_t axis) const {
  int left = 0, right = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const PlanePoint a = flat(t[i], axis), b = flat(t[(i + 1) % 3], axis);
    const double side = (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
    if (side > 0) ++left;
    if (side < 0) ++right;
  }
  return left == 0 || right == 0;
}

void Fusing::note_distance(const Triangle& child, const Triangle& facet) {
  for (const Index v : child)
    most_ = std::max(most_, distance_to(at(v), at(facet[0]), at(facet[1]), at(facet[2])));
}

}  // namespace holdfast::repairing
