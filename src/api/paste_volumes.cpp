// Pastes tetrahedral meshes together: their boundaries are made to fit, and only the tetrahedra at changed
// triangles are replaced.
//
// The replaced tetrahedra have a face, a cut edge or a moved corner of a changed triangle. The rest of each
// region keeps its faces. These and the new triangles bound the polyhedra to fill, and the mesher preserves
// them all.
#include <algorithm>
#include <map>
#include <set>
#include <unordered_map>
#include <unordered_set>

#include "api/part_volumes.h"
#include "holdfast/paste.h"
#include "mesh/started.h"
#include "numbers/float_environment.h"
#include "numbers/sorted.h"
#include "surface/places.h"

namespace holdfast {
namespace {

// Share of the work on boundaries, for progress; the rest are replacements.
constexpr double kWorkOnBoundaries = 0.5;

/// Maps the progress of a part of the work to that of the whole.
ProgressFunction part_of(const ProgressFunction& whole, double from, double to) {
  if (!whole) return {};
  return [&whole, from, to](double fraction) { return whole(from + fraction * (to - from)); };
}

/// The vertices of all volumes in order, with those of the boundary where pasting moved them, followed by new
/// ones. The first of several vertices at one place represents them.
class WholeVertices {
 public:
  WholeVertices(std::span<const Volume> volumes, std::span<const Boundary> boundaries,
                const PasteResult& pasted) {
    for (const Volume& volume : volumes) {
      first_.push_back(static_cast<Index>(points_.size()));
      points_.insert(points_.end(), volume.vertices.begin(), volume.vertices.end());
    }
    const std::span<const Point> surface = pasted.surface.vertices;
    std::vector<Index>& whole = of_surface_;
    for (Index k = 0; k < boundaries.size(); ++k)
      for (const Index v : boundaries[k].vertices) {
        points_[first_[k] + v] = surface[whole.size()];
        whole.push_back(first_[k] + v);
      }
    while (whole.size() < surface.size()) {
      whole.push_back(static_cast<Index>(points_.size()));
      points_.push_back(surface[whole.size() - 1]);
    }
    for (Index v = 0; v < points_.size(); ++v) same_as_.push_back(v);
    const std::vector<Index> place = first_at_places(surface);
    for (std::size_t b = 0; b < whole.size(); ++b)
      if (place[b] != no_entity) same_as_[whole[b]] = whole[place[b]];
    for (const auto& [vertex, distance] : pasted.moved) moved_.insert(whole[vertex]);
  }

  [[nodiscard]] std::size_t size() const { return points_.size(); }
  [[nodiscard]] const Point& point(Index v) const { return points_[v]; }
  /// Whether pasting moved a vertex of a volume.
  [[nodiscard]] bool is_moved(Index k, Index of_volume) const {
    return moved_.count(first_[k] + of_volume) != 0;
  }
  [[nodiscard]] Index of_volume(Index k, Index v) const { return same_as_[first_[k] + v]; }
  template <std::size_t N>
  [[nodiscard]] std::array<Index, N> of_volume(Index k, std::array<Index, N> entity) const {
    for (Index& v : entity) v = of_volume(k, v);
    return entity;
  }
  [[nodiscard]] Triangle of_surface(Triangle t) const {
    for (Index& v : t) v = same_as_[of_surface_[v]];
    return t;
  }

  Index add(const Point& p) {
    points_.push_back(p);
    same_as_.push_back(static_cast<Index>(same_as_.size()));
    return same_as_.back();
  }

 private:
  std::vector<Point> points_;
  std::vector<Index> first_;       // by volume, its first vertex
  std::vector<Index> of_surface_;  // by vertex of the pasted surface
  std::vector<Index> same_as_;     // by vertex, the first one at its place
  std::unordered_set<Index> moved_;
};

/// The pasted surface in the whole, and the children of each facet of the boundaries, which are counted in
/// order.
class WholeFaces {
 public:
  struct Child {
    Index face;
    bool is_turned;
  };

