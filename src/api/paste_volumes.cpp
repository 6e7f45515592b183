// Tetrahedral meshes pasted together: their boundaries are made to fit, and only the tetrahedra where these
// changed are replaced.
//
// What goes are the tetrahedra with a face, a cut edge or a moved corner of a changed triangle. The rest of
// each region keeps its faces, so that what has to be filled is bounded by these and by the new triangles;
// the mesher keeps them all.
#include <algorithm>
#include <map>
#include <set>
#include <unordered_map>
#include <unordered_set>

#include "api/part_volumes.h"
#include "holdfast/paste.h"
#include "numbers/float_environment.h"
#include "numbers/sorted.h"
#include "surface/places.h"

namespace holdfast {
namespace {

/// Vertices of all volumes are counted in turn, and so are their boundary's. The whole counts on from the
/// former.
class Pasting {
 public:
  Pasting(std::span<const Volume> volumes, std::span<const Boundary> boundaries, const PasteOptions& options,
          PastedVolumes& result)
      : volumes_(volumes), boundaries_(boundaries), options_(options), result_(result) {}

  void run() {
    list_vertices();
    list_edges();
    for (Index k = 0; k < volumes_.size(); ++k) {
      find_changed(k);
      take_kept(k);
      for (const int region : regions_of(k))
        if (!refill(k, region)) return;
    }
    take_facets();
    drop_unused();
  }

 private:
  [[nodiscard]] const Surface& surface() const { return result_.boundary.surface; }

  void list_vertices() {
    for (const Volume& volume : volumes_) {
      first_.push_back(static_cast<Index>(vertices_.size()));
      vertices_.insert(vertices_.end(), volume.vertices.begin(), volume.vertices.end());
    }
    const std::size_t given = given_on_boundary();
    const std::vector<Index> place = first_at_places(surface().vertices);
    of_boundary_.resize(surface().vertices.size());
    std::size_t b = 0;
    for (Index k = 0; k < boundaries_.size(); ++k)
      for (const Index v : boundaries_[k].vertices) {
        of_boundary_[b] = first_[k] + v;
        vertices_[of_boundary_[b]] = surface().vertices[b];
        ++b;
      }
    for (b = given; b < of_boundary_.size(); ++b) {
      of_boundary_[b] = static_cast<Index>(vertices_.size());
      vertices_.push_back(surface().vertices[b]);
    }
    same_as_.resize(vertices_.size());
    for (Index v = 0; v < same_as_.size(); ++v) same_as_[v] = v;
    for (b = 0; b < of_boundary_.size(); ++b)
      if (place[b] != no_entity) same_as_[of_boundary_[b]] = of_boundary_[place[b]];
    for (const auto& [vertex, distance] : result_.boundary.moved) moved_.insert(of_boundary_[vertex]);
  }

  [[nodiscard]] std::size_t given_on_boundary() const {
    std::size_t count = 0;
    for (const Boundary& boundary : boundaries_) count += boundary.vertices.size();
    return count;
  }

  [[nodiscard]] Triangle in_whole(const Triangle& of_surface) const {
    Triangle t{};
    for (std::size_t i = 0; i < 3; ++i) t[i] = same_as_[of_boundary_[of_surface[i]]];
    return t;
  }
  [[nodiscard]] Triangle in_whole(Index k, const Triangle& of_volume) const {
    Triangle t{};
    for (std::size_t i = 0; i < 3; ++i) t[i] = same_as_[first_[k] + of_volume[i]];
    return t;
  }

  void list_edges() {
    children_.resize(result_.boundary.part_of_facet.size());
    for (Index f = 0; f < surface().facets.size(); ++f) {
      const Triangle t = in_whole(surface().facets[f]);
      faces_.push_back(t);
      for (std::size_t i = 0; i < 3; ++i) edges_.insert(ascending(Segment{t[i], t[(i + 1) % 3]}));
      const std::size_t first = result_.boundary.parents.first[f];
      for (std::size_t p = 0; p < result_.boundary.parents[f].size(); ++p)
        children_[result_.boundary.parents[f][p]].push_back({f, result_.boundary.turned[first + p] != 0});
    }
  }

  // --- What changed -----------------------------------------------------------------------------------

