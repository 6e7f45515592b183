#include "delaunay/triangulation.h"

#include <algorithm>
#include <mutex>
#include <stdexcept>
#include <utility>

#include "exact/predicates.h"
#include "mesh/parallel.h"

namespace holdfast {
namespace {

constexpr std::size_t kMostCells = std::size_t{1} << 30;  // a face code has two bits more
constexpr std::size_t kSlotBlock = 256;
constexpr std::size_t kSlotBlockInSlab = 32768;  // a huge page, so that two threads rarely wait for one
constexpr std::size_t kCellsAPoint = 10;         // 6.77 in a Poisson process, 8 on a surface; room is free

// Three points are collinear iff their projections along all axes are.
bool collinear(const double* a, const double* b, const double* c) {
  for (int axis = 0; axis < 3; ++axis)
    if (exact::orient2d({a}, {b}, {c}, axis) != 0) return false;
  return true;
}

// Slots for the cells of so many points. Several inserters leave parts of blocks unused and cannot grow the
// array.
std::size_t room_for(std::size_t points, unsigned inserters) {
  const std::size_t room = kCellsAPoint * points + kSlotBlock;
  return inserters == 1 ? room : room + points + 2 * inserters * kSlotBlockInSlab;
}

bool equal(const double* a, const double* b) { return a[0] == b[0] && a[1] == b[1] && a[2] == b[2]; }

}  // namespace

Triangulation::Triangulation(std::span<const Point> points, InsertionOrder order, const Threads& threads)
    : order_(std::move(order)),
      sites_(order_.points.size() + threads.count()),
      ghost_(static_cast<Vertex>(order_.points.size())) {
  cells_.reserve(room_for(size(), threads.count()));
  read_sites(points, threads);
}

void Triangulation::read_sites(std::span<const Point> points, const Threads& threads) {
  if (points.empty()) return;
  Point low = points[0], high = points[0];
  std::mutex both;
  parallel_ranges(threads, size(), [&](std::size_t first, std::size_t last) {
    Point low_here = points[0], high_here = points[0];
    for (std::size_t k = first; k < last; ++k) {
      const Point& p = points[order_.points[k]];
      sites_[k] = {p, 0, 0};
      for (std::size_t i = 0; i < 3; ++i) {
        low_here[i] = std::min(low_here[i], p[i]);
        high_here[i] = std::max(high_here[i], p[i]);
      }
    }
    const std::lock_guard lock(both);
    for (std::size_t i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], low_here[i]);
      high[i] = std::max(high[i], high_here[i]);
    }
  });
  for (std::size_t k = size(); k < sites_.size(); ++k) sites_[k] = {};
  for (std::size_t i = 0; i < 3; ++i) diameter_ += high[i] - low[i];
}

bool Triangulation::start() {
  const auto is_apart = [this](Vertex k) { return !equal(at(0), at(k)); };
  const auto is_off_line = [this](Vertex k) { return !collinear(at(0), at(1), at(k)); };
  const auto is_off_plane = [this](Vertex k) { return exact::orient3d(at(0), at(1), at(2), at(k)) != 0; };
  if (size() < 4 || !choose(1, is_apart) || !choose(2, is_off_line) || !choose(3, is_off_plane)) return false;
  if (exact::orient3d(at(0), at(1), at(2), at(3)) < 0) {
    std::swap(order_.points[0], order_.points[1]);
    std::swap(sites_[0], sites_[1]);
  }
  make_first_cells();
  return true;
}

// Makes the first vertex from `rank` on that fits vertex `rank`; false if none does.
template <typename Fits>
bool Triangulation::choose(Vertex rank, const Fits& fits) {
  Vertex k = rank;
  while (k < size() && !fits(k)) ++k;
  if (k == size()) return false;
  move_forward(k, rank);
  return true;
}

// The vertices in between move back by one, and the ends of rounds with them.
void Triangulation::move_forward(Vertex from, Vertex to) {
  auto& points = order_.points;
  std::rotate(points.begin() + to, points.begin() + from, points.begin() + from + 1);
  std::rotate(&sites_[to], &sites_[from], &sites_[from] + 1);
  for (std::size_t& end : order_.ends)
    if (to < end && end <= from) ++end;
}

