#include "refine/point_cavity.h"

#include <algorithm>

#include "mesh/editor.h"

namespace holdfast {
namespace {

// By the facets of a tetrahedron: the corners and edge flags that are on none of these facets.
struct OffFacets {
  std::uint8_t corners = 0xF;
  Flags segments = kSegmentBits;
};

constexpr std::array<OffFacets, kFacetBits + 1> off_facets() {
  std::array<OffFacets, kFacetBits + 1> off{};
  for (unsigned facets = 0; facets <= kFacetBits; ++facets)
    for (int f = 0; f < 4; ++f) {
      if ((facets & facet_bit(f)) == 0) continue;
      unsigned corners = off[facets].corners, segments = off[facets].segments;
      for (int i = 0; i < 4; ++i)
        if (i != f) corners &= ~(1u << i);
      for (int k = 0; k < 6; ++k) {
        const auto& e = kEdgeVertex[static_cast<std::size_t>(k)];
        if (e[0] != f && e[1] != f) segments &= ~unsigned{segment_bit(k)};
      }
      off[facets] = {static_cast<std::uint8_t>(corners), static_cast<Flags>(segments)};
    }
  return off;
}

constexpr std::array<OffFacets, kFacetBits + 1> kOffFacets = off_facets();

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

// Removes tetrahedra that do not belong to the cavity.
bool PointCavity::settle(Tet base) {
  for (;;) {
    if (!shrink_until_seen(base)) {
      abandon();
      return false;
    }
    poll_if_large();
    list_rim();
    poll_if_large();
    edges_.list(rim_, vertices_);
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

// Collects the tetrahedra in conflict with p, and the faces between these and others, facets from both sides.
void PointCavity::spread(Tet base, const Frame& frame, std::size_t most) {
  tets_.clear();
  faces_.clear();
  tets_.push_back(base);
  mesh_.mark_visited(base);
  const bool is_plain = frame.is_plain();
  const Point& x = mesh_.position(p_);
  for (std::size_t k = 0; k < tets_.size() && tets_.size() <= most; ++k) {
    const Tet t = tets_[k];
    // Memory takes more time here than the tests.
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

// Rounding in the frame may invert flat tetrahedra.
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

// Removes a tetrahedron from the cavity; its faces towards the rest join the boundary.
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
  while (next < faces_.size()) {  // releasing tetrahedra adds faces
    const Face f = faces_[next++];
    const Tet t = tet_of(f);
    if ((mesh_.flags(t) & kVisited) == 0) continue;
    const auto v = mesh_.face_vertices(f);
    if (mesh_.orient(v[0], v[1], v[2], p_) > 0)
      faces_[kept++] = f;
    else if (!release(t, base))
      return false;
  }
  // A face that was kept may have lost its tetrahedron since then.
  faces_.resize(kept);
  std::erase_if(faces_, [&](Face f) { return (mesh_.flags(tet_of(f)) & kVisited) == 0; });
  std::erase_if(tets_, [&](Tet t) { return (mesh_.flags(t) & kVisited) == 0; });
  return true;
}

void PointCavity::list_rim() {
  vertices_.clear(mesh_.vertex_count());
  rim_.resize(faces_.size());
  for (std::size_t k = 0; k < faces_.size(); ++k) {
    const Face f = faces_[k];
    const Flags old = mesh_.flags(tet_of(f));
    RimFace& rim = rim_[k];
    rim.v = mesh_.face_vertices(f);
    rim.outer = mesh_.neighbour(f);
    unsigned flags = mesh_.is_facet(f) ? facet_bit(3) : 0u;
    if ((old & kSegmentBits) != 0) {
      const auto& c = kFaceVertex[f & 3u];
      const auto bit = [&](std::size_t i, std::size_t j) {
        return (old & segment_bit(edge_between(c[i], c[j]))) != 0;
      };
      if (bit(0, 1)) flags |= segment_bit(0);
      if (bit(0, 2)) flags |= segment_bit(1);
      if (bit(1, 2)) flags |= segment_bit(3);
    }
    rim.flags = static_cast<Flags>(flags);
    for (std::size_t i = 0; i < 3; ++i) rim.local[i] = vertices_.add(rim.v[i]);
  }
}

// A tetrahedron of the cavity with a vertex or segment on no face of the boundary, or kNone. Facets are faces
// of the boundary.
Tet PointCavity::holder_of_lost_entity(Tet base) const {
  Tet lost = kNone;
  for (const Tet t : tets_) {
    const Flags flags = mesh_.flags(t);
    const OffFacets& off = kOffFacets[flags & kFacetBits];
    bool holds = false;
    for (int i = 0; i < 4 && !holds; ++i)
      holds = (off.corners & (1u << i)) != 0 && !vertices_.has(mesh_.corner(t, i));
    if ((flags & off.segments) != 0)
      for (int k = 0; k < 6 && !holds; ++k) {
        const auto& e = kEdgeVertex[static_cast<std::size_t>(k)];
        holds = (flags & off.segments & segment_bit(k)) != 0 &&
                !edges_.has(rim_, vertices_, mesh_.corner(t, e[0]), mesh_.corner(t, e[1]));
      }
    if (holds) lost = t;
    if (holds && t != base) return t;
  }
  return lost;
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
  edges_.link(rim_, vertices_, new_tets_);
  poll_if_large();
  created_.clear();
  MeshEditor(mesh_).apply({tets_, new_tets_, p_}, created_);
}

}  // namespace holdfast
