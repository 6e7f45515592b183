#include "refine/parts.h"

#include <algorithm>
#include <numeric>

#include "mesh/assembly.h"
#include "mesh/parallel.h"
#include "numbers/sorted.h"
#include "refine/order.h"

namespace holdfast {
namespace {

constexpr Flags kConstraintBits = kFacetBits | kSegmentBits;
constexpr std::size_t kSlotsAtOnce = std::size_t{1} << 18;  // new pages: milliseconds of the system's work

}  // namespace

class PartMaker {
 public:
  /// `local_of`, by slot of the whole mesh, is the number of a tetrahedron in its part: its place in `tets`.
  PartMaker(const VolumeData& whole, const std::vector<std::uint32_t>& part_of,
            const std::vector<Tet>& local_of, const std::vector<Tet>& tets, Part& part)
      : whole_(whole), part_of_(part_of), local_of_(local_of), tets_(tets), part_(part) {}

  void make(const Threads& threads) {
    using Step = void (PartMaker::*)();
    for (const Step step :
         {&PartMaker::copy_neighbours, &PartMaker::number_vertices, &PartMaker::copy_vertices,
          &PartMaker::copy_tets, &PartMaker::copy_flags, &PartMaker::hold_and_link}) {
      (this->*step)();
      threads.poll();
    }
  }

 private:
  // Ghosts follow the tetrahedra, in the order of the faces on which they stand.
  void copy_neighbours() {
    const TetMesh& mesh = whole_.mesh;
    const auto count = static_cast<Tet>(tets_.size());
    const std::uint32_t own = part_of_[tets_.front()];
    part_.first_ghost_ = count;
    cells_.resize(count);
    for (Tet k = 0; k < count; ++k)
      for (int i = 0; i < 4; ++i) {
        const Face f = face_code(tets_[k], i), g = mesh.neighbour(f);
        const std::uint32_t next = part_of_[tet_of(g)];
        if (next == own) {
          cells_[k].neighbours[static_cast<std::size_t>(i)] = face_code(local_of_[tet_of(g)], side_of(g));
          continue;
        }
        const auto ghost = count + static_cast<Tet>(part_.bounds_.size());
        cells_[k].neighbours[static_cast<std::size_t>(i)] = face_code(ghost, 3);
        const bool is_interface = !mesh.is_facet(f) && !mesh.is_ghost(tet_of(g));
        part_.bounds_.push_back({f, g, is_interface, next != kNone});
      }
  }

  // Vertices that must stay come first. The tetrahedra are ordered along a curve, and so are their vertices.
  void number_vertices() {
    const TetMesh& mesh = whole_.mesh;
    enum : std::uint8_t { kOnInterface = 1, kOnCut = 2 };
    std::vector<std::uint8_t> where(mesh.vertex_count(), 0);
    for (const Part::Bound& bound : part_.bounds_)
      if (bound.is_interface)
        for (const Vertex v : mesh.face_vertices(bound.inner))
          where[v] |= bound.is_next_a_part ? kOnInterface | kOnCut : kOnInterface;
    std::vector<Vertex> free;
    place_.assign(mesh.vertex_count(), kNone);
    for (const Tet t : tets_)
      for (const Vertex v : mesh.corners(t)) {
        if (place_[v] != kNone) continue;
        const bool stands = v < whole_.first_free || where[v] != 0;
        std::vector<Vertex>& list = stands ? part_.vertices_ : free;
        place_[v] = static_cast<Vertex>(list.size());
        list.push_back(v);
        if (stands) part_.on_cut_.push_back((where[v] & kOnCut) != 0 ? 1 : 0);
      }
    part_.first_free = static_cast<Vertex>(part_.vertices_.size());
    for (const Vertex v : free) place_[v] += part_.first_free;
    part_.vertices_.insert(part_.vertices_.end(), free.begin(), free.end());
  }

  void copy_vertices() {
    MeshAssembly(part_.mesh).set_grid(whole_.mesh.grid());
    MeshAssembly(part_.mesh).add_vertices(part_.vertices_.size());
    part_.sizes.resize(part_.vertices_.size());
    for (Vertex v = 0; v < part_.vertices_.size(); ++v) {
      MeshAssembly(part_.mesh).place_vertex(v, whole_.mesh.position(part_.vertices_[v]));
      part_.sizes[v] = whole_.sizes[part_.vertices_[v]];
    }
    if (whole_.metrics == nullptr) return;
    for (const Vertex v : part_.vertices_) part_.metrics.push_back((*whole_.metrics)[v]);
  }

