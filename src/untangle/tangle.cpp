#include "untangle/tangle.h"

#include <algorithm>
#include <cmath>

#include "mesh/editor.h"

namespace holdfast {

Tangle::Tangle(std::span<const Point> points, std::vector<Corners> tets, std::vector<int> regions,
               Constraints constraints, const exact::DoubleGrid& grid)
    : corners_(std::move(tets)), constraints_(std::move(constraints)) {
  MeshEditor(points_).reserve(points.size(), 0);
  MeshEditor(points_).set_grid(grid);
  for (const Point& p : points) MeshEditor(points_).add_vertex(p);
  star_.resize(points.size());
  region_of_.reserve(corners_.size());
  sign_.assign(corners_.size(), 1);
  for (Tet t = 0; t < corners_.size(); ++t) {
    region_of_.push_back({regions[t], true});
    for (const Vertex v : corners_[t]) star_[v].push_back(t);
    set_sign(t);
  }
}

void Tangle::set_sign(Tet t) {
  const Corners& c = corners_[t];
  const bool was_positive = sign_[t] > 0;
  sign_[t] = static_cast<std::int8_t>(points_.orient(c[0], c[1], c[2], c[3]));
  const bool is_positive = sign_[t] > 0;
  if (was_positive && !is_positive) ++nonpositive_;
  if (!was_positive && is_positive) --nonpositive_;
}

Vertex Tangle::add_vertex(const Point& p) {
  star_.emplace_back();
  constraints_.fixed.push_back(false);
  return MeshEditor(points_).add_vertex(p);
}

void Tangle::move_vertex(Vertex v, const Point& p) {
  MeshEditor(points_).move_vertex(v, p);
  for (const Tet t : star_[v]) set_sign(t);
}

int Tangle::index_of(Tet t, Vertex v) const {
  const Corners& c = corners_[t];
  return c[0] == v ? 0 : c[1] == v ? 1 : c[2] == v ? 2 : c[3] == v ? 3 : -1;
}

std::array<Vertex, 3> Tangle::face(Tet t, int i) const { return corners_of_face(corners_[t], i); }

Tet Tangle::across(Tet t, int i) const {
  const std::array<Vertex, 3> f = face(t, i);
  for (const Tet s : star_[f[0]])
    if (s != t && holds(s, f[1]) && holds(s, f[2])) return s;
  return kNone;
}

std::vector<Tet> Tangle::nonpositive() const {
  std::vector<Tet> out;
  for (Tet t = 0; t < corners_.size(); ++t)
    if (alive(t) && sign_[t] <= 0) out.push_back(t);
  return out;
}

void Tangle::exchange(std::span<const Tet> old_tets, std::span<const Corners> new_tets) {
  const int region = region_of_[old_tets[0]].id;
  for (const Tet t : old_tets) remove_tet(t);
  for (const Corners& c : new_tets) add_tet(c, region);
}

void Tangle::remove_tet(Tet t) {
  for (const Vertex v : corners_[t]) {
    std::vector<Tet>& star = star_[v];
    *std::find(star.begin(), star.end(), t) = star.back();
    star.pop_back();
  }
  if (sign_[t] <= 0) --nonpositive_;
  sign_[t] = 1;
  region_of_[t].alive = false;
  dead_.push_back(t);
}

Tet Tangle::add_tet(const Corners& corners, int region) {
  auto t = static_cast<Tet>(corners_.size());
  if (dead_.empty()) {
    corners_.push_back(corners);
    region_of_.push_back({region, true});
    sign_.push_back(1);
  } else {
    t = dead_.back();
    dead_.pop_back();
    corners_[t] = corners;
    region_of_[t] = {region, true};
  }
  for (const Vertex v : corners) star_[v].push_back(t);
  set_sign(t);
  return t;
}

bool Tangle::has_edge(Vertex a, Vertex b) const {
  if (star_[b].size() < star_[a].size()) std::swap(a, b);
  return std::any_of(star_[a].begin(), star_[a].end(), [&](Tet t) { return holds(t, b); });
}

bool Tangle::has_face(Vertex a, Vertex b, Vertex c) const {
  return std::any_of(star_[a].begin(), star_[a].end(), [&](Tet t) { return holds(t, b) && holds(t, c); });
}

bool Tangle::is_constraint(std::array<Vertex, 3> face) const {
  return std::binary_search(constraints_.faces.begin(), constraints_.faces.end(), ascending(face));
}

bool Tangle::is_segment(Vertex a, Vertex b) const {
  return std::binary_search(constraints_.segments.begin(), constraints_.segments.end(),
                            ascending(std::array<Vertex, 2>{a, b}));
}

exact::Bounded Tangle::determinant(const Corners& c) const {
  return exact::bounded_determinant(position(c[0]), position(c[1]), position(c[2]), position(c[3]));
}

exact::Bounded Tangle::absolute_volume(const Corners& c) const {
  exact::Bounded volume = determinant(c);
  volume.value = std::abs(volume.value);
  return volume;
}

Deficit Tangle::deficit(const Corners& c) const {
  const int sign = points_.orient(c[0], c[1], c[2], c[3]);
  if (sign > 0) return {};
  return {sign < 0 ? absolute_volume(c) : exact::Bounded{}, 1};
}

Deficit Tangle::deficit(std::span<const Tet> tets) const {
  Deficit sum;
  for (const Tet t : tets)
    if (sign_[t] <= 0) sum += {sign_[t] < 0 ? absolute_volume(corners_[t]) : exact::Bounded{}, 1};
  return sum;
}

Deficit Tangle::deficit() const { return deficit(nonpositive()); }

}  // namespace holdfast