  WholeFaces(const PasteResult& pasted, const WholeVertices& vertices)
      : pasted_(pasted), children_(pasted.part_of_facet.size()) {
    for (Index f = 0; f < pasted.surface.facets.size(); ++f) {
      const Triangle t = vertices.of_surface(pasted.surface.facets[f]);
      all_.push_back(t);
      for (std::size_t i = 0; i < 3; ++i) edges_.insert(ascending(Segment{t[i], t[(i + 1) % 3]}));
      const std::size_t first = pasted.parents.first[f];
      for (std::size_t p = 0; p < pasted.parents[f].size(); ++p)
        children_[pasted.parents[f][p]].push_back({f, pasted.turned[first + p] != 0});
    }
  }

  [[nodiscard]] const std::vector<Triangle>& all() const { return all_; }
  [[nodiscard]] bool has_edge(const Segment& edge) const { return edges_.count(ascending(edge)) != 0; }
  /// The children of facet f of volume k's boundary.
  [[nodiscard]] const std::vector<Child>& children(Index k, Index f) const {
    return children_[pasted_.parts[k].first_facet + f];
  }
  /// Whether this facet is still a single face in the whole.
  [[nodiscard]] bool is_kept(Index k, Index f, const Triangle& t) const {
    const auto& faces = children(k, f);
    return faces.size() == 1 && ascending(all_[faces[0].face]) == ascending(t);
  }

 private:
  const PasteResult& pasted_;
  std::vector<Triangle> all_;
  std::vector<std::vector<Child>> children_;
  std::set<Segment> edges_;
};

/// What pasting changes in one volume.
struct VolumeChange {
  std::set<Index> faces;           ///< changed faces of its boundary: 4 * tetrahedron + face
  std::vector<std::uint8_t> goes;  ///< by tetrahedron, whether it is replaced
  std::set<int> regions;           ///< with replaced tetrahedra
};

int region_of(const Volume& volume, Index tet) { return volume.regions.empty() ? 0 : volume.regions[tet]; }

std::set<int> regions_of(const Volume& volume, std::span<const std::uint8_t> goes) {
  std::set<int> regions;
  for (Index t = 0; t < goes.size(); ++t)
    if (goes[t] != 0) regions.insert(region_of(volume, t));
  return regions;
}

VolumeChange change_of(Index k, const Volume& volume, const Boundary& boundary, const WholeVertices& vertices,
                       const WholeFaces& faces) {
  VolumeChange change;
  std::set<Segment> cut;
  for (Index f = 0; f < boundary.facets.size(); ++f) {
    const Triangle t = vertices.of_volume(k, boundary.facets[f]);
    if (!faces.is_kept(k, f, t)) change.faces.insert(boundary.face[f]);
    for (std::size_t i = 0; i < 3; ++i) {
      const Segment edge{t[i], t[(i + 1) % 3]};
      if (!faces.has_edge(edge)) cut.insert(ascending(edge));
    }
  }
  change.goes.assign(volume.tetrahedra.size(), 0);
  for (const Index face : change.faces) change.goes[face / 4] = 1;
  for (Index t = 0; t < volume.tetrahedra.size(); ++t) {
    if (change.goes[t] != 0) continue;
    const Tetrahedron whole = vertices.of_volume(k, volume.tetrahedra[t]);
    for (std::size_t i = 0; i < 4; ++i) {
      if (vertices.is_moved(k, volume.tetrahedra[t][i])) change.goes[t] = 1;
      for (std::size_t j = i + 1; j < 4 && change.goes[t] == 0 && !cut.empty(); ++j)
        if (cut.count(ascending(Segment{whole[i], whole[j]})) != 0) change.goes[t] = 1;
    }
  }
  change.regions = regions_of(volume, change.goes);
  return change;
}

/// Makes the volume inside a pasted boundary.
class Pasting {
 public:
  Pasting(std::span<const Volume> volumes, std::span<const Boundary> boundaries, const PasteOptions& options,
          PastedVolumes& result)
      : volumes_(volumes),
        boundaries_(boundaries),
        options_(options),
        result_(result),
        vertices_(volumes, boundaries, result.boundary),
        faces_(result.boundary, vertices_) {}

  void run() {
    std::vector<VolumeChange> changes;
    for (Index k = 0; k < volumes_.size(); ++k) {
      changes.push_back(change_of(k, volumes_[k], boundaries_[k], vertices_, faces_));
      refills_ += changes[k].regions.size();
    }
    for (Index k = 0; k < volumes_.size(); ++k) {
      take_kept(k, changes[k]);
      for (const int region : changes[k].regions)
        if (!refill(k, region, changes[k])) return;
    }
    take_facets();
    drop_unused();
  }