  void find_changed(Index k) {
    const Volume& volume = volumes_[k];
    const Boundary& boundary = boundaries_[k];
    changed_.clear();
    std::set<Segment> cut;
    for (Index f = 0; f < boundary.facets.size(); ++f) {
      const Triangle t = in_whole(k, boundary.facets[f]);
      if (!is_kept(k, f, t)) changed_.insert(boundary.face[f]);
      for (std::size_t i = 0; i < 3; ++i) {
        const Segment edge = ascending(Segment{t[i], t[(i + 1) % 3]});
        if (edges_.count(edge) == 0) cut.insert(edge);
      }
    }
    goes_.assign(volume.tetrahedra.size(), 0);
    for (const Index face : changed_) goes_[face / 4] = 1;
    for (Index t = 0; t < volume.tetrahedra.size(); ++t) {
      if (goes_[t] != 0) continue;
      Tetrahedron whole = volume.tetrahedra[t];
      for (Index& v : whole) v += first_[k];
      for (std::size_t i = 0; i < 4; ++i) {
        if (moved_.count(whole[i]) != 0) goes_[t] = 1;
        for (std::size_t j = i + 1; j < 4 && goes_[t] == 0 && !cut.empty(); ++j)
          if (cut.count(ascending(Segment{same_as_[whole[i]], same_as_[whole[j]]})) != 0) goes_[t] = 1;
      }
    }
  }

  [[nodiscard]] bool is_kept(Index k, Index f, const Triangle& t) const {
    const auto& children = children_[result_.boundary.parts[k].first_facet + f];
    return children.size() == 1 && ascending(faces_[children[0].facet]) == ascending(t);
  }

  [[nodiscard]] int region_of(Index k, Index tet) const {
    return volumes_[k].regions.empty() ? 0 : volumes_[k].regions[tet];
  }

  [[nodiscard]] int new_id(Index k, int region) const { return boundaries_[k].id_of.at(region); }

  void take_kept(Index k) {
    const Volume& volume = volumes_[k];
    for (Index t = 0; t < volume.tetrahedra.size(); ++t) {
      if (goes_[t] != 0) {
        ++result_.replaced;
        continue;
      }
      Tetrahedron whole{};
      for (std::size_t i = 0; i < 4; ++i) whole[i] = same_as_[first_[k] + volume.tetrahedra[t][i]];
      add(whole, new_id(k, region_of(k, t)), static_cast<std::int64_t>(boundaries_[k].first_tetrahedron + t));
    }
  }

  void add(const Tetrahedron& t, int region, std::int64_t origin) {
    result_.volume.tetrahedra.push_back(t);
    result_.volume.regions.push_back(region);
    result_.origin.push_back(origin);
  }

  // --- What replaces it -------------------------------------------------------------------------------

  [[nodiscard]] std::set<int> regions_of(Index k) const {
    std::set<int> regions;
    for (Index t = 0; t < goes_.size(); ++t)
      if (goes_[t] != 0) regions.insert(region_of(k, t));
    return regions;
  }

  /// The faces round what goes, seen from outside it.
  [[nodiscard]] std::vector<Triangle> hull_of(Index k, int region) const {
    const Volume& volume = volumes_[k];
    std::map<Triangle, Triangle> open;  // by ascending corners of the volume
    std::vector<Triangle> hull;
    std::map<Index, Index> facet_at;  // by face
    for (Index f = 0; f < boundaries_[k].face.size(); ++f) facet_at[boundaries_[k].face[f]] = f;
    for (Index t = 0; t < goes_.size(); ++t) {
      if (goes_[t] == 0 || region_of(k, t) != region) continue;
      for (Index i = 0; i < 4; ++i) {
        const Triangle face = face_of(volume.tetrahedra[t], i);
        if (const auto facet = facet_at.find(4 * t + i); facet != facet_at.end()) {
          add_children(k, facet->second, face, hull);
          continue;
        }
        const auto [there, is_new] = open.try_emplace(ascending(face), face);
        if (!is_new) open.erase(there);
      }
    }
    for (const auto& [key, face] : open) hull.push_back(in_whole(k, face));
    return hull;
  }

  void add_children(Index k, Index f, const Triangle& face, std::vector<Triangle>& hull) const {
    if (changed_.count(boundaries_[k].face[f]) == 0) {
      hull.push_back(in_whole(k, face));
      return;
    }
    for (const Child& child : children_[result_.boundary.parts[k].first_facet + f]) {
      Triangle t = faces_[child.facet];
      if (child.is_turned) std::swap(t[1], t[2]);
      hull.push_back(t);
    }
  }

