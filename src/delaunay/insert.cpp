#include "delaunay/insert.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "exact/predicates.h"

namespace holdfast {
namespace {

constexpr std::uint32_t kTableSide = 64;
constexpr std::size_t kFirstScratch = 256;

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
      cavity_(kFirstScratch),
      boundary_(kFirstScratch),
      local_(kFirstScratch),
      ring_(kFirstScratch),
      spokes_(kFirstScratch),
      table_(kTableSide * kTableSide) {
  cells_.reserve(7 * order_.size() + 64);  // 6.77 a point of a Poisson process
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
  const Located seed = locate(q);
  if (!seed.conflict) {
    note_duplicate(seed.tet, k);
    return;
  }
  dig(seed.tet, q);
  take_slots();
  fill(k);
}

// Remembering stochastic visibility walk (Devillers, Pion, Teillaud 2002): ends with probability one in
// any triangulation. It may stop at any cell in conflict, which the cell that holds q is, unless q
// is one of its corners. A ghost is entered only through a face that q is strictly beyond.
DelaunayKernel::Located DelaunayKernel::locate(const double* q) {
  Tet t = last_;
  int came = -1;
  for (;;) {
    const Cell& cell = cells_[t];
    if (in_conflict(cell, q)) return {t, true};
    const auto first = static_cast<int>(random() & 3u);
    int out = -1;
    for (int j = 0; j < 4 && out < 0; ++j) {
      const int i = (first + j) & 3;
      if (i == came) continue;
      const auto& f = kFaceVertex[static_cast<std::size_t>(i)];
      const auto corner = [&](std::size_t m) { return at(cell.v[static_cast<std::size_t>(f[m])]); };
      if (exact::orient3d(corner(0), corner(1), corner(2), q) < 0) out = i;
    }
    if (out < 0) return {t, false};
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
  Cell* const cells = cells_.data();
  cells[seed].reach = -1;
  cavity_[0] = seed;
  std::size_t count = 1;
  std::size_t faces = 0;
  for (std::size_t k = 0; k < count; ++k) {
    if (count + 4 > cavity_.size()) cavity_.resize(2 * cavity_.size());
    if (faces + 4 > boundary_.size()) boundary_.resize(2 * boundary_.size());
    const Cell& cell = cells[cavity_[k]];
    for (std::size_t i = 0; i < 4; ++i) {
      const Face across = cell.n[i];
      Cell& next = cells[tet_of(across)];
      if (next.reach < 0) continue;
      if (in_conflict(next, q)) {
        next.reach = -1;
        cavity_[count++] = tet_of(across);
        for (const Face f : next.n) __builtin_prefetch(&cells[tet_of(f)]);
      } else {
        const auto& f = kFaceVertex[i];
        const auto corner = [&](std::size_t m) { return cell.v[static_cast<std::size_t>(f[m])]; };
        boundary_[faces++] = {across, {corner(0), corner(1), corner(2)}};
      }
    }
  }
  cavity_count_ = count;
  face_count_ = faces;
}

// Makes cavity_ list one slot for each boundary face: those of the cavity first.
void DelaunayKernel::take_slots() {
  while (cavity_count_ > face_count_) free_.push_back(cavity_[--cavity_count_]);
  if (cavity_.size() < face_count_) cavity_.resize(boundary_.size());
  while (cavity_count_ < face_count_ && !free_.empty()) {
    cavity_[cavity_count_++] = free_.back();
    free_.pop_back();
  }
  const std::size_t fresh = cells_.size();
  const std::size_t size = fresh + (face_count_ - cavity_count_);
  if (size > cells_.capacity()) cells_.reserve(std::max(size, cells_.capacity() + cells_.capacity() / 4));
  cells_.resize(size);
  for (std::size_t t = fresh; t < size; ++t) cavity_[cavity_count_++] = static_cast<Tet>(t);
}

inline std::uint32_t DelaunayKernel::local_index(Vertex v, const double* p) {
  Site& site = sites_[v];
  const std::uint32_t l = site.local;
  if (l < ring_count_ && ring_[l] == v) return l;
  const std::size_t fresh = ring_count_++;
  ring_[fresh] = v;
  spokes_[fresh] = spoke(p, site.x.data());
  site.local = static_cast<std::uint32_t>(fresh);
  return site.local;
}

// Joins vertex k to the boundary of the cavity. Every new cell is (k, v1, v0, v2) for a boundary face
// (v0, v1, v2), which keeps the ghost in slot 3.
void DelaunayKernel::fill(Vertex k) {
  const double* p = at(k);
  if (local_.size() < face_count_) local_.resize(boundary_.size());
  if (ring_.size() < face_count_) {  // a closed surface of F triangles has F / 2 + 2 vertices
    ring_.resize(boundary_.size());
    spokes_.resize(boundary_.size());
  }
  ring_count_ = 0;
  Cell* const cells = cells_.data();
  for (std::size_t j = 0; j < face_count_; ++j) {
    const Face outer = boundary_[j].outer;
    auto v = boundary_[j].v;
    if (v[0] == ghost_)
      v = {v[1], v[2], v[0]};
    else if (v[1] == ghost_)
      v = {v[2], v[0], v[1]};
    const Tet t = cavity_[j];
    cells[t].v = {k, v[1], v[0], v[2]};
    cells[t].n[0] = outer;
    cells[tet_of(outer)].n[outer & 3u] = face_code(t, 0);
    local_[j] = {local_index(v[0], p), local_index(v[1], p), local_index(v[2], p)};
  }
  set_geometry();
  if (ring_count_ <= kTableSide)
    link_by_table();
  else
    link_by_hash();
}

void DelaunayKernel::set_geometry() {
  Cell* const cells = cells_.data();
  for (std::size_t j = 0; j < face_count_; ++j) {
    Cell& cell = cells[cavity_[j]];
    const auto [a, b, c] = local_[j];
    if (is_ghost(cell)) {
      set_half_space(cell, spokes_[b], spokes_[a]);
    } else {
      set_sphere(cell, spokes_[b], spokes_[a], spokes_[c]);
      last_ = cavity_[j];
    }
  }
}

// Faces 3, 2, 1 of a new cell lie at the boundary edges (v0 v1), (v1 v2), (v2 v0); the neighbour has
// the same edge reversed. The boundary is closed, so every entry read has been written.
void DelaunayKernel::link_by_table() {
  for (std::size_t j = 0; j < face_count_; ++j) {
    const auto [a, b, c] = local_[j];
    const Tet t = cavity_[j];
    table_[a * kTableSide + b] = face_code(t, 3);
    table_[b * kTableSide + c] = face_code(t, 2);
    table_[c * kTableSide + a] = face_code(t, 1);
  }
  for (std::size_t j = 0; j < face_count_; ++j) {
    const auto [a, b, c] = local_[j];
    Cell& cell = cells_[cavity_[j]];
    cell.n[3] = table_[b * kTableSide + a];
    cell.n[2] = table_[c * kTableSide + b];
    cell.n[1] = table_[a * kTableSide + c];
  }
}

void DelaunayKernel::link_by_hash() {
  const std::size_t size = std::bit_ceil(6 * face_count_);
  constexpr std::uint64_t kEmpty = ~std::uint64_t{0};
  hash_.assign(size, {kEmpty, kNone});
  const auto find = [&](std::uint32_t a, std::uint32_t b) -> HashEntry& {
    const std::uint64_t key = std::uint64_t{a} << 32 | b;
    std::size_t h = (key * 0x9E3779B97F4A7C15ull) >> 20 & (size - 1);
    while (hash_[h].key != kEmpty && hash_[h].key != key) h = (h + 1) & (size - 1);
    hash_[h].key = key;
    return hash_[h];
  };
  for (std::size_t j = 0; j < face_count_; ++j) {
    const auto [a, b, c] = local_[j];
    const Tet t = cavity_[j];
    find(a, b).face = face_code(t, 3);
    find(b, c).face = face_code(t, 2);
    find(c, a).face = face_code(t, 1);
  }
  for (std::size_t j = 0; j < face_count_; ++j) {
    const auto [a, b, c] = local_[j];
    Cell& cell = cells_[cavity_[j]];
    cell.n[3] = find(b, a).face;
    cell.n[2] = find(c, b).face;
    cell.n[1] = find(a, c).face;
  }
}

void DelaunayKernel::compact() {
  std::sort(free_.begin(), free_.end());
  const auto drop_free_tail = [this] {
    while (cells_.size() > 0 && cells_[cells_.size() - 1].reach < 0) cells_.resize(cells_.size() - 1);
  };
  for (const Tet hole : free_) {
    drop_free_tail();
    if (hole >= cells_.size()) break;
    cells_[hole] = cells_[cells_.size() - 1];
    cells_.resize(cells_.size() - 1);
    for (int i = 0; i < 4; ++i) {
      const Face f = cells_[hole].n[static_cast<std::size_t>(i)];
      cells_[tet_of(f)].n[f & 3u] = face_code(hole, i);
    }
  }
  drop_free_tail();
  free_.clear();
}

}  // namespace holdfast