 private:
  [[nodiscard]] const Surface& surface() const { return result_.boundary.surface; }
  [[nodiscard]] int new_id(Index k, int region) const { return boundaries_[k].id_of.at(region); }
  /// The share of the work done after `refilled` regions.
  [[nodiscard]] double done(std::size_t refilled) const {
    return kWorkOnBoundaries +
           (1 - kWorkOnBoundaries) * static_cast<double>(refilled) / static_cast<double>(refills_);
  }

  void take_kept(Index k, const VolumeChange& change) {
    const Volume& volume = volumes_[k];
    for (Index t = 0; t < volume.tetrahedra.size(); ++t) {
      if (change.goes[t] != 0) {
        ++result_.replaced;
        continue;
      }
      add(vertices_.of_volume(k, volume.tetrahedra[t]), new_id(k, region_of(volume, t)),
          static_cast<std::int64_t>(boundaries_[k].first_tetrahedron + t));
    }
  }

  void add(const Tetrahedron& t, int region, std::int64_t origin) {
    result_.volume.tetrahedra.push_back(t);
    result_.volume.regions.push_back(region);
    result_.origin.push_back(origin);
  }

  /// The faces around the removed tetrahedra, seen from outside them.
  [[nodiscard]] std::vector<Triangle> hull_of(Index k, int region, const VolumeChange& change) const {
    const Volume& volume = volumes_[k];
    std::map<Triangle, Triangle> open;  // by sorted corners
    std::vector<Triangle> hull;
    std::map<Index, Index> facet_at;  // by face
    for (Index f = 0; f < boundaries_[k].face.size(); ++f) facet_at[boundaries_[k].face[f]] = f;
    for (Index t = 0; t < change.goes.size(); ++t) {
      if (change.goes[t] == 0 || region_of(volume, t) != region) continue;
      for (Index i = 0; i < 4; ++i) {
        const Triangle face = face_of(volume.tetrahedra[t], i);
        if (const auto facet = facet_at.find(4 * t + i); facet != facet_at.end()) {
          add_children(k, facet->second, face, change, hull);
          continue;
        }
        const auto [there, is_new] = open.try_emplace(ascending(face), face);
        if (!is_new) open.erase(there);
      }
    }
    for (const auto& [key, face] : open) hull.push_back(vertices_.of_volume(k, face));
    return hull;
  }

  void add_children(Index k, Index f, const Triangle& face, const VolumeChange& change,
                    std::vector<Triangle>& hull) const {
    if (change.faces.count(boundaries_[k].face[f]) == 0) {
      hull.push_back(vertices_.of_volume(k, face));
      return;
    }
    for (const WholeFaces::Child& child : faces_.children(k, f)) {
      Triangle t = faces_.all()[child.face];
      if (child.is_turned) std::swap(t[1], t[2]);
      hull.push_back(t);
    }
  }

  /// A polyhedron to fill, and the number of its vertices in the whole.
  struct Cavity {
    Surface surface;
    std::vector<Index> whole;
  };

  /// The removed part of a region, bounded by the faces around it; vertices inside are kept.
  [[nodiscard]] Cavity cavity_of(Index k, int region, const VolumeChange& change) const {
    Cavity cavity;
    std::unordered_map<Index, Index> local;
    const auto number = [&](Index v) {
      const auto [there, is_new] = local.try_emplace(v, static_cast<Index>(cavity.whole.size()));
      if (is_new) {
        cavity.whole.push_back(v);
        cavity.surface.vertices.push_back(vertices_.point(v));
      }
      return there->second;
    };
    for (const Triangle& t : hull_of(k, region, change))
      cavity.surface.facets.push_back({number(t[0]), number(t[1]), number(t[2])});
    for (Index t = 0; t < change.goes.size(); ++t)
      if (change.goes[t] != 0 && region_of(volumes_[k], t) == region)
        for (const Index v : volumes_[k].tetrahedra[t]) number(vertices_.of_volume(k, v));
    return cavity;
  }