  bool refill(Index k, int region) {
    const std::vector<Triangle> hull = hull_of(k, region);
    Surface cavity;
    std::unordered_map<Index, Index> local;
    std::vector<Index> whole;
    const auto number = [&](Index v) {
      const auto [there, is_new] = local.try_emplace(v, static_cast<Index>(whole.size()));
      if (is_new) {
        whole.push_back(v);
        cavity.vertices.push_back(vertices_[v]);
      }
      return there->second;
    };
    for (const Triangle& t : hull) cavity.facets.push_back({number(t[0]), number(t[1]), number(t[2])});
    for (Index t = 0; t < goes_.size(); ++t)  // vertices inside stay, too
      if (goes_[t] != 0 && region_of(k, t) == region)
        for (const Index v : volumes_[k].tetrahedra[t]) number(same_as_[first_[k] + v]);
    Options filling;
    static_cast<Limits&>(filling) = options_;
    filling.keep = Keep::winding;
    filling.threads = options_.threads;
    if (options_.progress)
      filling.progress = [&](const Progress& progress) { return options_.progress(progress.overall); };
    const Result filled = mesh(cavity.view(), filling);
    if (filled.outcome != Outcome::done) {
      result_.outcome = filled.outcome;
      result_.message = "the tetrahedra of " + result_.boundary.parts[k].name +
                        " at the new triangles cannot be replaced: " + filled.message;
      return false;
    }
    for (std::size_t v = whole.size(); v < filled.volume.vertices.size(); ++v) {
      whole.push_back(static_cast<Index>(vertices_.size()));
      vertices_.push_back(filled.volume.vertices[v]);
      same_as_.push_back(whole.back());
    }
    for (Tetrahedron t : filled.volume.tetrahedra) {
      for (Index& v : t) v = whole[v];
      add(t, new_id(k, region), -1);
    }
    return true;
  }

  // --- The result -------------------------------------------------------------------------------------

  /// The boundary's, then those that the volumes list inside.
  void take_facets() {
    Volume& volume = result_.volume;
    volume.facets = faces_;
    volume.facet_markers = surface().facet_markers;
    std::set<Triangle> there;
    for (const Triangle& t : faces_) there.insert(ascending(t));
    for (Index k = 0; k < volumes_.size(); ++k) {
      const Volume& given = volumes_[k];
      std::set<Triangle> outer;
      for (const Triangle& t : boundaries_[k].facets) outer.insert(ascending(t));
      for (std::size_t f = 0; f < given.facets.size(); ++f) {
        if (outer.count(ascending(given.facets[f])) != 0) continue;
        const Triangle t = in_whole(k, given.facets[f]);
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
    for (std::size_t v = 0; v < vertices_.size(); ++v) {
      number[v] = static_cast<Index>(result_.volume.vertices.size());
      if (used[v] != 0) result_.volume.vertices.push_back(vertices_[v]);
    }
    for (Tetrahedron& t : result_.volume.tetrahedra)
      for (Index& v : t) v = number[v];
    for (Triangle& t : result_.volume.facets)
      for (Index& v : t) v = number[v];
  }

  struct Child {
    Index facet;
    bool is_turned;
  };

  const std::span<const Volume> volumes_;
  const std::span<const Boundary> boundaries_;
  const PasteOptions& options_;
  PastedVolumes& result_;
  std::vector<Point> vertices_;               // of the whole
  std::vector<Index> first_;                  // by volume, its first vertex in the whole
  std::vector<Index> of_boundary_;            // by vertex of the boundary's surface, in the whole
  std::vector<Index> same_as_;                // by vertex of the whole, the first at its place
  std::unordered_set<Index> moved_;           // of the whole
  std::vector<Triangle> faces_;               // of the boundary's surface, in the whole
  std::vector<std::vector<Child>> children_;  // by facet of the boundaries in turn
  std::set<Segment> edges_;                   // of faces_
  std::set<Index> changed_;                   // of the volume at hand: 4 * tetrahedron + face
  std::vector<std::uint8_t> goes_;            // by tetrahedron
};

}  // namespace

PastedVolumes paste(std::span<const Volume> volumes, const PasteOptions& options,
                    std::span<const std::string> names) {
  const FloatEnvironment environment;
  PastedVolumes result;
  std::vector<Boundary> boundaries = boundaries_of(volumes);
  std::vector<Surface> surfaces;
  for (std::size_t k = 0; k < volumes.size(); ++k) surfaces.push_back(surface_of(volumes[k], boundaries[k]));
  result.boundary = paste(surfaces, options, names);
  result.outcome = result.boundary.outcome;
  result.message = result.boundary.message;
  if (result.outcome != Outcome::done) return result;
  number_regions(volumes, boundaries, result.boundary);
  Pasting(volumes, boundaries, options, result).run();
  if (result.outcome != Outcome::done) result.volume = {};
  return result;
}

}  // namespace holdfast
