// Check: rules on vertices and indices. Nothing here assumes that any index can be followed.
#include <algorithm>
#include <bit>
#include <cmath>
#include <string>

#include "check/examination.h"
#include "check/findings.h"

namespace holdfast::checking {

namespace {

bool same_bits(const Point& x, const Point& y) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (std::bit_cast<std::uint64_t>(x[axis]) != std::bit_cast<std::uint64_t>(y[axis])) return false;
  return true;
}

bool finite(const Point& point) {
  return std::isfinite(point[0]) && std::isfinite(point[1]) && std::isfinite(point[2]);
}

std::string vertex_words(std::string_view whose, std::size_t vertex, const Point& point) {
  return std::string(whose) + " vertex " + std::to_string(vertex) + " " + words(point);
}

void find_non_finite(std::string_view whose, std::span<const Point> points, Findings& findings) {
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!finite(points[i]))
      findings.add([&] { return vertex_words(whose, i, points[i]) + " is not finite"; });
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
  const std::size_t there = std::min(on.input_vertices(), on.volume.vertices.size());
  for (std::size_t i = 0; i < there; ++i)
    if (const Point& was = on.surface.vertices[i], &is = on.volume.vertices[i]; !same_bits(was, is))
      findings.add([&] { return vertex_words("input", i, was) + " became " + words(is); });
  for (std::size_t i = there; i < on.input_vertices(); ++i)
    findings.add([&] { return vertex_words("input", i, on.surface.vertices[i]) + " is missing"; });
  on.vertices_kept = findings.empty();
  return judge("input vertices kept", findings, "input vertices changed or missing",
               std::to_string(on.input_vertices()) + " input vertices, bit for bit");
}

Rule well_formed(Examination& on) {
  const Volume& volume = on.volume;
  Findings findings;
  if (volume.tetrahedra.empty()) findings.add([] { return std::string("the mesh has no tetrahedra"); });
  if (volume.tetrahedra.size() > FaceTable::most_tetrahedra)
    findings.add([] { return std::string("the mesh has more tetrahedra than can be examined"); });
  find_non_finite("mesh", volume.vertices, findings);
  find_non_finite("input", on.surface.vertices, findings);
  find_out_of_range<4>("tetrahedron", volume.tetrahedra, volume.vertices, findings);
  find_out_of_range<3>("input facet", on.surface.facets, on.surface.vertices, findings);
  find_out_of_range<2>("input segment", on.surface.segments, on.surface.vertices, findings);
  for (std::size_t i = 0; i < volume.tetrahedra.size(); ++i)
    if (repeats(volume.tetrahedra[i]))
      findings.add([&] {
        return words("tetrahedron", i, volume.tetrahedra[i], volume.vertices) + " names a vertex twice";
      });
  on.well_formed = findings.empty();
  return judge("well formed", findings, "malformed entities",
               std::to_string(volume.tetrahedra.size()) + " tetrahedra, " +
                   std::to_string(volume.vertices.size()) + " vertices");
}

Rule no_vertex_unused(const Examination& on) {
  const std::string name = "no vertex unused";
  if (!on.well_formed) return not_examined(name, not_well_formed);
  Findings findings;
  std::size_t dropped = 0;
  for (std::size_t i = 0; i < on.vertices.size(); ++i) {
    if (on.vertices[i] == Fate::kept) continue;
    if (on.vertices[i] == Fate::dropped && on.options.outside_dropped) {
      ++dropped;
      continue;
    }
    findings.add([&] {
      return vertex_words(i < on.input_vertices() ? "input" : "Steiner", i, on.volume.vertices[i]) +
             (on.vertices[i] == Fate::dropped ? " is outside all tetrahedra" : " is in no tetrahedron");
    });
  }
  return judge(name, findings, "unused vertices",
               std::to_string(on.vertices.size() - dropped) + " vertices used" +
                   (dropped > 0 ? ", " + std::to_string(dropped) + " input vertices outside" : ""));
}

}  // namespace holdfast::checking
