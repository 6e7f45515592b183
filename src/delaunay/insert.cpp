#include "delaunay/insert.h"

#include <algorithm>
#include <bit>
#include <stdexcept>
#include <utility>

#include "exact/predicates.h"

namespace holdfast {
namespace {

constexpr std::uint32_t kTableSide = 64;
constexpr std::size_t kFirstScratch = 256;
constexpr std::size_t kMostCells = std::size_t{1} << 30;  // a face code has two bits more

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
      rim_(kFirstScratch),
      boundary_(kFirstScratch),
      ring_(kFirstScratch),
      spokes_(kFirstScratch),
      table_(kTableSide * kTableSide) {
  cells_.reserve(7 * order_.size() + 64);  // 6.77 a point of a Poisson process
  Point low{}, high{};
  for (std::size_t k = 0; k < order_.size(); ++k) {
    const Point& p = sites_[k].x = points[order_[k]];
    if (k == 0) low = high = p;
    for (std::size_t i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], p[i]);
      high[i] = std::max(high[i], p[i]);
    }
  }
  for (std::size_t i = 0; i < 3; ++i) diameter_ += high[i] - low[i];
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
  if (is_ghost(cell)) {
    set_half_space(cell, u, v, diameter_);
  } else {
    const Spoke w = spoke(p, at(cell.v[3]));
    Cell other;
    set_spheres({&cell, &other}, {&u, &u}, {&v, &v}, {&w, &w});
  }
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
//
// The outcome of a test is a coin toss to the processor, so both lists are written always and only
// their lengths depend on it; sign bits do the marking.
void DelaunayKernel::dig(Tet seed, const double* q) {
  constexpr std::uint64_t kSign = std::uint64_t{1} << 63;
  Cell* const cells = cells_.data();
  const Site* const sites = sites_.data();
  const double qx = q[0], qy = q[1], qz = q[2];
  std::size_t count = 0;
  std::size_t faces = 0;
  const auto look = [&](const Cell& cell, Tet t, std::size_t i) {
    const Face across = cell.n[i];
    Cell& next = cells[tet_of(across)];
    Filtered test = filtered_conflict(next, sites[next.v[0]].x.data(), qx, qy, qz);
    if (!test.decided) [[unlikely]]
      test.f = in_conflict_exact(next, q) ? -1.0 : 1.0;
    const std::uint64_t conflict = std::bit_cast<std::uint64_t>(test.f) & kSign;
    const std::uint64_t before = std::bit_cast<std::uint64_t>(next.reach);
    const std::uint64_t after = before | conflict;
    next.reach = std::bit_cast<double>(after);
    cavity_[count] = across;
    count += (after ^ before) >> 63;
    rim_[faces] = face_code(t, static_cast<int>(i));
    faces += (after >> 63) ^ 1;
  };
  cells[seed].reach = std::bit_cast<double>(std::bit_cast<std::uint64_t>(cells[seed].reach) | kSign);
  cavity_[count++] = face_code(seed, 0);
  look(cells[seed], seed, 0);
  for (std::size_t k = 0; k < count; ++k) {
    if (count + 4 > cavity_.size()) cavity_.resize(2 * cavity_.size());
    if (faces + 4 > rim_.size()) rim_.resize(2 * rim_.size());
    const Face reached = cavity_[k];
    const Tet t = tet_of(reached);
    const Cell& cell = cells[t];
    for (unsigned j = 1; j < 4; ++j) look(cell, t, (reached + j) & 3u);
  }
  cavity_count_ = count;
  face_count_ = faces;
}

// Finds one slot for each boundary face: those of the cavity first.
void DelaunayKernel::take_slots() {
  while (cavity_count_ > face_count_) free_.push_back(tet_of(cavity_[--cavity_count_]));
  std::size_t j = 0;
  for (; j < cavity_count_; ++j) boundary_[j].slot = tet_of(cavity_[j]);
  for (; j < face_count_ && !free_.empty(); ++j) {
    boundary_[j].slot = free_.back();
    free_.pop_back();
  }
  std::size_t size = cells_.size();
  const std::size_t enough = size + (face_count_ - j);
  if (enough > kMostCells) throw std::length_error("holdfast: more than 2^30 tetrahedra");
  if (enough > cells_.capacity()) cells_.reserve(std::max(enough, cells_.capacity() + cells_.capacity() / 4));
  for (; j < face_count_; ++j) boundary_[j].slot = static_cast<Tet>(size++);
  cells_.resize(size);
}

// Reads the faces round the cavity off its cells, whose slots are about to be used again.
// The boundary face (v0, v1, v2) sees the new vertex p; the new cell is (p, v1, v0, v2), with the ghost last.
template <bool kByTable>
void DelaunayKernel::list_boundary() {
  Cell* const cells = cells_.data();
  Site* const sites = sites_.data();
  Vertex* const ring = ring_.data();
  Face* const table = table_.data();
  const std::size_t count = face_count_;
  std::uint32_t fresh = 0;
  // The place of v in the ring, with v added if it is not there: without a branch, which would be hard
  // to predict. The ring has room for one entry more than it comes to hold.
  const auto local_index = [&](Vertex v) {
    const std::uint32_t old = std::min(sites[v].local, fresh);
    const std::uint32_t known =
        static_cast<std::uint32_t>(old < fresh) & static_cast<std::uint32_t>(ring[old] == v);
    ring[fresh] = v;
    const std::uint32_t local = fresh ^ ((old ^ fresh) & (0u - known));
    sites[v].local = local;
    fresh += 1 - known;
    return local;
  };
  for (std::size_t j = 0; j < count; ++j) {
    const Cell& inner = cells[tet_of(rim_[j])];
    const auto i = static_cast<std::size_t>(side_of(rim_[j]));
    const auto& f = kFaceVertex[i];
    Vertex a = inner.v[static_cast<std::size_t>(f[1])];
    Vertex b = inner.v[static_cast<std::size_t>(f[0])];
    Vertex c = inner.v[static_cast<std::size_t>(f[2])];
    if (a == ghost_) [[unlikely]] {
      a = std::exchange(b, std::exchange(c, a));
    } else if (b == ghost_) [[unlikely]] {
      b = std::exchange(a, std::exchange(c, b));
    }
    const std::uint32_t la = local_index(a), lb = local_index(b), lc = local_index(c);
    BoundaryFace& face = boundary_[j];
    face.outer = inner.n[i];
    face.v = {a, b, c};
    face.local = {la, lb, lc};
    cells[tet_of(face.outer)].n[face.outer & 3u] = face_code(face.slot, 0);
    if constexpr (kByTable) {
      table[lb * kTableSide + lc] = face_code(face.slot, 1);
      table[lc * kTableSide + la] = face_code(face.slot, 2);
      table[la * kTableSide + lb] = face_code(face.slot, 3);
    }
  }
  ring_count_ = fresh;
}

// Joins vertex k to the boundary of the cavity.
void DelaunayKernel::fill(Vertex k) {
  if (boundary_.size() < face_count_) boundary_.resize(rim_.size());
  const std::size_t ring_size = face_count_ / 2 + 2;  // Euler's relation for a sphere of triangles
  if (ring_.size() <= ring_size) {
    ring_.resize(rim_.size());
    spokes_.resize(rim_.size());
  }
  take_slots();
  const bool by_table = ring_size <= kTableSide;
  if (by_table)
    list_boundary<true>();
  else
    list_boundary<false>();
  const double* p = at(k);
  for (std::size_t l = 0; l < ring_count_; ++l) spokes_[l] = spoke(p, at(ring_[l]));
  set_geometry(k);
  if (by_table)
    link_by_table();
  else
    link_by_hash();
}

// The number of faces of a closed surface is even, so they go in pairs.
void DelaunayKernel::set_geometry(Vertex k) {
  Cell* const cells = cells_.data();
  const Spoke* const spokes = spokes_.data();
  bool ghosts = false;
  for (std::size_t j = 0; j < face_count_; j += 2) {
    const BoundaryFace &f = boundary_[j], &g = boundary_[j + 1];
    Cell &s = cells[f.slot], &t = cells[g.slot];
    s.v = {k, f.v[0], f.v[1], f.v[2]};
    t.v = {k, g.v[0], g.v[1], g.v[2]};
    s.n[0] = f.outer;
    t.n[0] = g.outer;
    set_spheres({&s, &t}, {&spokes[f.local[0]], &spokes[g.local[0]]},
                {&spokes[f.local[1]], &spokes[g.local[1]]}, {&spokes[f.local[2]], &spokes[g.local[2]]});
    ghosts = ghosts || f.v[2] == ghost_ || g.v[2] == ghost_;
  }
  last_ = boundary_[0].slot;
  if (!ghosts) [[likely]]
    return;
  for (std::size_t j = 0; j < face_count_; ++j) {
    const BoundaryFace& f = boundary_[j];
    if (f.v[2] == ghost_)
      set_half_space(cells[f.slot], spokes[f.local[0]], spokes[f.local[1]], diameter_);
    else
      last_ = f.slot;
  }
}

// Face i of a new cell (i = 1, 2, 3) lies at the boundary edge opposite local vertex i - 1; the
// neighbour has the same edge reversed. The boundary is closed, so every entry read has been written.
void DelaunayKernel::link_by_table() {
  const Face* const table = table_.data();
  Cell* const cells = cells_.data();
  for (std::size_t j = 0; j < face_count_; ++j) {
    const auto [a, b, c] = boundary_[j].local;
    Cell& cell = cells[boundary_[j].slot];
    cell.n[1] = table[c * kTableSide + b];
    cell.n[2] = table[a * kTableSide + c];
    cell.n[3] = table[b * kTableSide + a];
  }
}

// The same for boundaries with more vertices than the table has sides. Each edge is met twice: the
// first face leaves its code, the second links the two.
void DelaunayKernel::link_by_hash() {
  const std::size_t size = std::bit_ceil(3 * face_count_);
  if (hash_.size() < size) hash_.resize(size);
  const auto shift = static_cast<unsigned>(64 - std::countr_zero(size));
  ++epoch_;
  Cell* const cells = cells_.data();
  const auto meet = [&](std::uint32_t a, std::uint32_t b, Face face) {
    const std::uint64_t key = std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
    std::size_t h = (key * 0x9E3779B97F4A7C15ull) >> shift;
    while (hash_[h].epoch == epoch_ && hash_[h].key != key) h = (h + 1) & (size - 1);
    if (hash_[h].epoch != epoch_) {
      hash_[h] = {key, face, epoch_};
      return;
    }
    const Face other = hash_[h].face;
    cells[tet_of(face)].n[face & 3u] = other;
    cells[tet_of(other)].n[other & 3u] = face;
  };
  for (std::size_t j = 0; j < face_count_; ++j) {
    const auto [a, b, c] = boundary_[j].local;
    const Tet t = boundary_[j].slot;
    meet(b, c, face_code(t, 1));
    meet(c, a, face_code(t, 2));
    meet(a, b, face_code(t, 3));
  }
}

void DelaunayKernel::finish() {
  sites_ = {};
  std::sort(free_.begin(), free_.end());
  const auto drop_free_tail = [this] {
    while (cells_.size() > 0 && std::signbit(cells_[cells_.size() - 1].reach))
      cells_.resize(cells_.size() - 1);
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
  free_ = {};
}

}  // namespace holdfast
