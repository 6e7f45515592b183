#include "refine/point_cavity.h"

#include <algorithm>

#include "mesh/editor.h"

namespace holdfast {
namespace {

// Side i < 3 of a face of the rim is its edge opposite corner i.
constexpr std::array<std::array<std::size_t, 2>, 3> kSide{{{1, 2}, {2, 0}, {0, 1}}};

}  // namespace

bool PointCavity::find(Vertex p, Tet base, const Frame& frame, std::size_t most) {
  p_ = p;
  spread(base, frame, most);
  work_ = tets_.size();
  if (tets_.size() > most) {
    abandon();
    return false;
  }
  return settle(base);
}

bool PointCavity::find_among(Vertex p, Tet base, std::span<const Tet> tets) {
  p_ = p;
  gather(tets);
  work_ = tets_.size();
  return settle(base);
}

// Takes out of the cavity what does not belong there.
bool PointCavity::settle(Tet base) {
  if (place_.size() < mesh_.vertex_count()) place_.resize(mesh_.vertex_count() + mesh_.vertex_count() / 2, 0);
  for (;;) {
    if (!shrink_until_seen(base)) {
      abandon();
      return false;
    }
    poll_if_large();
    list_rim();
    poll_if_large();
    list_edges();
    poll_if_large();
    const Tet t = holder_of_lost_entity(base);
    if (t == kNone) break;
    if (!release(t, base)) {
      abandon();
      return false;
    }
  }
  return true;
}

inline bool PointCavity::is_in_sphere(Tet t, const Point& x) const {
  const auto& c = mesh_.corners(t);
  return exact::insphere(mesh_.position(c[0]).data(), mesh_.position(c[1]).data(),
                         mesh_.position(c[2]).data(), mesh_.position(c[3]).data(), x.data()) > 0;
}

// The tetrahedra in conflict with p and the faces between them and others, facets from both sides.
void PointCavity::spread(Tet base, const Frame& frame, std::size_t most) {
  tets_.clear();
  faces_.clear();
  tets_.push_back(base);
  mesh_.mark_visited(base);
  const bool is_plain = frame.is_plain();
  const Point& x = mesh_.position(p_);
  for (std::size_t k = 0; k < tets_.size() && tets_.size() <= most; ++k) {
    const Tet t = tets_[k];
    // The spreading waits for memory more than for the tests.
    for (int i = 0; i < 4; ++i) {
      const Face g = mesh_.neighbour(t, i);
      mesh_.prefetch(tet_of(g));
      if (mesh_.apex(g) != kGhost) mesh_.prefetch_vertex(mesh_.apex(g));
    }
    for (int i = 0; i < 4; ++i) {
      const Face f = face_code(t, i);
      const Tet n = tet_of(mesh_.neighbour(f));
      if (mesh_.is_facet(f)) {
        faces_.push_back(f);
        continue;
      }
      if ((mesh_.flags(n) & kVisited) != 0) continue;
      if (!mesh_.is_ghost(n) && (is_plain ? is_in_sphere(n, x) : is_in_sphere_of(frame, n))) {
        mesh_.mark_visited(n);
        mesh_.prefetch_neighbours(n);
        tets_.push_back(n);
      } else {
        faces_.push_back(f);
      }
    }
  }
}

// Rounded in the frame, flat tetrahedra may be turned round.
bool PointCavity::is_in_sphere_of(const Frame& frame, Tet t) const {
  std::array<Point, 4> q;
  for (std::size_t i = 0; i < 4; ++i) q[i] = frame.to(mesh_.position(mesh_.corners(t)[i]));
  const Point x = frame.to(mesh_.position(p_));
  const int way = exact::orient3d(q[0].data(), q[1].data(), q[2].data(), q[3].data());
  return way == 0 || way * exact::insphere(q[0].data(), q[1].data(), q[2].data(), q[3].data(), x.data()) > 0;
}

void PointCavity::gather(std::span<const Tet> tets) {
  tets_.assign(tets.begin(), tets.end());
  faces_.clear();
  for (const Tet t : tets_) mesh_.mark_visited(t);
  for (const Tet t : tets_)
    for (int i = 0; i < 4; ++i) {
      const Face f = face_code(t, i);
      if (mesh_.is_facet(f) || (mesh_.flags(tet_of(mesh_.neighbour(f))) & kVisited) == 0) faces_.push_back(f);
    }
}

// Takes a tetrahedron out of the cavity; its faces towards the rest become the boundary's.
bool PointCavity::release(Tet t, Tet base) {
  if (t == base) return false;
  mesh_.clear_visited(t);
  for (int i = 0; i < 4; ++i) {
    const Face g = mesh_.neighbour(t, i);
    if ((mesh_.flags(tet_of(g)) & kVisited) != 0 && !mesh_.is_facet(g)) faces_.push_back(g);
  }
  return true;
}

bool PointCavity::shrink_until_seen(Tet base) {
  std::size_t kept = 0, next = 0;
  while (next < faces_.size()) {  // to which releasing adds
    const Face f = faces_[next++];
    const Tet t = tet_of(f);
    if ((mesh_.flags(t) & kVisited) == 0) continue;
    const auto v = mesh_.face_vertices(f);
    if (mesh_.orient(v[0], v[1], v[2], p_) > 0)
      faces_[kept++] = f;
    else if (!release(t, base))
      return false;
  }
  // A face that was kept may have lost its tetrahedron since.
  faces_.resize(kept);
  std::erase_if(faces_, [&](Face f) { return (mesh_.flags(tet_of(f)) & kVisited) == 0; });
  std::erase_if(tets_, [&](Tet t) { return (mesh_.flags(t) & kVisited) == 0; });
  return true;
}

void PointCavity::list_rim() {
  ring_.clear();
  rim_.resize(faces_.size());
  for (std::size_t k = 0; k < faces_.size(); ++k) {
    const Face f = faces_[k];
    const Flags old = mesh_.flags(tet_of(f));
    Rim& rim = rim_[k];
    rim.v = mesh_.face_vertices(f);
    rim.outer = mesh_.neighbour(f);
    unsigned flags = mesh_.is_facet(f) ? facet_bit(3) : 0u;
    if ((old & kSegmentBits) != 0) {
      const auto& c = kFaceVertex[f & 3u];
      const auto bit = [&](std::size_t i, std::size_t j) {
        return (old & segment_bit(kEdgeOf[static_cast<std::size_t>(c[i])][static_cast<std::size_t>(c[j])])) !=
               0;
      };
      if (bit(0, 1)) flags |= segment_bit(0);
      if (bit(0, 2)) flags |= segment_bit(1);
      if (bit(1, 2)) flags |= segment_bit(3);
    }
    rim.flags = static_cast<Flags>(flags);
    for (std::size_t i = 0; i < 3; ++i) {
      const Vertex v = rim.v[i];
      if (!on_ring(v)) {
        place_[v] = static_cast<std::uint32_t>(ring_.size());
        ring_.push_back(v);
      }
      rim.local[i] = place_[v];
    }
  }
}

// A tetrahedron of the cavity with a vertex or segment that no face of the boundary holds, or kNone.
Tet PointCavity::holder_of_lost_entity(Tet base) const {
  Tet lost = kNone;
  for (const Tet t : tets_) {
    const auto& c = mesh_.corners(t);
    bool holds = !(on_ring(c[0]) && on_ring(c[1]) && on_ring(c[2]) && on_ring(c[3]));
    if ((mesh_.flags(t) & kSegmentBits) != 0)
      for (int k = 0; k < 6 && !holds; ++k) {
        const auto& e = kEdgeVertex[static_cast<std::size_t>(k)];
        holds = mesh_.is_segment(t, k) && !on_rim(mesh_.corner(t, e[0]), mesh_.corner(t, e[1]));
      }
    if (holds) lost = t;
    if (holds && t != base) return t;
  }
  return lost;
}

void PointCavity::list_edges() {
  edges_.clear();
  if (fits_table()) {
    const std::size_t n = ring_.size();
    if (table_.size() < n * n) table_.resize(n * n);
    for (std::uint32_t k = 0; k < rim_.size(); ++k)
      for (std::uint32_t i = 0; i < 3; ++i)
        table_[rim_[k].local[kSide[i][0]] * n + rim_[k].local[kSide[i][1]]] =
            face_code(k, static_cast<int>(i));
    return;
  }
  for (const Rim& r : rim_)
    for (std::size_t i = 0; i < 3; ++i) edges_.push_back(edge_key(r.v[i], r.v[(i + 1) % 3]));
  std::sort(edges_.begin(), edges_.end());
}

// The rim is closed: it holds each of its edges both ways.
bool PointCavity::on_rim(Vertex a, Vertex b) const {
  if (!fits_table()) return std::binary_search(edges_.begin(), edges_.end(), edge_key(a, b));
  if (!on_ring(a) || !on_ring(b)) return false;
  const std::uint32_t entry = table_[place_[a] * ring_.size() + place_[b]];
  const std::size_t k = entry >> 2;
  if (k >= rim_.size() || (entry & 3u) == 3u) return false;
  const auto& side = kSide[entry & 3u];
  return rim_[k].v[side[0]] == a && rim_[k].v[side[1]] == b;
}

void PointCavity::abandon() {
  for (const Tet t : tets_) mesh_.clear_visited(t);
}

void PointCavity::insert() {
  new_tets_.resize(rim_.size());
  for (std::size_t k = 0; k < rim_.size(); ++k) {
    const auto& [v, local, outer, flags] = rim_[k];
    new_tets_[k] = {{v[0], v[1], v[2], p_}, {kNone, kNone, kNone, outer}, flags};
  }
  if (fits_table())
    link_by_table();
  else
    link_by_sorting();
  poll_if_large();
  created_.clear();
  MeshEditor(mesh_).apply({tets_, new_tets_, p_}, created_);
}

// Face i of a new tetrahedron, i < 3, lies at side i of its face of the rim; the neighbour has the same edge
// reversed.
void PointCavity::link_by_table() {
  const std::size_t n = ring_.size();
  for (std::size_t k = 0; k < rim_.size(); ++k)
    for (std::size_t i = 0; i < 3; ++i)
      new_tets_[k].neighbours[i] =
          table_[rim_[k].local[kSide[i][1]] * n + rim_[k].local[kSide[i][0]]] | kNewFace;
}

void PointCavity::link_by_sorting() {
  sides_.clear();
  for (std::size_t k = 0; k < rim_.size(); ++k)
    for (std::size_t i = 0; i < 3; ++i)
      sides_.push_back({edge_key(rim_[k].local[(i + 1) % 3], rim_[k].local[(i + 2) % 3]), new_face(k, i)});
  std::sort(sides_.begin(), sides_.end(), [](const Side& x, const Side& y) {
    return x.edge != y.edge ? x.edge < y.edge : x.face < y.face;
  });
  for (std::size_t k = 0; k + 1 < sides_.size(); k += 2) {
    const Face f = sides_[k].face, g = sides_[k + 1].face;
    new_tets_[number_of_new(f)].neighbours[f & 3u] = g;
    new_tets_[number_of_new(g)].neighbours[g & 3u] = f;
  }
}

}  // namespace holdfast
