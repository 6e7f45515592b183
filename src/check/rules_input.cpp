// Check: rules on the input's facets and segments. A missing entity is "lost" if tetrahedra are in its place
// (it was split, swapped or moved), and "dropped" if it lies outside all of them. The difference is decided
// exactly; if the mesh has no well-defined outside, the entity counts as lost.
#include <algorithm>
#include <string>

#include "check/examination.h"
#include "check/findings.h"
#include "text/count.h"

namespace holdfast::checking {

namespace {

/// Whether the edges of a list are edges of tetrahedra.
std::vector<bool> edges_exist(const std::vector<Segment>& wanted, const Volume& volume, Pulse& pulse) {
  if (wanted.empty()) return {};
  std::vector<Segment> edges;
  std::vector<bool> is_end(volume.vertices.size(), false);
  for (const auto& [x, y] : wanted) {
    if (std::max(x, y) >= volume.vertices.size()) continue;
    edges.push_back({std::min(x, y), std::max(x, y)});
    is_end[x] = is_end[y] = true;
  }
  std::sort(edges.begin(), edges.end());
  std::vector<bool> seen(edges.size(), false);
  for (const Tetrahedron& t : volume.tetrahedra) {
    pulse();
    for (std::size_t i = 0; i < 3; ++i) {
      if (!is_end[t[i]]) continue;
      for (std::size_t j = i + 1; j < 4; ++j) {
        if (!is_end[t[j]]) continue;
        const Segment edge{std::min(t[i], t[j]), std::max(t[i], t[j])};
        const auto place = std::lower_bound(edges.begin(), edges.end(), edge);
        if (place != edges.end() && *place == edge)
          seen[static_cast<std::size_t>(place - edges.begin())] = true;
      }
    }
  }
  std::vector<bool> exist;
  exist.reserve(wanted.size());
  for (const auto& [x, y] : wanted) {
    const Segment edge{std::min(x, y), std::max(x, y)};
    const auto place = std::lower_bound(edges.begin(), edges.end(), edge);
    exist.push_back(place != edges.end() && *place == edge &&
                    seen[static_cast<std::size_t>(place - edges.begin())]);
  }
  return exist;
}

/// The fate of an entity that is not in the mesh.
template <class Entity>
Fate fate_of_missing(const Examination& on, const Entity& entity) {
  on.pulse();
  const bool decidable = on.disjoint && on.vertices_kept;
  return decidable && on.boundary->outside(entity) ? Fate::dropped : Fate::lost;
}

std::string facet_words(const Examination& on, std::size_t facet) {
  return words("input facet", facet, on.surface.facets[facet], on.surface.vertices);
}

std::string segment_words(const Examination& on, std::size_t segment) {
  return words("input segment", segment, on.surface.segments[segment], on.surface.vertices);
}

std::string voids_words(const Examination& on) {
  if (!on.disjoint) return {};
  const std::vector<Index> voids = on.boundary->voids();
  if (voids.empty()) return {};
  Findings findings;
  for (const Index face : voids)
    findings.add(
        [&] { return words("one beside face", on.boundary->faces()[face].corners, on.volume.vertices); });
  return "; " + findings.text("enclosed regions are left empty");
}

}  // namespace

void find_input_faces(Examination& on) {
  if (!on.well_formed) return;
  on.faces = FaceTable(on.volume.tetrahedra, on.volume.vertices.size(), on.pulse);
  on.input_face.assign(on.faces.size(), false);
  on.facets.assign(on.input.facets.size(), Fate::lost);
  for (std::size_t i = 0; i < on.input.facets.size(); ++i) {
    on.pulse();
    if (const std::size_t place = on.faces.find(on.input.facets[i]); place != FaceTable::none) {
      on.input_face[place] = true;
      on.facets[i] = Fate::kept;
    }
  }
}

void find_fates(Examination& on) {
  if (!on.well_formed) return;
  for (std::size_t i = 0; i < on.facets.size(); ++i)
    if (on.facets[i] == Fate::lost) on.facets[i] = fate_of_missing(on, on.input.facets[i]);

  for (const bool exists : edges_exist(on.input.segments, on.volume, on.pulse))
    on.segments.push_back(exists ? Fate::kept : fate_of_missing(on, on.input.segments[on.segments.size()]));

  on.vertices.assign(on.volume.vertices.size(), Fate::lost);
  for (const Tetrahedron& tetrahedron : on.volume.tetrahedra)
    for (const Index vertex : tetrahedron) on.vertices[vertex] = Fate::kept;
  const std::size_t input = std::min(on.input_vertices(), on.vertices.size());
  for (std::size_t i = 0; i < input; ++i)
    if (on.vertices[i] == Fate::lost) on.vertices[i] = fate_of_missing(on, static_cast<Index>(i));
}

Rule facets_kept(const Examination& on) {
  constexpr RuleKind kind = RuleKind::facets_kept;
  if (!on.well_formed) return not_examined(kind, not_well_formed);
  Findings findings;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < on.facets.size(); ++i) {
    if (on.facets[i] == Fate::kept) ++kept;
    if (on.facets[i] == Fate::lost)
      findings.add([&] { return facet_words(on, i) + " is no face of the mesh"; });
  }
  return judge(kind, findings, "input facets lost",
               counted(kept, "input facet") + ", each one face of the mesh");
}