  void copy_tets() {
    const TetMesh& mesh = whole_.mesh;
    const std::size_t tets = tets_.size(), all = tets + part_.bounds_.size();
    part_.region_of.assign(all, 0);
    for (std::size_t k = 0; k < tets; ++k) {
      const TetMesh::Corners& c = mesh.corners(tets_[k]);
      cells_[k].corners = {place_[c[0]], place_[c[1]], place_[c[2]], place_[c[3]]};
      part_.region_of[k] = whole_.region_of[tets_[k]];
    }
    cells_.reserve(all);
    for (std::size_t k = tets; k < all; ++k) {
      const Face inner = part_.bounds_[k - tets].inner;
      const auto v = mesh.face_vertices(inner);
      cells_.push_back({{place_[v[0]], place_[v[2]], place_[v[1]], kGhost},
                        {kNone, kNone, kNone, face_code(local_of_[tet_of(inner)], side_of(inner))}});
    }
    MeshAssembly(part_.mesh).set_tets(std::move(cells_));
  }

  void copy_flags() {
    for (Tet t = 0; t < part_.first_ghost_; ++t)
      MeshAssembly(part_.mesh)
          .set_flags(t, static_cast<Flags>(whole_.mesh.flags(tets_[t]) & kConstraintBits));
  }

  // Two ghosts are neighbours if turning through the part leads from one to the other.
  void hold_and_link() {
    TetMesh& mesh = part_.mesh;
    for (Tet ghost = part_.first_ghost_; ghost < mesh.slot_count(); ++ghost) {
      if (part_.is_beyond_interface(ghost)) part_.hold_interface(ghost);
      for (int j = 0; j < 3; ++j)
        if (mesh.neighbour(ghost, j) == kNone)
          MeshAssembly(mesh).link(face_code(ghost, j), part_.turn(mesh.neighbour(ghost, 3),
                                                                  mesh.corner(ghost, j), [](Tet, int) {}));
    }
    for (Tet ghost = part_.first_ghost_; ghost < mesh.slot_count(); ++ghost) part_.copy_constraints_to(ghost);
    MeshAssembly(mesh).finish();
  }

