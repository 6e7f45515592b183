// Check: rules on the tetrahedra as a partition of space.
#include <algorithm>
#include <string>

#include "check/examination.h"
#include "check/findings.h"
#include "check/intersect.h"
#include "exact/predicates.h"
#include "text/count.h"

namespace holdfast::checking {

namespace {

std::string tetrahedron_words(const Examination& on, std::size_t tetrahedron) {
  return words("tetrahedron", tetrahedron, on.volume.tetrahedra[tetrahedron], on.volume.vertices);
}

std::string face_words(const Examination& on, const BoundaryFace& face) {
  return words("face", face.corners, on.volume.vertices) + " of tetrahedron " +
         std::to_string(face.tetrahedron);
}

/// Whether a face lies in a side of the mesh's bounding box.
bool in_side_of_box(const Triangle& face, std::span<const Point> vertices, const Box& box) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const double side : {box.low[axis], box.high[axis]})
      if (std::all_of(face.begin(), face.end(), [&](Index vertex) { return vertices[vertex][axis] == side; }))
        return true;
  return false;
}

Box box_of_tetrahedra(const Volume& volume) {
  Box box(volume.vertices[volume.tetrahedra[0][0]]);
  for (const Tetrahedron& tetrahedron : volume.tetrahedra)
    for (const Index vertex : tetrahedron) box.extend(volume.vertices[vertex]);
  return box;
}

}  // namespace

Rule positive_volumes(Examination& on) {
  constexpr RuleKind kind = RuleKind::volumes_positive;
  if (!on.well_formed) return not_examined(kind, not_well_formed);
  Findings findings;
  on.orientation.reserve(on.volume.tetrahedra.size());
  for (std::size_t i = 0; i < on.volume.tetrahedra.size(); ++i) {
    on.pulse();
    const Tetrahedron& t = on.volume.tetrahedra[i];
    const auto corner = [&](std::size_t k) { return on.volume.vertices[t[k]].data(); };
    const int sign = exact::orient3d(corner(0), corner(1), corner(2), corner(3));
    on.orientation.push_back(static_cast<std::int16_t>(sign));
    if (sign <= 0)
      findings.add(
          [&] { return tetrahedron_words(on, i) + (sign < 0 ? " is negative" : " is of zero volume"); });
  }
  on.positive = findings.empty();
  return judge(kind, findings, "tetrahedra are not positive",
               counted(on.volume.tetrahedra.size(), "tetrahedron", "tetrahedra") + ", all positive");
}

Rule faces_matched(Examination& on) {
  constexpr RuleKind kind = RuleKind::faces_matched;
  if (!on.well_formed) return not_examined(kind, not_well_formed);
  Findings crowded, folded;
  std::size_t shared = 0, alone = 0;
  on.faces.for_each([&](std::size_t, const Triangle& face, std::span<const HalfFace> halves) {
    on.pulse();
    const auto face_and_two = [&](std::string_view what) {
      return words("face", face, on.volume.vertices) + std::string(what) + " tetrahedra " +
             std::to_string(halves[0].tetrahedron()) + " and " + std::to_string(halves[1].tetrahedron());
    };
    if (halves.size() > 2) {
      crowded.add([&] { return face_and_two(" of " + std::to_string(halves.size()) + ", among them"); });
    } else if (halves.size() == 1) {
      ++alone;
    } else {
      ++shared;
      // The side of the sorted face on which a tetrahedron lies: its parity tells, if the tetrahedron is
      // positive.
      const auto side = [&](const HalfFace& half) {
        const int orientation = on.orientation[half.tetrahedron()];
        return half.odd() ? -orientation : orientation;
      };
      if (side(halves[0]) * side(halves[1]) > 0) folded.add([&] { return face_and_two(" has on one side"); });
    }
  });
  on.matched = crowded.empty() && folded.empty();
  if (!crowded.empty()) {
    Rule rule = judge(kind, crowded, "faces of more than two tetrahedra", {});
    if (!folded.empty()) rule.detail += "; " + folded.text("faces with both tetrahedra on one side");
    return rule;
  }
  return judge(kind, folded, "faces with both tetrahedra on one side",
               counted(shared, "face") + " of two tetrahedra, " + std::to_string(alone) + " of one");
}

Rule boundary_is_input(const Examination& on) {
  constexpr RuleKind kind = RuleKind::boundary_is_input;
  if (!on.well_formed) return not_examined(kind, not_well_formed);
  Findings findings;
  std::size_t facets = 0, others = 0;
  const Box box = box_of_tetrahedra(on.volume);
  on.faces.for_each([&](std::size_t begin, const Triangle& face, std::span<const HalfFace> halves) {
    on.pulse();
    if (halves.size() != 1) return;
    if (on.input_face[begin]) {
      ++facets;
    } else if (on.options.box && in_side_of_box(face, on.volume.vertices, box)) {
      ++others;
    } else {
      findings.add([&] {
        return words("face", face, on.volume.vertices) + " of tetrahedron " +
               std::to_string(halves[0].tetrahedron()) + " only";
      });
    }
  });
  return judge(kind, findings, "boundary faces are not input facets",
               std::to_string(facets) + " boundary faces are input facets" +
                   (others > 0 ? ", " + std::to_string(others) + " in the sides of the box" : ""));
}

