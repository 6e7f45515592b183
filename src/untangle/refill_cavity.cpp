#include "untangle/refill_cavity.h"

#include <algorithm>
#include <utility>

#include "untangle/tuning.h"

namespace holdfast {
namespace {

// The facets of a complex by their corners.
class FacetIndex {
 public:
  explicit FacetIndex(const std::vector<Triangle>& facets) : facets_(facets) {
    for (std::size_t f = 0; f < facets.size(); ++f)
      entries_.emplace_back(ascending(facets[f]), static_cast<Index>(f));
    std::sort(entries_.begin(), entries_.end());
  }

  struct Found {
    Index facet;
    bool is_above;  // whether the corners in the given order are seen from above
  };
  [[nodiscard]] std::optional<Found> find(const Triangle& corners) const {
    const auto at =
        std::lower_bound(entries_.begin(), entries_.end(), std::pair(ascending(corners), Index{0}));
    if (at == entries_.end() || at->first != ascending(corners)) return std::nullopt;
    return Found{at->second, turn_alike(facets_[at->second], corners)};
  }

 private:
  static bool turn_alike(const Triangle& f, const Triangle& g) {
    return g == f || g == Triangle{f[1], f[2], f[0]} || g == Triangle{f[2], f[0], f[1]};
  }

  const std::vector<Triangle>& facets_;
  std::vector<std::pair<Triangle, Index>> entries_;  // corners ascending
};

}  // namespace

RefillCavity::Outcome RefillCavity::fill(const CavityFiller& filler) {
  for (int k = 0;; ++k) {
    Filled filled = filler(cavity_.view());
    if (filled.outcome == Filled::Outcome::done) return judge(std::move(filled.volume));
    if (k == tuning::kMostTriesWithPoints) filled.faulty.clear();
    if (!cavity_.drop_points(filled))
      return filled.outcome == Filled::Outcome::invalid ? Outcome::invalid : Outcome::not_representable;
  }
}

RefillCavity::Outcome RefillCavity::judge(Volume volume) {
  if (std::any_of(volume.regions.begin(), volume.regions.end(), [](int region) { return region < 0; }))
    return Outcome::invalid;
  const std::optional<Owners> owners = owners_in(volume);
  if (!owners) return Outcome::overlaps;
  if (splits(*owners)) return Outcome::invalid;
  volume_ = std::move(volume);
  owner_.clear();
  for (const int region : volume_.regions)
    owner_.push_back((*owners)[static_cast<std::size_t>(region)].value_or(kOutside));
  if (joins_outside()) return Outcome::invalid;
  return keeps_segments_and_vertices() ? Outcome::filled : Outcome::outside;
}

// Each facet determines the owners of the regions on its two sides. All facets of a region must agree, and
// every side that belongs to the cavity must be filled.
std::optional<RefillCavity::Owners> RefillCavity::owners_in(const Volume& volume) const {
  const int most =
      volume.regions.empty() ? 0 : *std::max_element(volume.regions.begin(), volume.regions.end());
  Owners owners(static_cast<std::size_t>(most) + 1);
  const FacetIndex facets(cavity_.facets());
  const std::vector<CavityComplex::Sides>& sides = cavity_.sides();
  std::vector<std::array<bool, 2>> seen(sides.size(), {false, false});
  for (std::size_t t = 0; t < volume.tetrahedra.size(); ++t) {
    const Tetrahedron& c = volume.tetrahedra[t];
    for (int i = 0; i < 4; ++i) {
      const auto found = facets.find(corners_of_face(c, i));
      if (!found) continue;
      const auto [facet, is_above] = *found;
      seen[facet][is_above ? 0 : 1] = true;
      const Index owner = is_above ? sides[facet].above : sides[facet].below;
      std::optional<Index>& known = owners[static_cast<std::size_t>(volume.regions[t])];
      if (known && *known != owner) return std::nullopt;
      known = owner;
    }
  }
  for (std::size_t f = 0; f < sides.size(); ++f)
    if ((sides[f].above != kOutside && !seen[f][0]) || (sides[f].below != kOutside && !seen[f][1]))
      return std::nullopt;
  return owners;
}

// Whether disconnected parts of space fill one part of the cavity. The boundary allows this if tetrahedra
// surrounded by the cavity lie inside out beside it. Then one part would fill the cavity's own place, and the
// other would close these tetrahedra off. They would be enclosed by the volume and could never become
// positive.
bool RefillCavity::splits(const Owners& owners) const {
  if (cavity_.is_whole()) return false;  // a filling then has only boundary of the volume
  std::vector<bool> met(cavity_.regions().size(), false);
  for (const std::optional<Index>& owner : owners) {
    if (!owner || *owner == kOutside) continue;
    if (met[*owner]) return true;
    met[*owner] = true;
  }
  return false;
}

// Whether a new edge or face already exists outside the cavity: the mesh there is still tangled with the
// cavity.
bool RefillCavity::joins_outside() const {
  const std::vector<Vertex>& vertex = cavity_.vertices();
  const auto only_outside = [&](std::span<const Index> corners) {
    if (std::any_of(corners.begin(), corners.end(), [&](Index v) { return v >= cavity_.first_point(); }))
      return false;
    bool outside = false, inside = false;
    for (const Tet s : tangle_.star(vertex[corners[0]]))
      if (std::all_of(corners.begin(), corners.end(), [&](Index v) { return tangle_.holds(s, vertex[v]); }))
        (cavity_.part_of(s) == kOutside ? outside : inside) = true;
    return outside && !inside;
  };
  for (std::size_t t = 0; t < volume_.tetrahedra.size(); ++t) {
    if (owner_[t] == kOutside) continue;
    const Tetrahedron& c = volume_.tetrahedra[t];
    for (int edge = 0; edge < 6; ++edge)
      if (only_outside(ends_of_edge(c, edge))) return true;
    for (int i = 0; i < 4; ++i)
      if (only_outside(corners_of_face(c, i))) return true;
  }
  return false;
}

// The filler drops everything outside: this may include free vertices, but nothing that must stay.
bool RefillCavity::keeps_segments_and_vertices() const {
  std::vector<bool> held(cavity_.vertices().size(), false);
  std::vector<Segment> edges;
  const std::vector<Segment>& segments = cavity_.segments();
  for (std::size_t t = 0; t < volume_.tetrahedra.size(); ++t) {
    if (owner_[t] == kOutside) continue;
    const Tetrahedron& c = volume_.tetrahedra[t];
    for (const Index v : c)
      if (v < held.size()) held[v] = true;
    if (segments.empty()) continue;
    for (int edge = 0; edge < 6; ++edge) {
      const auto [a, b] = ends_of_edge(c, edge);
      edges.push_back(ascending(Segment{a, b}));
    }
  }
  std::sort(edges.begin(), edges.end());
  return std::all_of(held.begin(), held.begin() + static_cast<std::ptrdiff_t>(cavity_.first_point()),
                     [](bool x) { return x; }) &&
         std::all_of(segments.begin(), segments.end(),
                     [&](const Segment& s) { return std::binary_search(edges.begin(), edges.end(), s); });
}

void RefillCavity::apply(Tangle& tangle) const {
  for (const Tet t : cavity_.tets()) tangle.remove_tet(t);
  std::vector<Vertex> vertex = cavity_.vertices();
  vertex.resize(volume_.vertices.size(), kNone);
  for (std::size_t t = 0; t < volume_.tetrahedra.size(); ++t) {
    if (owner_[t] == kOutside) continue;
    Tangle::Corners corners{};
    for (std::size_t i = 0; i < 4; ++i) {
      Vertex& v = vertex[volume_.tetrahedra[t][i]];
      if (v == kNone) v = tangle.add_vertex(volume_.vertices[volume_.tetrahedra[t][i]]);
      corners[i] = v;
    }
    tangle.add_tet(corners, cavity_.regions()[owner_[t]]);
  }
}

}  // namespace holdfast