  const VolumeData& whole_;
  const std::vector<std::uint32_t>& part_of_;
  const std::vector<Tet>& local_of_;
  const std::vector<Tet>& tets_;
  Part& part_;
  std::vector<TetMesh::Cell> cells_;
  std::vector<Vertex> place_;  // in the part, by vertex of the whole that is there
};

// Turns round an edge of the face `in`, the one opposite the vertex `across`, from the tetrahedron of `in` to
// a ghost. Calls act(t, edge) for every tetrahedron on the way. Returns the face of the ghost at the edge.
template <typename Act>
Face Part::turn(Face in, Vertex across, Act&& act) const {
  while (!mesh.is_ghost(tet_of(in))) {
    const Tet t = tet_of(in);
    const Vertex apex = mesh.apex(in);
    const int out = mesh.index_of(t, across);
    const auto& ends = opposite_corners(out, side_of(in));
    act(t, edge_between(ends[0], ends[1]));
    in = mesh.neighbour(t, out);
    across = apex;
  }
  return face_code(tet_of(in), mesh.index_of(tet_of(in), across));
}

void Part::hold_interface(Tet ghost) {
  const Face inner = mesh.neighbour(ghost, 3);
  MeshAssembly(mesh).set_flags(tet_of(inner), facet_bit(side_of(inner)));
  for (int j = 0; j < 3; ++j) {
    bool is_held = false;
    turn(inner, mesh.corner(ghost, j), [&](Tet t, int edge) {
      is_held = is_held || !mesh.is_segment(t, edge);
      if (is_held) MeshAssembly(mesh).set_flags(t, segment_bit(edge));
    });
    if (is_held) bounds_[ghost - first_ghost_].held |= static_cast<std::uint8_t>(1u << j);
  }
}

void Part::copy_constraints_to(Tet ghost) {
  const Face inner = mesh.neighbour(ghost, 3);
  const Tet t = tet_of(inner);
  if (mesh.is_facet(inner)) MeshAssembly(mesh).set_flags(ghost, facet_bit(3));
  for (int edge = 0; edge < 6; ++edge) {
    const auto& ends = kEdgeVertex[static_cast<std::size_t>(edge)];
    if (!mesh.is_segment(t, edge) || ends[0] == side_of(inner) || ends[1] == side_of(inner)) continue;
    const int same_edge = mesh.edge_of(ghost, mesh.corner(t, ends[0]), mesh.corner(t, ends[1]));
    MeshAssembly(mesh).set_flags(ghost, segment_bit(same_edge));
  }
}

void Part::release_interfaces() {
  for (Tet k = 0; k < bounds_.size(); ++k) {
    if (!bounds_[k].is_interface) continue;
    const Tet ghost = first_ghost_ + k;
    const Face inner = mesh.neighbour(ghost, 3);
    MeshAssembly(mesh).clear_flags(tet_of(inner), facet_bit(side_of(inner)));
    for (int j = 0; j < 3; ++j)
      if ((bounds_[k].held >> j & 1) != 0)
        turn(inner, mesh.corner(ghost, j),
             [&](Tet t, int edge) { MeshAssembly(mesh).clear_flags(t, segment_bit(edge)); });
  }
}

std::size_t Part::count_at_cuts() const {
  const auto is_on_cut = [&](Vertex v) { return v < first_free && on_cut_[v] != 0; };
  std::size_t count = 0;
  for (Tet t = 0; t < mesh.slot_count(); ++t) {
    const TetMesh::Corners& c = mesh.corners(t);
    if (mesh.alive(t) && !mesh.is_ghost(t) && std::any_of(c.begin(), c.end(), is_on_cut)) ++count;
  }
  return count;
}

// Ghosts keep their order, behind the tetrahedra, because bounds_ relies on it.
void Part::order_along_curve() {
  const auto first_new = static_cast<Vertex>(vertices_.size());
  CurveOrder order = order_of(mesh, first_new);
  std::erase_if(order.tets, [&](Tet t) { return mesh.is_ghost(t); });
  const auto first_ghost = static_cast<Tet>(order.tets.size());
  for (Tet k = 0; k < bounds_.size(); ++k) order.tets.push_back(first_ghost_ + k);
  renumber(mesh, order, first_new, region_of, sizes, metrics_if_any());
  first_ghost_ = first_ghost;
}

class PartJoiner {
 public:
  // A face between two parts, by its codes before and after joining.
  struct Seam {
    Face inner, outer, now;
  };

  PartJoiner(const VolumeData& whole, Part& part) : whole_(whole), part_(part) {}

  void prepare() {
    part_.release_interfaces();
    for (Tet t = 0; t < part_.mesh.slot_count(); ++t)
      if (part_.mesh.alive(t) && !part_.mesh.is_ghost(t)) tets_.push_back(t);
  }

  [[nodiscard]] std::size_t new_tets() const {
    return tets_.size() - std::min(tets_.size(), part_.slots_.size());
  }
  [[nodiscard]] std::size_t new_vertices() const {
    return part_.mesh.vertex_count() - part_.vertices_.size();
  }

  void number(Tet first_tet, Vertex first_vertex) {
    joined_.assign(part_.mesh.slot_count(), kNone);
    for (std::size_t k = 0; k < tets_.size(); ++k)
      joined_[tets_[k]] =
          k < part_.slots_.size() ? part_.slots_[k] : first_tet + static_cast<Tet>(k - part_.slots_.size());
    while (part_.vertices_.size() < part_.mesh.vertex_count()) part_.vertices_.push_back(first_vertex++);
  }

  /// Writes what belongs only to this part.
  void write() {
    write_vertices();
    write_tets();
    link_to_what_stands();
  }

  [[nodiscard]] std::vector<Seam> seams() const {
    std::vector<Seam> seams;
    for (Tet k = 0; k < part_.bounds_.size(); ++k)
      if (part_.bounds_[k].is_next_a_part)
        seams.push_back({part_.bounds_[k].inner, part_.bounds_[k].outer, now_at(k)});
    return seams;
  }