  bool refill(Index k, int region, const VolumeChange& change) {
    auto [surface, whole] = cavity_of(k, region, change);
    Options filling;
    static_cast<Limits&>(filling) = options_;
    filling.keep = Keep::winding;
    filling.threads = options_.threads;
    const ProgressFunction tell = part_of(options_.progress, done(refilled_), done(refilled_ + 1));
    ++refilled_;
    if (tell) filling.progress = [&](const Progress& progress) { return tell(progress.overall); };
    const Result filled = mesh(surface.view(), filling);
    if (filled.outcome != Outcome::done) {
      result_.outcome = filled.outcome;
      result_.message = "the tetrahedra of " + result_.boundary.parts[k].name +
                        " at the new triangles cannot be replaced: " + filled.message;
      return false;
    }
    for (std::size_t v = whole.size(); v < filled.volume.vertices.size(); ++v)
      whole.push_back(vertices_.add(filled.volume.vertices[v]));
    for (Tetrahedron t : filled.volume.tetrahedra) {
      for (Index& v : t) v = whole[v];
      add(t, new_id(k, region), -1);
    }
    return true;
  }

  /// The facets of the boundary, then those that the volumes list inside.
  void take_facets() {
    Volume& volume = result_.volume;
    volume.facets = faces_.all();
    volume.facet_markers = surface().facet_markers;
    std::set<Triangle> there;
    for (const Triangle& t : faces_.all()) there.insert(ascending(t));
    for (Index k = 0; k < volumes_.size(); ++k) {
      const Volume& given = volumes_[k];
      std::set<Triangle> outer;
      for (const Triangle& t : boundaries_[k].facets) outer.insert(ascending(t));
      for (std::size_t f = 0; f < given.facets.size(); ++f) {
        if (outer.count(ascending(given.facets[f])) != 0) continue;
        const Triangle t = vertices_.of_volume(k, given.facets[f]);
        if (!there.insert(ascending(t)).second) continue;
        volume.facets.push_back(t);
        if (!volume.facet_markers.empty())
          volume.facet_markers.push_back(given.facet_markers.empty() ? 0 : given.facet_markers[f]);
      }
    }
    volume.names = surface().names;
  }

  void drop_unused() {
    std::vector<std::uint8_t> used(vertices_.size(), 0);
    for (const Tetrahedron& t : result_.volume.tetrahedra)
      for (const Index v : t) used[v] = 1;
    std::vector<Index> number(vertices_.size());
    for (Index v = 0; v < vertices_.size(); ++v) {
      number[v] = static_cast<Index>(result_.volume.vertices.size());
      if (used[v] != 0) result_.volume.vertices.push_back(vertices_.point(v));
    }
    for (Tetrahedron& t : result_.volume.tetrahedra)
      for (Index& v : t) v = number[v];
    for (Triangle& t : result_.volume.facets)
      for (Index& v : t) v = number[v];
  }

  const std::span<const Volume> volumes_;
  const std::span<const Boundary> boundaries_;
  const PasteOptions& options_;
  PastedVolumes& result_;
  WholeVertices vertices_;
  WholeFaces faces_;
  std::size_t refills_ = 0, refilled_ = 0;
};

}  // namespace

PastedVolumes paste(std::span<const Volume> volumes, const PasteOptions& given,
                    std::span<const std::string> names) {
  const FloatEnvironment environment;
  PasteOptions options = given;
  static_cast<Limits&>(options) = started(given);
  PastedVolumes result;
  std::vector<Boundary> boundaries = boundaries_of(volumes);
  std::vector<Surface> surfaces;
  for (std::size_t k = 0; k < volumes.size(); ++k) surfaces.push_back(surface_of(volumes[k], boundaries[k]));
  PasteOptions of_boundaries = options;
  of_boundaries.progress = part_of(options.progress, 0, kWorkOnBoundaries);
  of_boundaries.overlap = Overlap::refuse;  // the tetrahedra of both parts would remain
  result.boundary = paste(surfaces, of_boundaries, names);
  result.outcome = result.boundary.outcome;
  result.message = result.boundary.message;
  if (result.outcome != Outcome::done) return result;
  number_regions(volumes, boundaries, names, result.boundary);
  Pasting(volumes, boundaries, options, result).run();
  if (result.outcome != Outcome::done) result.volume = {};
  return result;
}

}  // namespace holdfast