Rule no_overlap(Examination& on) {
  constexpr RuleKind kind = RuleKind::no_overlap;
  if (!on.well_formed) return not_examined(kind, not_well_formed);
  if (!on.positive) return not_examined(kind, "some tetrahedra are not positive");
  if (!on.matched) return not_examined(kind, "some faces are not matched");
  on.boundary.emplace(on.faces, on.volume.tetrahedra, on.volume.vertices, on.pulse);
  const std::vector<BoundaryFace>& faces = on.boundary->faces();

  Findings crossing;
  for (const auto& [x, y] : on.boundary->crossing_pairs(on.pulse))
    crossing.add([&, x = x, y = y] { return face_words(on, faces[x]) + " and " + face_words(on, faces[y]); });
  if (!crossing.empty()) return judge(kind, crossing, "pairs of boundary faces intersect", {});

  Findings multiple;
  std::size_t sheets = 0;
  for (const auto& [face, count] : on.boundary->covers(on.pulse)) {
    ++sheets;
    if (count != 1)
      multiple.add([&, face = face, count = count] {
        return "inside " + face_words(on, faces[face]) + " there are " + std::to_string(count) +
               " tetrahedra";
      });
  }
  on.disjoint = multiple.empty();
  return judge(kind, multiple, "boundary sheets lie inside other tetrahedra",
               std::to_string(faces.size()) + " boundary faces in " + std::to_string(sheets) +
                   " sheets, each covered once");
}

Rule steiner_points_inside(const Examination& on) {
  constexpr RuleKind kind = RuleKind::steiner_points_inside;
  if (!on.well_formed) return not_examined(kind, not_well_formed);
  const std::span<const Point> vertices = on.volume.vertices;
  const std::size_t first = std::min(on.input_vertices(), vertices.size());
  std::vector<Index> facet_at(vertices.size(), 0);  // by vertex: 1 + the tetrahedron of a boundary face, or 0
  on.faces.for_each([&](std::size_t, const Triangle& face, std::span<const HalfFace> halves) {
    if (halves.size() == 1)
      for (const Index vertex : face) facet_at[vertex] = halves[0].tetrahedron() + 1;
  });

  const std::span<const Triangle> facets = on.surface.facets;
  const std::span<const Segment> segments = on.surface.segments;
  BoxTree tree;
  if (first < vertices.size()) {
    std::vector<Box> boxes;
    boxes.reserve(facets.size() + segments.size());
    for (const Triangle& facet : facets) boxes.push_back(box_of(facet, on.surface.vertices));
    for (const Segment& segment : segments) boxes.push_back(box_of(segment, on.surface.vertices));
    tree = BoxTree(std::move(boxes));
  }

  Findings findings;
  std::size_t on_box = 0;
  const auto at = [&](Index vertex) { return on.surface.vertices[vertex].data(); };
  for (std::size_t i = first; i < vertices.size(); ++i) {
    on.pulse();
    const Point& point = vertices[i];
    const std::string_view what = "Steiner vertex ";
    if (facet_at[i] != 0 && on.options.box) ++on_box;
    if (facet_at[i] != 0 && !on.options.box)
      findings.add([&] {
        return std::string(what) + std::to_string(i) + " " + words(point) +
               " is on the boundary, at tetrahedron " + std::to_string(facet_at[i] - 1);
      });
    const Box box(point);
    tree.query([&](const Box& other) { return other.meets(box); },
               [&](std::size_t item) {
                 if (item < facets.size()) {
                   const Triangle& facet = facets[item];
                   if (on_triangle(point.data(), {at(facet[0]), at(facet[1]), at(facet[2])}))
                     findings.add([&] {
                       return std::string(what) + std::to_string(i) + " " + words(point) + " lies on " +
                              words("input facet", item, facet, on.surface.vertices);
                     });
                 } else {
                   const Segment& segment = segments[item - facets.size()];
                   if (on_segment(point.data(), at(segment[0]), at(segment[1])))
                     findings.add([&] {
                       return std::string(what) + std::to_string(i) + " " + words(point) + " lies on " +
                              words("input segment", item - facets.size(), segment, on.surface.vertices);
                     });
                 }
               });
  }
  return judge(kind, findings, "places where Steiner points are on the input or the boundary",
               std::to_string(vertices.size() - first) + " Steiner points" +
                   (on_box > 0 ? ", " + std::to_string(on_box) + " of them on the box" : ""));
}

}  // namespace holdfast::checking