  /// For one part at a time: removes slots that are left, and writes vertices that other parts may have, too.
  void write_shared() {
    for (std::size_t k = tets_.size(); k < part_.slots_.size(); ++k)
      MeshAssembly(whole_.mesh).remove_tet(part_.slots_[k]);
    for (Vertex v = 0; v < part_.first_free; ++v) {
      Tet t = part_.mesh.incident(v);
      if (part_.mesh.is_ghost(t)) t = tet_of(part_.mesh.neighbour(t, 3));
      MeshAssembly(whole_.mesh).set_incident(part_.vertices_[v], joined_[t]);
    }
  }

 private:
  // The code in the whole mesh of the face on which the k-th ghost stands.
  [[nodiscard]] Face now_at(Tet k) const {
    const Face inner = part_.mesh.neighbour(part_.first_ghost_ + k, 3);
    return face_code(joined_[tet_of(inner)], side_of(inner));
  }

  void write_vertices() {
    for (Vertex v = part_.first_free; v < part_.vertices_.size(); ++v) {
      const Vertex w = part_.vertices_[v];
      const Tet t = part_.mesh.incident(v);
      MeshAssembly(whole_.mesh).place_vertex(w, part_.mesh.position(v));
      MeshAssembly(whole_.mesh).set_incident(w, t == kNone ? kNone : joined_[t]);
      whole_.sizes[w] = part_.sizes[v];
      if (whole_.metrics != nullptr) (*whole_.metrics)[w] = part_.metrics[v];
    }
  }

  void write_tets() {
    for (const Tet t : tets_) {
      TetMesh::Corners corners = part_.mesh.corners(t);
      for (Vertex& v : corners) v = part_.vertices_[v];
      TetMesh::Neighbours neighbours{};
      for (int i = 0; i < 4; ++i) {
        const Face g = part_.mesh.neighbour(t, i);
        neighbours[static_cast<std::size_t>(i)] = face_code(joined_[tet_of(g)], side_of(g));
      }
      MeshAssembly(whole_.mesh)
          .put_tet(joined_[t], corners, neighbours,
                   static_cast<Flags>(part_.mesh.flags(t) & kConstraintBits));
      whole_.region_of[joined_[t]] = part_.region_of[t];
    }
  }

  void link_to_what_stands() {
    for (Tet k = 0; k < part_.bounds_.size(); ++k)
      if (!part_.bounds_[k].is_next_a_part) MeshAssembly(whole_.mesh).link(now_at(k), part_.bounds_[k].outer);
  }

