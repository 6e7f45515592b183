// Check: rules on region ids and markers.
#include <algorithm>
#include <map>
#include <numeric>
#include <string>

#include "check/disjoint_sets.h"
#include "check/examination.h"
#include "check/findings.h"
#include "text/count.h"

namespace holdfast::checking {

namespace {

/// Input entities by their sorted vertices.
template <class Entity>
class Lookup {
 public:
  explicit Lookup(std::span<const Entity> entities)
      : sorted_(entities.begin(), entities.end()), index_(entities.size()) {
    for (Entity& entity : sorted_) std::sort(entity.begin(), entity.end());
    std::iota(index_.begin(), index_.end(), std::size_t{0});
    std::sort(index_.begin(), index_.end(), [&](std::size_t x, std::size_t y) {
      return sorted_[x] != sorted_[y] ? sorted_[x] < sorted_[y] : x < y;
    });
  }
  /// All entities with these vertices, in any order.
  [[nodiscard]] std::span<const std::size_t> find(Entity entity) const {
    std::sort(entity.begin(), entity.end());
    const auto begin =
        std::partition_point(index_.begin(), index_.end(), [&](auto i) { return sorted_[i] < entity; });
    const auto end = std::find_if(begin, index_.end(), [&](auto i) { return sorted_[i] != entity; });
    return std::span(index_).subspan(static_cast<std::size_t>(begin - index_.begin()),
                                     static_cast<std::size_t>(end - begin));
  }

 private:
  std::vector<Entity> sorted_;
  std::vector<std::size_t> index_;
};

/// One kind of entity, with its lists in the input and in the volume.
template <class Entity>
struct Listing {
  std::string_view kind;
  std::span<const Entity> input;  ///< by vertices of the mesh
  std::span<const Entity> given;  ///< the same entities by vertices of the surface
  std::span<const int> input_markers;
  std::span<const Entity> listed;
  std::span<const int> listed_markers;
  const std::vector<Fate>& fates;  ///< of the input's entities; empty if not known
  /// Sorted, with sorted corners: entities that may be listed although they are not in the input.
  std::span<const Entity> tolerated = {};
};

/// Markers of facets that occur several times in the input with different markers: the facet may carry a new
/// marker that no input facet has, provided it is always the same for the same set.
class MarkersOfSets {
 public:
  explicit MarkersOfSets(std::span<const int> given) : given_(given.begin(), given.end()) {
    std::sort(given_.begin(), given_.end());
  }
  bool may_stand_for(int marker, std::vector<int> set) {
    std::sort(set.begin(), set.end());
    set.erase(std::unique(set.begin(), set.end()), set.end());
    if (set.size() < 2 || std::binary_search(given_.begin(), given_.end(), marker)) return false;
    const auto [of_set, set_is_new] = marker_of_.try_emplace(set, marker);
    const auto [of_marker, marker_is_new] = set_of_.try_emplace(marker, set);
    return of_set->second == marker && of_marker->second == set;
  }

