#include "untangle/refill_cavity.h"

#include <algorithm>

namespace holdfast {
namespace {

// Whether (a b c) and the facet turn the same way.
bool same_turn(const Triangle& facet, Index a, Index b, Index c) {
  return (facet[0] == a && facet[1] == b && facet[2] == c) ||
         (facet[0] == b && facet[1] == c && facet[2] == a) ||
         (facet[0] == c && facet[1] == a && facet[2] == b);
}

}  // namespace

RefillCavity::RefillCavity(const Tangle& tangle, std::vector<Tet> tets)
    : tangle_(tangle), tets_(std::move(tets)) {
  std::sort(tets_.begin(), tets_.end());
  find_components();
  take_facets();
  take_segments();
  take_points();
}

Index RefillCavity::local(Vertex v) {
  const auto [at, fresh] = number_.try_emplace(v, static_cast<Index>(vertex_.size()));
  if (fresh) {
    vertex_.push_back(v);
    surface_.vertices.push_back(tangle_.position(v));
  }
  return at->second;
}

// Tetrahedra that faces connect which are not constraints.
void RefillCavity::find_components() {
  constexpr Index kPending = kOutside - 1;
  for (const Tet t : tets_) component_[t] = kPending;
  std::vector<Tet> queue;
  for (const Tet seed : tets_) {
    if (component_[seed] != kPending) continue;
    const auto id = static_cast<Index>(region_.size());
    region_.push_back(tangle_.region(seed));
    component_[seed] = id;
    queue.assign(1, seed);
    for (std::size_t k = 0; k < queue.size(); ++k)
      for (int i = 0; i < 4; ++i) {
        if (tangle_.is_constraint(tangle_.face(queue[k], i))) continue;
        const Tet s = tangle_.across(queue[k], i);
        if (s == kNone || component_of(s) != kPending) continue;
        component_[s] = id;
        queue.push_back(s);
      }
  }
}

void RefillCavity::take_facets() {
  for (const Tet t : tets_)
    for (int i = 0; i < 4; ++i) {
      const auto f = tangle_.face(t, i);
      const Tet s = tangle_.across(t, i);
      const Index other = s == kNone ? kOutside : component_of(s);
      if (other != kOutside && (s < t || !tangle_.is_constraint(f))) continue;
      if (s != kNone && other == kOutside) whole_ = false;
      const Triangle facet{local(f[0]), local(f[1]), local(f[2])};
      const auto key = ascending(facet);
      face_index_.push_back({key[0], key[1], key[2], static_cast<Index>(surface_.facets.size())});
      surface_.facets.push_back(facet);
      sides_.push_back({component_of(t), other});
    }
  std::sort(face_index_.begin(), face_index_.end());
}

void RefillCavity::take_segments() {
  if (tangle_.constraints().segments.empty()) return;
  for (const Tet t : tets_)
    for (const auto& [i, k] : kEdgeVertex) {
      const Vertex a = tangle_.corners(t)[static_cast<std::size_t>(i)];
      const Vertex b = tangle_.corners(t)[static_cast<std::size_t>(k)];
      if (tangle_.is_segment(a, b)) surface_.segments.push_back(ascending(Segment{local(a), local(b)}));
    }
  std::sort(surface_.segments.begin(), surface_.segments.end());
  surface_.segments.erase(std::unique(surface_.segments.begin(), surface_.segments.end()),
                          surface_.segments.end());
}

// Those that must stay; then the free ones that are well placed, as far as signs tell.
void RefillCavity::take_points() {
  const auto well_placed = [this](Vertex v) {
    const auto star = tangle_.star(v);
    return std::all_of(star.begin(), star.end(), [this](Tet t) { return tangle_.sign(t) > 0; });
  };
  for (const bool fixed : {true, false}) {
    if (!fixed) first_point_ = vertex_.size();
    for (const Tet t : tets_)
      for (const Vertex v : tangle_.corners(t))
        if (tangle_.is_fixed(v) == fixed && (fixed || well_placed(v))) local(v);
  }
}

// Points that do not fit the boundary, or each other, go; all of them where nothing says which.
bool RefillCavity::drop_points(const Result& result) {
  if (first_point_ == vertex_.size()) return false;
  std::vector<bool> drop(vertex_.size(), result.outcome != holdfast::Outcome::invalid_input);
  bool named = false;
  for (const Defect& defect : result.defects)
    for (const Index v : defect.vertices)
      if (v >= first_point_) named = drop[v] = true;
  if (!named) std::fill(drop.begin(), drop.end(), true);
  std::size_t kept = first_point_;
  for (std::size_t v = first_point_; v < vertex_.size(); ++v) {
    if (drop[v]) continue;
    vertex_[kept] = vertex_[v];
    surface_.vertices[kept++] = surface_.vertices[v];
  }
  vertex_.resize(kept);
  surface_.vertices.resize(kept);
  return true;
}

RefillCavity::Outcome RefillCavity::fill(const Filler& filler) {
  constexpr int kMostTries = 3;  // with points; then without
  for (int k = 0;; ++k) {
    Result result = filler(surface_.view());
    if (result.outcome == holdfast::Outcome::done) return judge(result.volume);
    if (k == kMostTries) result.defects.clear();
    if (!drop_points(result))
      return result.outcome == holdfast::Outcome::invalid_input ? Outcome::invalid
                                                                : Outcome::not_representable;
  }
}

// Each facet says to whom the regions on its two sides belong; all facets of a region must say the same.
bool RefillCavity::claim(const Volume& volume, std::size_t tet, std::vector<std::optional<Index>>& owners,
                         std::vector<std::array<bool, 2>>& seen) const {
  const Tetrahedron& c = volume.tetrahedra[tet];
  for (const auto& k : kFaceVertex) {
    const Triangle f{c[static_cast<std::size_t>(k[0])], c[static_cast<std::size_t>(k[1])],
                     c[static_cast<std::size_t>(k[2])]};
    const auto key = ascending(f);
    const std::array<Index, 4> least{key[0], key[1], key[2], 0};
    const auto at = std::lower_bound(face_index_.begin(), face_index_.end(), least);
    if (at == face_index_.end() || (*at)[0] != key[0] || (*at)[1] != key[1] || (*at)[2] != key[2]) continue;
    const Index facet = (*at)[3];
    const bool above = same_turn(surface_.facets[facet], f[0], f[1], f[2]);
    const Index owner = above ? sides_[facet].above : sides_[facet].below;
    seen[facet][above ? 0 : 1] = true;
    std::optional<Index>& known = owners[static_cast<std::size_t>(volume.regions[tet])];
    if (known && *known != owner) return false;
    known = owner;
  }
  return true;
}

// A new edge or face that exists outside the cavity already: the mesh there is still tangled with this one.
bool RefillCavity::joins_outside(const Volume& volume) const {
  const auto only_outside = [this](std::span<const Index> corners) {
    if (std::any_of(corners.begin(), corners.end(), [this](Index v) { return v >= first_point_; }))
      return false;
    bool outside = false, inside = false;
    for (const Tet s : tangle_.star(vertex_[corners[0]]))
      if (std::all_of(corners.begin(), corners.end(), [&](Index v) { return tangle_.holds(s, vertex_[v]); }))
        (component_of(s) == kOutside ? outside : inside) = true;
    return outside && !inside;
  };
  for (std::size_t t = 0; t < volume.tetrahedra.size(); ++t) {
    if (owner_[t] == kOutside) continue;
    const Tetrahedron& c = volume.tetrahedra[t];
    for (const auto& [i, k] : kEdgeVertex)
      if (only_outside(std::array{c[static_cast<std::size_t>(i)], c[static_cast<std::size_t>(k)]}))
        return true;
    for (const auto& k : kFaceVertex)
      if (only_outside(std::array{c[static_cast<std::size_t>(k[0])], c[static_cast<std::size_t>(k[1])],
                                  c[static_cast<std::size_t>(k[2])]}))
        return true;
  }
  return false;
}

// Whether parts of space that do not hang together fill one component of the cavity. Its boundary may do so
// where tetrahedra that the cavity surrounds lie inside out beside it: one part would fill up the cavity's
// own place, the other close these off, all boundary lost. They could never become positive then.
bool RefillCavity::splits(std::span<const std::optional<Index>> owners) const {
  if (whole_) return false;  // what is filled then has boundary of the volume only
  std::vector<bool> met(region_.size(), false);
  for (const std::optional<Index>& owner : owners) {
    if (!owner || *owner == kOutside) continue;
    if (met[*owner]) return true;
    met[*owner] = true;
  }
  return false;
}

RefillCavity::Outcome RefillCavity::judge(const Volume& volume) {
  int most = 0;
  for (const int region : volume.regions) {
    if (region < 0) return Outcome::invalid;
    most = std::max(most, region);
  }
  std::vector<std::optional<Index>> owners(static_cast<std::size_t>(most) + 1);
  std::vector<std::array<bool, 2>> seen(surface_.facets.size(), {false, false});
  for (std::size_t t = 0; t < volume.tetrahedra.size(); ++t)
    if (!claim(volume, t, owners, seen)) return Outcome::overlaps;
  for (std::size_t f = 0; f < sides_.size(); ++f)
    if ((sides_[f].above != kOutside && !seen[f][0]) || (sides_[f].below != kOutside && !seen[f][1]))
      return Outcome::overlaps;
  if (splits(owners)) return Outcome::invalid;
  owner_.clear();
  for (const int region : volume.regions)
    owner_.push_back(owners[static_cast<std::size_t>(region)].value_or(kOutside));
  if (joins_outside(volume)) return Outcome::invalid;
  volume_ = volume;
  return Outcome::filled;
}

void RefillCavity::apply(Tangle& tangle) const {
  for (const Tet t : tets_) tangle.remove_tet(t);
  std::vector<Vertex> vertex = vertex_;
  vertex.resize(volume_.vertices.size(), kNone);
  for (std::size_t t = 0; t < volume_.tetrahedra.size(); ++t) {
    if (owner_[t] == kOutside) continue;
    Tangle::Corners corners{};
    for (std::size_t i = 0; i < 4; ++i) {
      Vertex& v = vertex[volume_.tetrahedra[t][i]];
      if (v == kNone) v = tangle.add_vertex(volume_.vertices[volume_.tetrahedra[t][i]]);
      corners[i] = v;
    }
    tangle.add_tet(corners, region_[owner_[t]]);
  }
}

}  // namespace holdfast