  const VolumeData& whole_;
  Part& part_;
  std::vector<Tet> tets_;    // in the order of their new slots
  std::vector<Tet> joined_;  // by slot: the tetrahedron in the whole mesh
};

namespace {

// Links the faces between two parts, which each part knows from its own side.
void link_seams(TetMesh& mesh, const std::vector<PartJoiner>& joiners) {
  std::vector<PartJoiner::Seam> seams;
  for (const PartJoiner& joiner : joiners) {
    const auto own = joiner.seams();
    seams.insert(seams.end(), own.begin(), own.end());
  }
  const auto by_inner = [](const PartJoiner::Seam& x, const PartJoiner::Seam& y) {
    return x.inner < y.inner;
  };
  std::sort(seams.begin(), seams.end(), by_inner);
  for (const PartJoiner::Seam& seam : seams) {
    if (seam.outer < seam.inner) continue;
    const auto other =
        std::lower_bound(seams.begin(), seams.end(), PartJoiner::Seam{seam.outer, 0, 0}, by_inner);
    MeshAssembly(mesh).link(seam.now, other->now);
  }
}

}  // namespace

Parts::Parts(const VolumeData& whole, const std::vector<std::uint32_t>& part_of, std::size_t count,
             const Threads& threads)
    : whole_(whole), parts_(count) {
  std::vector<std::size_t> sizes(count, 0);
  for (const std::uint32_t part : part_of)
    if (part != kNone) ++sizes[part];
  for (std::size_t k = 0; k < count; ++k) parts_[k].slots_.reserve(sizes[k]);
  for (Tet t = 0; t < part_of.size(); ++t)
    if (part_of[t] != kNone) parts_[part_of[t]].slots_.push_back(t);
  for (Part& part : parts_) part.seed = whole.seed;
  threads.poll();
  const CurveKeys keys(whole.mesh);
  std::vector<std::vector<Tet>> tets(count);  // in their order along the curve
  std::vector<Tet> local_of(whole.mesh.slot_count());
  threads.poll();
  parallel(threads, count, [&](std::size_t k) {
    tets[k] = parts_[k].slots_;
    keys.sort(tets[k]);
    for (Tet t = 0; t < tets[k].size(); ++t) local_of[tets[k][t]] = t;
  });
  parallel(threads, count, [&](std::size_t k) {
    if (!tets[k].empty()) PartMaker(whole_, part_of, local_of, tets[k], parts_[k]).make(threads);
  });
}

void Parts::set_cut_before(const std::vector<Vertex>& vertices, const Threads& threads) {
  std::vector<std::uint8_t> is_among(whole_.mesh.vertex_count(), 0);
  for (const Vertex v : vertices) is_among[v] = 1;
  parallel(threads, parts_.size(), [&](std::size_t k) {
    for (const Vertex v : parts_[k].vertices_) parts_[k].was_on_cut_.push_back(is_among[v]);
  });
}

double Parts::share_at_cuts(const Threads& threads) const {
  std::vector<std::size_t> at(parts_.size());
  parallel(threads, parts_.size(), [&](std::size_t k) { at[k] = parts_[k].count_at_cuts(); });
  std::size_t all = 0;
  for (const Part& part : parts_) all += part.slots_.size();
  return static_cast<double>(std::accumulate(at.begin(), at.end(), std::size_t{0})) /
         static_cast<double>(std::max<std::size_t>(all, 1));
}

std::size_t Parts::tet_count() const {
  std::size_t count = 0;
  for (const Part& part : parts_) count += part.mesh.tet_count();
  return count;
}

std::size_t Parts::new_vertices() const {
  std::size_t count = 0;
  for (const Part& part : parts_) count += part.mesh.vertex_count() - part.vertices_.size();
  return count;
}

void Parts::join(const Threads& threads) {
  std::vector<PartJoiner> joiners;
  for (Part& part : parts_) joiners.emplace_back(whole_, part);
  parallel(threads, joiners.size(), [&](std::size_t k) { joiners[k].prepare(); });
  Tet tet = static_cast<Tet>(whole_.mesh.slot_count());
  Vertex vertex = static_cast<Vertex>(whole_.mesh.vertex_count());
  std::vector<std::pair<Tet, Vertex>> first;
  for (const PartJoiner& joiner : joiners) {
    first.emplace_back(tet, vertex);
    tet += static_cast<Tet>(joiner.new_tets());
    vertex += static_cast<Vertex>(joiner.new_vertices());
  }
  MeshAssembly(whole_.mesh).make_room(vertex, tet);
  threads.poll();
  for (std::size_t more = tet - whole_.mesh.slot_count(); more > 0; threads.poll()) {
    const std::size_t some = std::min(more, kSlotsAtOnce);
    MeshAssembly(whole_.mesh).add_slots(some);
    more -= some;
  }
  MeshAssembly(whole_.mesh).add_vertices(vertex - whole_.mesh.vertex_count());
  whole_.region_of.resize(whole_.mesh.slot_count(), kNone);
  whole_.sizes.resize(whole_.mesh.vertex_count(), 0);
  if (whole_.metrics != nullptr) whole_.metrics->resize(whole_.mesh.vertex_count());
  parallel(threads, joiners.size(), [&](std::size_t k) {
    joiners[k].number(first[k].first, first[k].second);
    joiners[k].write();
  });
  for (PartJoiner& joiner : joiners) {
    joiner.write_shared();
    threads.poll();
  }
  link_seams(whole_.mesh, joiners);
  MeshAssembly(whole_.mesh).finish();
}

std::vector<Vertex> Parts::vertices_between() const {
  std::vector<Vertex> vertices;
  for (const Part& part : parts_)
    for (Tet k = 0; k < part.bounds_.size(); ++k)
      if (part.bounds_[k].is_interface && part.bounds_[k].is_next_a_part)
        for (const Vertex v : part.mesh.face_vertices(face_code(part.first_ghost_ + k, 3)))
          vertices.push_back(part.vertices_[v]);
  sort_unique(vertices);
  return vertices;
}

}  // namespace holdfast
