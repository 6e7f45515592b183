#include "delaunay/insert.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "exact/predicates.h"

namespace holdfast {
namespace {

constexpr std::uint32_t kTableSide = 64;

// Three points are collinear iff their projections along all axes are.
bool collinear(const double* a, const double* b, const double* c) {
  for (int axis = 0; axis < 3; ++axis)
    if (exact::orient2d({a}, {b}, {c}, axis) != 0) return false;
  return true;
}

bool equal(const double* a, const double* b) { return a[0] == b[0] && a[1] == b[1] && a[2] == b[2]; }

}  // namespace

DelaunayKernel::DelaunayKernel(std::span<const Point> points, std::vector<std::uint32_t> order,
                               std::uint64_t seed)
    : order_(std::move(order)),
      sites_(order_.size() + 1),
      ghost_(static_cast<Vertex>(order_.size())),
      random_state_(seed * 2 + 1),
      table_(kTableSide * kTableSide) {
  for (std::size_t k = 0; k < order_.size(); ++k) sites_[k].x = points[order_[k]];
}

std::uint32_t DelaunayKernel::random() {
  random_state_ ^= random_state_ << 13;
  random_state_ ^= random_state_ >> 7;
  random_state_ ^= random_state_ << 17;
  return static_cast<std::uint32_t>(random_state_ >> 32);
}

bool DelaunayKernel::start() {
  const auto n = static_cast<Vertex>(order_.size());
  const auto move_to = [this](Vertex from, Vertex to) {
    std::rotate(order_.begin() + to, order_.begin() + from, order_.begin() + from + 1);
    std::rotate(sites_.begin() + to, sites_.begin() + from, sites_.begin() + from + 1);
  };
  const auto find = [&](Vertex rank, auto fits) {
    Vertex k = rank;
    while (k < n && !fits(k)) ++k;
    if (k < n) move_to(k, rank);
    return k < n;
  };
  if (n < 4) return false;
  if (!find(1, [&](Vertex k) { return !equal(at(0), at(k)); })) return false;
  if (!find(2, [&](Vertex k) { return !collinear(at(0), at(1), at(k)); })) return false;
  if (!find(3, [&](Vertex k) { return exact::orient3d(at(0), at(1), at(2), at(k)) != 0; })) return false;
  if (exact::orient3d(at(0), at(1), at(2), at(3)) < 0) {
    std::swap(order_[0], order_[1]);
    std::swap(sites_[0], sites_[1]);
  }
  cells_.resize(5);
  cells_[0].v = {0, 1, 2, 3};
  // Ghost 1 + i beyond face i: seen from outside, the face's vertices turn the other way.
  for (int i = 0; i < 4; ++i) {
    const auto& f = kFaceVertex[static_cast<std::size_t>(i)];
    const auto k = [&](int j) { return static_cast<Vertex>(f[static_cast<std::size_t>(j)]); };
    cells_[static_cast<std::size_t>(1 + i)].v = {k(1), k(0), k(2), ghost_};
  }
  // Each cell lacks one of the five vertices, and its neighbour at corner v is the cell that lacks v.
  const auto lacking = [this](Tet t) { return t == 0 ? ghost_ : Vertex{t - 1}; };
  for (Tet s = 0; s < 5; ++s) {
    for (std::size_t i = 0; i < 4; ++i) {
      const Tet t = cells_[s].v[i] == ghost_ ? 0 : cells_[s].v[i] + 1;
      const auto& w = cells_[t].v;
      cells_[s].n[i] = face_code(t, static_cast<int>(std::find(w.begin(), w.end(), lacking(s)) - w.begin()));
    }
    set_geometry(cells_[s]);
  }
  last_ = 0;
  return true;
}

void DelaunayKernel::set_geometry(Cell& cell) {
  const double* p = at(cell.v[0]);
  const Spoke u = spoke(p, at(cell.v[1]));
  const Spoke v = spoke(p, at(cell.v[2]));
  if (is_ghost(cell))
    set_half_space(cell, u, v);
  else
    set_sphere(cell, u, v, spoke(p, at(cell.v[3])));
}

bool DelaunayKernel::in_conflict(const Cell& cell, const double* q) const {
  const int sign = filtered_conflict(cell, is_ghost(cell) ? 0.0 : 1.0, at(cell.v[0]), q);
  if (sign != 0) [[likely]]
    return sign > 0;
  return in_conflict_exact(cell, q);
}

bool DelaunayKernel::in_conflict_exact(const Cell& cell, const double* q) const {
  const Cell* finite = &cell;
  if (is_ghost(cell)) {
    const int side = exact::orient3d(at(cell.v[0]), at(cell.v[1]), at(cell.v[2]), q);
    if (side != 0) return side > 0;
    finite = &cells_[tet_of(cell.n[3])];  // its sphere cuts the face's plane in the face's circumcircle
  }
  const auto& v = finite->v;
  return exact::insphere(at(v[0]), at(v[1]), at(v[2]), at(v[3]), q) > 0;
}

void DelaunayKernel::insert(Vertex k) {
  const double* q = at(k);
  const Tet seed = locate(q);
  if (!in_conflict(cells_[seed], q)) {
    note_duplicate(seed, k);
    return;
  }
  dig(seed, q);
  fill(k);
}

// Remembering stochastic visibility walk (Devillers, Pion, Teillaud 2002): ends with probability one in
// any triangulation. It may stop at any cell in conflict, which the cell that holds q is, unless q
// is one of its corners. A ghost is entered only through a face that q is strictly beyond.
Tet DelaunayKernel::locate(const double* q) {
  Tet t = last_;
  int came = -1;
  for (;;) {
    const Cell& cell = cells_[t];
    if (in_conflict(cell, q)) return t;
    const auto first = static_cast<int>(random() & 3u);
    int out = -1;
    for (int j = 0; j < 4 && out < 0; ++j) {
      const int i = (first + j) & 3;
      if (i == came) continue;
      const auto& f = kFaceVertex[static_cast<std::size_t>(i)];
      const auto corner = [&](std::size_t m) { return at(cell.v[static_cast<std::size_t>(f[m])]); };
      if (exact::orient3d(corner(0), corner(1), corner(2), q) < 0) out = i;
    }
    if (out < 0) return t;
    const Face next = cell.n[static_cast<std::size_t>(out)];
    t = tet_of(next);
    came = side_of(next);
  }
}

// Keeps the first of equal points as the one that stands in the mesh.
void DelaunayKernel::note_duplicate(Tet t, Vertex k) {
  for (const Vertex v : cells_[t].v)
    if (v != ghost_ && equal(at(v), at(k)) && order_[k] < order_[v]) std::swap(order_[k], order_[v]);
}

// Collects the cells in conflict with q and the faces round them.
void DelaunayKernel::dig(Tet seed, const double* q) {
  cavity_.clear();
  boundary_.clear();
  cells_[seed].reach = -1;
  cavity_.push_back(seed);
  for (std::size_t k = 0; k < cavity_.size(); ++k) {
    const Cell& cell = cells_[cavity_[k]];
    for (std::size_t i = 0; i < 4; ++i) {
      Cell& next = cells_[tet_of(cell.n[i])];
      if (next.reach < 0) continue;
      if (in_conflict(next, q)) {
        next.reach = -1;
        cavity_.push_back(tet_of(cell.n[i]));
      } else {
        const auto& f = kFaceVertex[i];
        const auto corner = [&](std::size_t m) { return cell.v[static_cast<std::size_t>(f[m])]; };
        boundary_.push_back({cell.n[i], {corner(0), corner(1), corner(2)}});
      }
    }
  }
}

Tet DelaunayKernel::new_slot() {
  if (!free_.empty()) {
    const Tet t = free_.back();
    free_.pop_back();
    return t;
  }
  cells_.emplace_back();
  return static_cast<Tet>(cells_.size() - 1);
}

std::uint32_t DelaunayKernel::local_index(Vertex v, const double* p) {
  Site& site = sites_[v];
  if (site.local < ring_.size() && ring_[site.local] == v) return site.local;
  site.local = static_cast<std::uint32_t>(ring_.size());
  ring_.push_back(v);
  spokes_.push_back(spoke(p, site.x.data()));
  return site.local;
}

// Joins vertex k to the boundary of the cavity. Every new cell is (k, v1, v0, v2) for a boundary face
// (v0, v1, v2), which keeps the ghost in slot 3.
void DelaunayKernel::fill(Vertex k) {
  const double* p = at(k);
  while (cavity_.size() > boundary_.size()) {
    free_.push_back(cavity_.back());
    cavity_.pop_back();
  }
  while (cavity_.size() < boundary_.size()) cavity_.push_back(new_slot());
  ring_.clear();
  spokes_.clear();
  corners_.resize(boundary_.size());
  for (std::size_t j = 0; j < boundary_.size(); ++j) {
    BoundaryFace& face = boundary_[j];
    auto& v = face.v;
    if (v[0] == ghost_)
      v = {v[1], v[2], v[0]};
    else if (v[1] == ghost_)
      v = {v[2], v[0], v[1]};
    const Tet t = cavity_[j];
    Cell& cell = cells_[t];
    cell.v = {k, v[1], v[0], v[2]};
    cell.n[0] = face.outer;
    cells_[tet_of(face.outer)].n[face.outer & 3u] = face_code(t, 0);
    const std::uint32_t a = local_index(v[0], p), b = local_index(v[1], p), c = local_index(v[2], p);
    corners_[j] = {a, b, c};
    if (v[2] == ghost_) {
      set_half_space(cell, spokes_[b], spokes_[a]);
    } else {
      set_sphere(cell, spokes_[b], spokes_[a], spokes_[c]);
      last_ = t;
    }
  }
  if (ring_.size() <= kTableSide)
    link_by_table();
  else
    link_by_hash();
}

// Faces 3, 2, 1 of a new cell lie at the boundary edges (v0 v1), (v1 v2), (v2 v0); the neighbour has
// the same edge reversed. The boundary is closed, so every entry read has been written.
void DelaunayKernel::link_by_table() {
  for (std::size_t j = 0; j < boundary_.size(); ++j) {
    const auto [a, b, c] = corners_[j];
    const Tet t = cavity_[j];
    table_[a * kTableSide + b] = face_code(t, 3);
    table_[b * kTableSide + c] = face_code(t, 2);
    table_[c * kTableSide + a] = face_code(t, 1);
  }
  for (std::size_t j = 0; j < boundary_.size(); ++j) {
    const auto [a, b, c] = corners_[j];
    Cell& cell = cells_[cavity_[j]];
    cell.n[3] = table_[b * kTableSide + a];
    cell.n[2] = table_[c * kTableSide + b];
    cell.n[1] = table_[a * kTableSide + c];
  }
}

void DelaunayKernel::link_by_hash() {
  const std::size_t size = std::bit_ceil(6 * boundary_.size());
  constexpr std::uint64_t kEmpty = ~std::uint64_t{0};
  hash_.assign(size, {kEmpty, kNone});
  const auto find = [&](std::uint32_t a, std::uint32_t b) -> HashEntry& {
    const std::uint64_t key = std::uint64_t{a} << 32 | b;
    std::size_t h = (key * 0x9E3779B97F4A7C15ull) >> 20 & (size - 1);
    while (hash_[h].key != kEmpty && hash_[h].key != key) h = (h + 1) & (size - 1);
    hash_[h].key = key;
    return hash_[h];
  };
  for (std::size_t j = 0; j < boundary_.size(); ++j) {
    const auto [a, b, c] = corners_[j];
    const Tet t = cavity_[j];
    find(a, b).face = face_code(t, 3);
    find(b, c).face = face_code(t, 2);
    find(c, a).face = face_code(t, 1);
  }
  for (std::size_t j = 0; j < boundary_.size(); ++j) {
    const auto [a, b, c] = corners_[j];
    Cell& cell = cells_[cavity_[j]];
    cell.n[3] = find(b, a).face;
    cell.n[2] = find(c, b).face;
    cell.n[1] = find(a, c).face;
  }
}

void DelaunayKernel::compact() {
  std::sort(free_.begin(), free_.end());
  for (const Tet hole : free_) {
    while (!cells_.empty() && cells_.back().reach < 0) cells_.pop_back();
    if (hole >= cells_.size()) break;
    cells_[hole] = cells_.back();
    cells_.pop_back();
    for (int i = 0; i < 4; ++i) {
      const Face f = cells_[hole].n[static_cast<std::size_t>(i)];
      cells_[tet_of(f)].n[f & 3u] = face_code(hole, i);
    }
  }
  while (!cells_.empty() && cells_.back().reach < 0) cells_.pop_back();
  free_.clear();
}

}  // namespace holdfast
