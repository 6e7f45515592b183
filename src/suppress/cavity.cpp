#include "suppress/cavity.h"

#include <algorithm>
#include <numeric>

#include "numbers/random.h"
#include "numbers/sorted.h"

namespace holdfast {

bool any_holds(std::span<const std::array<Vertex, 3>> faces, Vertex v) {
  return std::any_of(faces.begin(), faces.end(),
                     [&](const auto& f) { return f[0] == v || f[1] == v || f[2] == v; });
}

bool any_holds(std::span<const std::array<Vertex, 3>> faces, Vertex u, Vertex v) {
  return std::any_of(faces.begin(), faces.end(), [&](const auto& f) {
    return std::find(f.begin(), f.end(), u) != f.end() && std::find(f.begin(), f.end(), v) != f.end();
  });
}

Cavity::Cavity(const TetMesh& mesh, std::span<const Tet> ball, Vertex first_free)
    : mesh_(mesh), first_free_(first_free), tets_(ball.begin(), ball.end()) {
  collect_faces();
}

bool Cavity::grow(std::mt19937_64& random) {
  // Twice the tetrahedron, plus one if it adds a vertex. A tetrahedron across several faces adds none.
  candidates_.clear();
  const std::vector<Vertex>& boundary = corners();
  for (std::size_t k = 0; k < across_.size(); ++k) {
    const bool brings = !std::binary_search(boundary.begin(), boundary.end(), apexes_[k]);
    candidates_.push_back(std::uint64_t{across_[k]} * 2 + (brings ? 1 : 0));
  }
  sort_unique(candidates_);
  numbers::shuffle(candidates_.begin(), candidates_.end(), random);
  const auto add_any = [&](bool bringing) {
    return std::any_of(candidates_.begin(), candidates_.end(), [&](std::uint64_t candidate) {
      return (candidate % 2 != 0) == bringing && add(static_cast<Tet>(candidate / 2));
    });
  };
  return add_any(false) || add_any(true);
}

bool Cavity::grow_across(std::size_t k) { return add(across_[k]); }

bool Cavity::grow_across_lowest(const std::vector<double>& heights) {
  std::vector<std::size_t> order(heights.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t i, std::size_t j) { return heights[i] < heights[j]; });
  return std::any_of(order.begin(), order.end(), [&](std::size_t k) { return grow_across(k); });
}

bool Cavity::swallow(std::span<const Tet> ball) {
  const std::size_t before = tets_.size();
  for (const Tet t : ball) {
    if (holds(t)) continue;
    if (!may_add(t)) {
      drop_from(before);
      return false;
    }
    tets_.push_back(t);
  }
  collect_faces();
  if (std::none_of(ball.begin(), ball.end(), [&](Tet t) { return encloses_a_constraint(t); })) return true;
  drop_from(before);
  return false;
}

bool Cavity::add(Tet t) {
  if (!may_add(t)) return false;
  std::swap(faces_, faces_before_);
  std::swap(across_, across_before_);
  std::swap(apexes_, apexes_before_);
  faces_.clear();
  across_.clear();
  apexes_.clear();
  for (std::size_t k = 0; k < faces_before_.size(); ++k) {
    if (across_before_[k] == t) continue;
    faces_.push_back(faces_before_[k]);
    across_.push_back(across_before_[k]);
    apexes_.push_back(apexes_before_[k]);
  }
  tets_.push_back(t);
  collect_faces_of(t);
  if (!encloses_a_constraint(t)) {
    renew_corners(t);
    return true;
  }
  tets_.pop_back();
  std::swap(faces_, faces_before_);
  std::swap(across_, across_before_);
  std::swap(apexes_, apexes_before_);
  return false;
}

// Corners of the added tetrahedron may be new, or may now be inside.
void Cavity::renew_corners(Tet t) {
  if (corners_.empty()) return;
  for (const Vertex v : mesh_.corners(t)) {
    const auto at = std::lower_bound(corners_.begin(), corners_.end(), v);
    const bool is_known = at != corners_.end() && *at == v;
    if (!on_boundary(v)) {
      if (is_known) corners_.erase(at);
    } else if (!is_known) {
      corners_.insert(at, v);
    }
  }
}

void Cavity::drop_from(std::size_t size) {
  tets_.resize(size);
  collect_faces();
}

// Whether adding tetrahedron t has enclosed an input vertex or a segment.
bool Cavity::encloses_a_constraint(Tet t) const {
  const auto& v = mesh_.corners(t);
  if (std::any_of(v.begin(), v.end(), [&](Vertex x) { return x < first_free_ && !on_boundary(x); }))
    return true;
  for (int k = 0; k < 6; ++k) {
    const auto [a, b] = ends_of_edge(v, k);
    if (mesh_.is_segment(t, k) && !on_boundary(a, b)) return true;
  }
  return false;
}

const std::vector<Vertex>& Cavity::corners() const {
  if (corners_.empty()) corners_ = corners_of_all(faces_);
  return corners_;
}

std::vector<Vertex> Cavity::inner() const {
  std::vector<Vertex> out;
  for (const Tet t : tets_)
    for (const Vertex v : mesh_.corners(t))
      if (v >= first_free_ && !on_boundary(v)) out.push_back(v);
  sort_unique(out);
  return out;
}

bool Cavity::holds(Tet t) const { return std::find(tets_.begin(), tets_.end(), t) != tets_.end(); }

bool Cavity::may_add(Tet t) const {
  for (int i = 0; i < 4; ++i)
    if (mesh_.is_facet(face_code(t, i)) && holds(tet_of(mesh_.neighbour(t, i)))) return false;
  return !mesh_.is_ghost(t);
}

void Cavity::collect_faces() {
  corners_.clear();
  faces_.clear();
  across_.clear();
  apexes_.clear();
  for (const Tet t : tets_) collect_faces_of(t);
}

void Cavity::collect_faces_of(Tet t) {
  for (int i = 0; i < 4; ++i) {
    const Face across = mesh_.neighbour(t, i);
    const Tet s = tet_of(across);
    if (holds(s)) continue;
    faces_.push_back(mesh_.face_vertices(face_code(t, i)));
    across_.push_back(s);
    apexes_.push_back(mesh_.apex(across));
  }
}

}  // namespace holdfast