// Cell 0 and ghost 1 + i beyond face i. Seen from outside, the face's vertices turn the other way.
void Triangulation::make_first_cells() {
  cells_.resize(5);
  claimed_ = 5;
  cells_[0].v = {3, 2, 1, 0};
  sites_[3].cells = 1;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto& f = kFaceVertex[i];
    auto k = [&](std::size_t j) { return cells_[0].v[static_cast<std::size_t>(f[j])]; };
    std::array<Vertex, 3> corner{k(1), k(0), k(2)};
    std::rotate(corner.begin(), std::max_element(corner.begin(), corner.end()), corner.end());
    cells_[1 + i].v = {corner[0], corner[1], corner[2], ghost_};
  }
  // Each cell lacks one of the five vertices; its neighbour at corner v is the cell that lacks v.
  const auto lacking = [this](Tet t) { return t == 0 ? ghost_ : cells_[0].v[t - 1]; };
  const auto that_lacks = [&](Vertex v) {
    Tet t = 0;
    while (lacking(t) != v) ++t;
    return t;
  };
  for (Tet s = 0; s < 5; ++s) {
    for (std::size_t i = 0; i < 4; ++i) {
      const Tet t = that_lacks(cells_[s].v[i]);
      const auto& w = cells_[t].v;
      cells_[s].n[i] = face_code(t, static_cast<int>(std::find(w.begin(), w.end(), lacking(s)) - w.begin()));
    }
    set_geometry(cells_[s]);
  }
}

SlotBlock Triangulation::grow_slots(std::size_t needed) {
  const std::size_t first = cells_.size();
  const std::size_t end = first + std::max(needed, kSlotBlock);
  if (end > kMostCells) throw std::length_error("holdfast: more than 2^30 tetrahedra");
  if (end > cells_.capacity()) cells_.reserve(std::max(end, cells_.capacity() + cells_.capacity() / 4));
  cells_.resize(end);
  claimed_ = end;
  return {static_cast<Tet>(first), static_cast<Tet>(end)};
}

SlotBlock Triangulation::claim_slots(std::size_t needed) {
  const std::size_t count = std::max(needed, kSlotBlockInSlab);
  const std::size_t first = claimed_.fetch_add(count, std::memory_order_relaxed);
  if (first + count <= std::min(cells_.capacity(), kMostCells))
    return {static_cast<Tet>(first), static_cast<Tet>(first + count)};
  claimed_.fetch_sub(count, std::memory_order_relaxed);
  return {};
}

void Triangulation::expect_points(std::size_t count, unsigned inserters) {
  cells_.reserve(std::min(cells_.size() + room_for(count, inserters), kMostCells));
}

void Triangulation::note_duplicate(Vertex standing, Vertex other) {
  auto& points = order_.points;
  if (points[other] < points[standing]) std::swap(points[other], points[standing]);
}

void Triangulation::set_geometry(Cell& cell) const {
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

// The cell whose sphere decides for points in the plane of a ghost's hull face: that sphere cuts the plane in
// the face's circumcircle.
const Cell& Triangulation::sphere_of(const Cell& cell) const {
  return is_ghost(cell) ? cells_[tet_of(cell.n[3])] : cell;
}

// Positive inside the ball or beyond the hull face, 0 on the sphere or, in the plane, on the circle.
int Triangulation::conflict_sign(const Cell& cell, const double* q) const {
  if (is_ghost(cell)) {
    const int side = exact::orient3d(at(cell.v[0]), at(cell.v[1]), at(cell.v[2]), q);
    if (side != 0) return side;
  }
  const auto& v = sphere_of(cell).v;
  return exact::insphere(at(v[0]), at(v[1]), at(v[2]), at(v[3]), q);
}

template <bool kInOrder>
bool Triangulation::in_conflict_exact(const Cell& cell, const double* q, Vertex k) const {
  const int sign = conflict_sign(cell, q);
  if (sign != 0) return sign > 0;
  return kInOrder || lowered_into_conflict(sphere_of(cell), q, k);
}

template bool Triangulation::in_conflict_exact<true>(const Cell&, const double*, Vertex) const;
template bool Triangulation::in_conflict_exact<false>(const Cell&, const double*, Vertex) const;

// Vertex k, at q, is on the sphere of a positive cell. Lowering k puts it inside. Lowering corner i puts k
// inside iff q lies strictly beyond the face opposite that corner: insphere (a b c d q) = -insphere (q b c d
// a), which rises as a falls if (q b c d) is negative. That orientation is 0 for a corner outside the common
// plane of a hull face and q, so ghosts are decided in their plane.
bool Triangulation::lowered_into_conflict(const Cell& cell, const double* q, Vertex k) const {
  std::array<std::size_t, 4> corners{0, 1, 2, 3};
  std::sort(corners.begin(), corners.end(),
            [&](std::size_t i, std::size_t j) { return cell.v[i] > cell.v[j]; });
  for (const std::size_t i : corners) {
    if (cell.v[i] < k) return true;
    std::array<const double*, 4> p{at(cell.v[0]), at(cell.v[1]), at(cell.v[2]), at(cell.v[3])};
    p[i] = q;
    const int side = exact::orient3d(p[0], p[1], p[2], p[3]);
    if (side != 0) return side < 0;
  }
  return true;
}

}  // namespace holdfast