Rule segments_kept(const Examination& on) {
  constexpr RuleKind kind = RuleKind::segments_kept;
  if (!on.well_formed) return not_examined(kind, not_well_formed);
  Findings findings;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < on.segments.size(); ++i) {
    if (on.segments[i] == Fate::kept) ++kept;
    if (on.segments[i] == Fate::lost)
      findings.add([&] { return segment_words(on, i) + " is no edge of the mesh"; });
  }
  // Sides of kept facets are edges, because the sides of faces are.
  std::vector<Segment> sides;
  for (std::size_t i = 0; i < on.facets.size(); ++i)
    if (const Triangle& facet = on.input.facets[i]; on.facets[i] == Fate::lost)
      for (std::size_t k = 0; k < 3; ++k)
        sides.push_back({std::min(facet[k], facet[(k + 1) % 3]), std::max(facet[k], facet[(k + 1) % 3])});
  std::sort(sides.begin(), sides.end());
  sides.erase(std::unique(sides.begin(), sides.end()), sides.end());
  const std::vector<bool> exist = edges_exist(sides, on.volume, on.pulse);
  for (std::size_t i = 0; i < sides.size(); ++i)
    if (!exist[i])
      findings.add([&] {
        const Segment given{on.input.first[sides[i][0]], on.input.first[sides[i][1]]};
        return words("facet side", given, on.surface.vertices) + " is no edge of the mesh";
      });
  return judge(kind, findings, "input segments or facet sides lost",
               counted(kept, "input segment") + " and all facet sides are edges of the mesh");
}

Rule nothing_dropped(const Examination& on) {
  constexpr RuleKind kind = RuleKind::nothing_dropped;
  if (!on.well_formed) return not_examined(kind, not_well_formed);
  Findings findings;
  const auto lost = [&](const std::vector<Fate>& fates) {
    return std::count(fates.begin(), fates.end(), Fate::lost) > 0;
  };
  if ((lost(on.facets) || lost(on.segments)) && !(on.disjoint && on.vertices_kept))
    return not_examined(kind,
                        "facets or segments are missing, and the mesh has no outside that could be told");
  for (std::size_t i = 0; i < on.facets.size(); ++i)
    if (on.facets[i] == Fate::dropped) findings.add([&] { return facet_words(on, i); });
  for (std::size_t i = 0; i < on.segments.size(); ++i)
    if (on.segments[i] == Fate::dropped) findings.add([&] { return segment_words(on, i); });
  const std::string_view what = "input facets and segments lie outside all tetrahedra";
  if (on.options.outside_dropped && !findings.empty())
    return {kind, name(kind), true, findings.text(what) + voids_words(on)};
  Rule rule = judge(kind, findings, what, "no input facet or segment is outside");
  rule.detail += voids_words(on);
  return rule;
}

}  // namespace holdfast::checking
