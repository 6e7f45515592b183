// Check: rules on vertices and indices. Indices may be out of range here.
#include <algorithm>
#include <bit>
#include <cmath>
#include <string>

#include "check/examination.h"
#include "check/findings.h"
#include "numbers/finite.h"
#include "text/count.h"

namespace holdfast::checking {

namespace {

bool same_bits(const Point& x, const Point& y) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (std::bit_cast<std::uint64_t>(x[axis]) != std::bit_cast<std::uint64_t>(y[axis])) return false;
  return true;
}

std::string vertex_words(std::string_view whose, std::size_t vertex, const Point& point) {
  return std::string(whose) + " vertex " + std::to_string(vertex) + " " + words(point);
}

template <std::size_t size>
void find_out_of_range(std::string_view kind, std::span<const std::array<Index, size>> entities,
                       std::span<const Point> vertices, Findings& findings) {
  for (std::size_t i = 0; i < entities.size(); ++i)
    if (!std::all_of(entities[i].begin(), entities[i].end(),
                     [&](Index vertex) { return vertex < vertices.size(); }))
      findings.add(
          [&] { return words(kind, i, entities[i], vertices) + " names a vertex that does not exist"; });
}

bool repeats(const Tetrahedron& t) {
  return t[0] == t[1] || t[0] == t[2] || t[0] == t[3] || t[1] == t[2] || t[1] == t[3] || t[2] == t[3];
}

}  // namespace

Rule vertices_kept(Examination& on) {
  Findings findings;
  const auto given = [&](std::size_t i) { return on.input.first[i]; };
  const std::size_t there = std::min(on.input_vertices(), on.volume.vertices.size());
  for (std::size_t i = 0; i < there; ++i)
    if (const Point& was = on.surface.vertices[given(i)], &is = on.volume.vertices[i]; !same_bits(was, is))
      findings.add([&] {
        return vertex_words("input", given(i), was) +
               (given(i) == i ? "" : ", mesh vertex " + std::to_string(i) + ",") + " became " + words(is);
      });
  for (std::size_t i = there; i < on.input_vertices(); ++i)
    findings.add(
        [&] { return vertex_words("input", given(i), on.surface.vertices[given(i)]) + " is missing"; });
  on.vertices_kept = findings.empty();
  const std::string all = counted(on.surface.vertices.size(), "input vertex", "input vertices");
  return judge(RuleKind::input_vertices_kept, findings, "input vertices changed or missing",
               (on.input_vertices() == on.surface.vertices.size()
                    ? all
                    : std::to_string(on.input_vertices()) + " distinct places of " + all) +
                   ", bit for bit");
}

Rule well_formed(Examination& on) {
  const Volume& volume = on.volume;
  Findings findings;
  if (volume.tetrahedra.empty()) findings.add([] { return std::string("the mesh has no tetrahedra"); });
  if (volume.tetrahedra.size() > FaceTable::most_tetrahedra)
    findings.add([] { return std::string("the mesh has more tetrahedra than can be examined"); });
  for (std::size_t i = 0; i < volume.vertices.size(); ++i)
    if (!is_finite(volume.vertices[i]))
      findings.add([&] { return vertex_words("mesh", i, volume.vertices[i]) + " is not finite"; });
  for (const Index v : on.input.first)
    if (const Point& point = on.surface.vertices[v]; !is_finite(point))
      findings.add([&] { return vertex_words("input", v, point) + " is not finite"; });
  find_out_of_range<4>("tetrahedron", volume.tetrahedra, volume.vertices, findings);
  find_out_of_range<3>("input facet", on.surface.facets, on.surface.vertices, findings);
  find_out_of_range<2>("input segment", on.surface.segments, on.surface.vertices, findings);
  for (std::size_t i = 0; i < volume.tetrahedra.size(); ++i)
    if (repeats(volume.tetrahedra[i]))
      findings.add([&] {
        return words("tetrahedron", i, volume.tetrahedra[i], volume.vertices) + " names a vertex twice";
      });
  on.well_formed = findings.empty();
  return judge(RuleKind::well_formed, findings, "malformed entities",
               counted(volume.tetrahedra.size(), "tetrahedron", "tetrahedra") + ", " +
                   counted(volume.vertices.size(), "vertex", "vertices"));
}

Rule no_vertex_unused(const Examination& on) {
  constexpr RuleKind kind = RuleKind::no_vertex_unused;
  if (!on.well_formed) return not_examined(kind, not_well_formed);
  Findings findings;
  std::size_t dropped = 0;
  for (std::size_t i = 0; i < on.vertices.size(); ++i) {
    if (on.vertices[i] == Fate::kept) continue;
    if (on.vertices[i] == Fate::dropped && on.options.outside_dropped) {
      ++dropped;
      continue;
    }
    findings.add([&] {
      const bool given = i < on.input_vertices();
      return vertex_words(given ? "input" : "Steiner", given ? on.input.first[i] : i, on.volume.vertices[i]) +
             (on.vertices[i] == Fate::dropped ? " is outside all tetrahedra" : " is in no tetrahedron");
    });
  }
  return judge(
      kind, findings, "unused vertices",
      counted(on.vertices.size() - dropped, "vertex", "vertices") + " used" +
          (dropped > 0 ? ", " + counted(dropped, "input vertex", "input vertices") + " outside" : ""));
}

}  // namespace holdfast::checking