 private:
  std::vector<int> given_;
  std::map<std::vector<int>, int> marker_of_;
  std::map<int, std::vector<int>> set_of_;
};

template <class Entity>
void find_wrong_markers(const Listing<Entity>& on, const Examination& whole, Findings& findings) {
  const auto bad_length = [&](std::string_view whose, std::size_t markers, std::size_t entities) {
    if (markers == 0 || markers == entities) return false;
    findings.add([&] {
      return std::string(whose) + " " + counted(markers, "marker") + " for " +
             counted(entities, std::string(on.kind));
    });
    return true;
  };
  if (bad_length("the input has", on.input_markers.size(), on.input.size())) return;
  if (bad_length("the mesh has", on.listed_markers.size(), on.listed.size())) return;
  const bool marked = !on.input_markers.empty();
  if (on.listed.empty() && !marked) return;
  if (marked && on.listed_markers.empty() && !on.listed.empty())
    findings.add([&] { return "the mesh lists " + std::string(on.kind) + "s without the input's markers"; });

  const auto in_mesh = [&](std::size_t i) { return on.fates.empty() || on.fates[i] == Fate::kept; };
  const Lookup<Entity> lookup(on.input);
  std::vector<bool> seen(on.input.size(), false);
  MarkersOfSets sets(on.input_markers);
  for (std::size_t i = 0; i < on.listed.size(); ++i) {
    const auto say = [&](const std::string& what) {
      findings.add([&] {
        return words("listed " + std::string(on.kind), i, on.listed[i], whole.volume.vertices) + what;
      });
    };
    whole.pulse();
    const std::span<const std::size_t> same = lookup.find(on.listed[i]);
    if (same.empty()) {
      Entity sorted = on.listed[i];
      std::sort(sorted.begin(), sorted.end());
      if (!std::binary_search(on.tolerated.begin(), on.tolerated.end(), sorted)) say(" is not in the input");
      continue;
    }
    if (!in_mesh(same[0])) say(" is not in the mesh");
    if (seen[same[0]]) say(" is listed twice");
    for (const std::size_t j : same) seen[j] = true;
    if (!marked || on.listed_markers.empty()) continue;
    const int marker = on.listed_markers[i];
    std::vector<int> wanted;
    for (const std::size_t j : same) wanted.push_back(on.input_markers[j]);
    const bool is_one = std::find(wanted.begin(), wanted.end(), marker) != wanted.end();
    constexpr bool kHasSets = std::tuple_size_v<Entity> == 3;  // of facets alone
    if (!is_one && !(kHasSets && sets.may_stand_for(marker, wanted)))
      say(" has marker " + std::to_string(marker) + " instead of " +
          std::to_string(on.input_markers[same[0]]));
  }
  if (!marked) return;
  for (std::size_t i = 0; i < on.input.size(); ++i)
    if (!seen[i] && in_mesh(i))
      findings.add([&] {
        return words("input " + std::string(on.kind), i, on.given[i], whole.surface.vertices) +
               " of marker " + std::to_string(on.input_markers[i]) + " is not listed";
      });
}

// At a place of several vertices, the first marker that is not 0 counts.
void find_wrong_vertex_markers(const Examination& on, Findings& findings) {
  const std::span<const int> input = on.surface.vertex_markers, kept = on.volume.vertex_markers;
  if (input.empty()) return;
  if (input.size() != on.surface.vertices.size() || kept.size() != on.volume.vertices.size()) {
    findings.add([&] {
      return std::to_string(input.size()) + " vertex markers for " +
             counted(on.surface.vertices.size(), "vertex", "vertices") + " of the input, " +
             std::to_string(kept.size()) + " for " + std::to_string(on.volume.vertices.size()) +
             " of the mesh";
    });
    return;
  }
  std::vector<int> wanted(on.input_vertices(), 0);
  for (std::size_t v = 0; v < input.size(); ++v)
    if (const Index i = on.input.vertex[v]; i != no_vertex && wanted[i] == 0) wanted[i] = input[v];
  for (std::size_t i = 0; i < std::min(wanted.size(), kept.size()); ++i)
    if (kept[i] != wanted[i] && on.volume.vertices[i] == on.surface.vertices[on.input.first[i]])
      findings.add([&] {
        return "vertex " + std::to_string(on.input.first[i]) + " has marker " + std::to_string(kept[i]) +
               " instead of " + std::to_string(wanted[i]);
      });
}

/// Faces on the sides of the bounding box: formats that need every boundary face list them.
std::vector<Triangle> faces_of_box(const Examination& on) {
  std::vector<Triangle> found;
  if (!on.options.box || !on.well_formed || on.volume.facets.empty()) return found;
  on.faces.for_each([&](std::size_t begin, Triangle face, std::span<const HalfFace> halves) {
    on.pulse();
    if (halves.size() != 1 || on.input_face[begin]) return;
    std::sort(face.begin(), face.end());
    found.push_back(face);
  });
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace

Rule regions_numbered(const Examination& on) {
  constexpr RuleKind kind = RuleKind::regions_numbered;
  const std::vector<int>& ids = on.volume.regions;
  if (ids.size() != on.volume.tetrahedra.size())
    return {kind, name(kind), false,
            std::to_string(ids.size()) + " region ids for " + std::to_string(on.volume.tetrahedra.size()) +
                " tetrahedra"};
  if (!on.well_formed) return not_examined(kind, not_well_formed);

  Findings findings;
  DisjointSets regions(ids.size());
  on.faces.for_each([&](std::size_t begin, const Triangle& face, std::span<const HalfFace> halves) {
    on.pulse();
    if (on.input_face[begin]) return;
    for (const HalfFace& half : halves.subspan(1)) {
      const Index x = halves[0].tetrahedron(), y = half.tetrahedron();
      regions.join(x, y);
      if (ids[x] != ids[y])
        findings.add([&] {
          return "no facet separates tetrahedron " + std::to_string(x) + " (id " + std::to_string(ids[x]) +
                 ") from tetrahedron " + std::to_string(y) + " (id " + std::to_string(ids[y]) +
                 "): " + words("face", face, on.volume.vertices);
        });
    }
  });
  std::vector<int> of_region;
  for (Index t = 0; t < ids.size(); ++t)
    if (regions.find(t) == t) of_region.push_back(ids[t]);
  const std::size_t count = of_region.size();
  std::sort(of_region.begin(), of_region.end());
  of_region.erase(std::unique(of_region.begin(), of_region.end()), of_region.end());
  return judge(kind, findings, "places where ids change inside a region",
               counted(count, "region") + ", " + counted(of_region.size(), "different id"));
}

Rule markers_kept(const Examination& on) {
  const Complex& surface = on.surface;
  const Volume& volume = on.volume;
  Findings findings;
  find_wrong_vertex_markers(on, findings);
  const std::vector<Triangle> of_box = faces_of_box(on);
  find_wrong_markers<Triangle>({"facet", on.input.facets, surface.facets, surface.facet_markers,
                                volume.facets, volume.facet_markers, on.facets, of_box},
                               on, findings);
  // Sides of kept facets are kept too, and TetGen's .edge files list them.
  std::vector<Segment> sides;
  if (!volume.segments.empty())
    for (const auto& [a, b, c] : on.input.facets)
      for (const auto& [p, q] : {Segment{a, b}, Segment{b, c}, Segment{c, a}})
        sides.push_back({std::min(p, q), std::max(p, q)});
  std::sort(sides.begin(), sides.end());
  find_wrong_markers<Segment>({"segment", on.input.segments, surface.segments, surface.segment_markers,
                               volume.segments, volume.segment_markers, on.segments, sides},
                              on, findings);
  return judge(RuleKind::markers_kept, findings, "wrong facets, segments or markers",
               counted(volume.facets.size(), "facet") + " and " + counted(volume.segments.size(), "segment") +
                   " listed");
}

}  // namespace holdfast::checking
