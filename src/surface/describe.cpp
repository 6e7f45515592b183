// Surface layer: findings described as defects.
#include "surface/describe.h"

#include <algorithm>
#include <numeric>
#include <string>

#include "surface/complex.h"
#include "surface/contacts.h"
#include "text/decimal.h"

namespace holdfast {

std::string place(const Point& p) {
  constexpr int kDigits = 10;
  return "(" + decimal(p[0], kDigits) + ", " + decimal(p[1], kDigits) + ", " + decimal(p[2], kDigits) + ")";
}

namespace {

// --- Words

std::string text(const Point& p) { return place(p); }

std::string text(Index i) { return std::to_string(i); }

// "triangle 4", "triangles 4 and 7", "triangles 4, 7, 9 and 12 more".
std::string list(const std::string& noun, std::span<const Index> ids) {
  constexpr std::size_t kShown = 3;
  std::string words = noun + (ids.size() > 1 ? "s " : " ");
  const std::size_t shown = ids.size() <= kShown + 1 ? ids.size() : kShown;
  for (std::size_t i = 0; i < shown; ++i) {
    if (i > 0) words += i + 1 == ids.size() ? " and " : ", ";
    words += text(ids[i]);
  }
  if (shown < ids.size()) words += " and " + std::to_string(ids.size() - shown) + " more";
  return words;
}

std::string places(const std::vector<Point>& where) {
  if (where.empty()) return "";
  if (where.size() == 1) return " at " + text(where[0]);
  return " along " + text(where[0]) + " - " + text(where[1]);
}

// --- Places

Simplex simplex_of(const Complex& complex, const Corners& corners) {
  Simplex simplex;
  simplex.corners = count_of(corners);
  for (unsigned i = 0; i < simplex.corners; ++i) {
    simplex.vertex[i] = corners[i];
    simplex.point[i] = complex.vertices[corners[i]].data();
  }
  if (simplex.corners == 3) static_cast<void>(set_projection(simplex));
  return simplex;
}

// Where two simplices meet: a point, the ends of a segment, or the middle of a polygon.
std::vector<Point> place_of(const Complex& complex, const Finding& finding) {
  std::vector<Point> corners =
      common_corners(simplex_of(complex, finding.first), simplex_of(complex, finding.second));
  if (corners.size() > 2) {
    Point middle{0, 0, 0};
    for (const Point& p : corners) {
      for (unsigned k = 0; k < 3; ++k) middle[k] += p[k] / static_cast<double>(corners.size());
    }
    return {middle};
  }
  std::sort(corners.begin(), corners.end());
  return corners;
}

// --- Entities

std::vector<Index> vertices_of(const Finding& finding) {
  std::vector<Index> vertices;
  for (const Corners& corners : {finding.first, finding.second}) {
    if (count_of(corners) < 3)
      vertices.insert(vertices.end(), corners.begin(), corners.begin() + count_of(corners));
  }
  return vertices;
}

void append(const Elements& elements, std::span<const Index> at, Defect& defect) {
  for (const Index i : at) {
    const Element& element = elements.all[i];
    if (element.corners == 3) defect.facets.push_back(element.id);
    if (element.corners == 2) defect.segments.push_back(element.id);
  }
}

// Appends the facets and segments that are the simplex or have it as a face.
void append(const Elements& elements, const Stars& stars, const Corners& corners, Defect& defect) {
  append(elements, stars.elements_at(corners), defect);
  const Index own = count_of(corners) == 2 ? stars.input_segment(corners) : no_index;
  const auto& segments = defect.segments;
  if (own != no_index && std::find(segments.begin(), segments.end(), own) == segments.end()) {
    defect.segments.push_back(own);
  }
}

// "triangles 7 and 9", "side 3-4 of triangle 7", "segment 5 (3-4)": a simplex by the elements that hold it.
std::string name(const Elements& elements, std::span<const Index> at, const Corners& corners) {
  std::vector<Index> facets, segments;
  for (const Index i : at) (elements.all[i].corners == 3 ? facets : segments).push_back(elements.all[i].id);
  if (count_of(corners) == 3) return list("triangle", facets);
  const std::string ends = text(corners[0]) + "-" + text(corners[1]);
  if (facets.empty()) return list("segment", segments) + " (" + ends + ")";
  return "side " + ends + " of " + list("triangle", facets);
}

std::string message_of(const Complex& complex, const Elements& elements, const Stars& stars,
                       const Finding& finding, const Defect& defect) {
  const std::string where = places(defect.where);
  // Each element of a pair is named separately, even if another element has the same corners.
  const bool swapped = elements.all[finding.pair[1]].corners < elements.all[finding.pair[0]].corners;
  const auto name_of = [&](const Corners& corners, std::size_t which) {
    const std::array<Index, 1> alone{finding.pair[swapped ? 1 - which : which]};
    return finding.is_pair ? name(elements, alone, corners)
                           : name(elements, stars.elements_at(corners), corners);
  };
  const std::string first = count_of(finding.first) == 1 ? "" : name_of(finding.first, 0);
  const std::string second = name_of(finding.second, 1);
  switch (finding.kind) {
    case DefectKind::vertex_in_segment:
    case DefectKind::vertex_in_facet: {
      const std::string vertex = "vertex " + text(finding.first[0]);
      const char* const what = finding.kind == DefectKind::vertex_in_segment ? " (T-junction)" : "";
      return vertex + " " + text(complex.vertices[finding.first[0]]) + " lies inside " + second + what +
             ": split it at this vertex, or move the vertex";
    }
    case DefectKind::segments_cross:
      return first + " and " + second + " cross" + where + ": split both at a new vertex there";
    case DefectKind::segments_overlap:
      return first + " and " + second + " overlap" + where + ": split the longer one, or remove one";
    case DefectKind::segment_pierces_facet:
      return first + " passes through " + second + where + ": split both where they meet, or move one";
    case DefectKind::repeated_facet:
      return list("triangle", defect.facets) + " have the same vertices " + text(finding.first[0]) + ", " +
             text(finding.first[1]) + ", " + text(finding.first[2]) + ": remove one of them";
    case DefectKind::facets_overlap:
      return list("triangle", defect.facets) + " lie in one plane and overlap" +
             (where.empty() ? "" : " around" + where.substr(3)) +
             ": remove one of them, or split both along each other's sides";
    default:
      return list("triangle", defect.facets) + " cross" + where + ": split both along this line, or move one";
  }
}

}  // namespace

Stars::Stars(const Complex& complex, const Elements& elements) : elements_(elements) {
  first_.assign(complex.vertices.size() + 1, 0);
  const auto for_each_corner = [&elements](auto&& visit) {
    for (Index i = 0; i < elements.all.size(); ++i) {
      for (unsigned k = 0; k < elements.all[i].corners; ++k) visit(i, elements.all[i].vertex[k]);
    }
  };
  for_each_corner([&](Index, Index v) { ++first_[v + std::size_t{1}]; });
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  at_.resize(first_.back());
  std::vector<std::size_t> next = first_;
  for_each_corner([&](Index i, Index v) { at_[next[v]++] = i; });
  for (Index s = 0; s < complex.segments.size(); ++s) {
    const auto [a, b] = complex.segments[s];
    const std::vector<Index>& first = elements.places.first;
    if (a >= first.size() || b >= first.size()) continue;
    const Index p = first[a], q = first[b];
    segments_.push_back({{std::min(p, q), std::max(p, q)}, s});
  }
  std::sort(segments_.begin(), segments_.end());
}

std::vector<Index> Stars::elements_at(const Corners& corners) const {
  const unsigned count = count_of(corners);
  const auto degree = [this](Index v) { return first_[v + std::size_t{1}] - first_[v]; };
  const Index rarest = *std::min_element(corners.begin(), corners.begin() + count,
                                         [&](Index a, Index b) { return degree(a) < degree(b); });
  std::vector<Index> found;
  for (std::size_t k = first_[rarest]; k < first_[rarest + std::size_t{1}]; ++k) {
    const Element& element = elements_.all[at_[k]];
    const auto end = element.vertex.begin() + element.corners;
    const bool all = std::all_of(corners.begin(), corners.begin() + count,
                                 [&](Index v) { return std::find(element.vertex.begin(), end, v) != end; });
    if (all) found.push_back(at_[k]);
  }
  return found;
}

Index Stars::input_segment(const Corners& corners) const {
  const Segment ends{corners[0], corners[1]};
  const auto at = std::lower_bound(segments_.begin(), segments_.end(), std::pair(ends, Index{0}));
  return at != segments_.end() && at->first == ends ? at->second : no_index;
}

Defect describe(const Complex& complex, const Flaw& flaw) {
  Defect defect{flaw.kind, {}, {}, {}, {}, {}};
  const std::string noun = flaw.corners == 3 ? "triangle" : flaw.corners == 2 ? "segment" : "vertex";
  const std::string name = noun + " " + text(flaw.id);
  std::vector<Index> corners;
  if (flaw.corners == 3) {
    defect.facets = {flaw.id};
    corners.assign(complex.facets[flaw.id].begin(), complex.facets[flaw.id].end());
  } else if (flaw.corners == 2) {
    defect.segments = {flaw.id};
    corners.assign(complex.segments[flaw.id].begin(), complex.segments[flaw.id].end());
  }
  switch (flaw.kind) {
    case DefectKind::non_finite_coordinate:
      defect.vertices = {flaw.id};
      defect.message = name + " " + text(complex.vertices[flaw.id]) +
                       " has a coordinate that is not finite: correct it, or remove the vertex";
      return defect;
    case DefectKind::index_out_of_range: {
      const Index wrong = *std::max_element(corners.begin(), corners.end());
      defect.message = name + " names vertex " + text(wrong) + ", but there are " +
                       std::to_string(complex.vertices.size()) +
                       " vertices (counted from 0): correct its indices";
      return defect;
    }
    case DefectKind::repeated_vertex:
      defect.vertices = {flaw.other, flaw.id};
      defect.where = {complex.vertices[flaw.other]};
      defect.message = "vertices " + text(flaw.other) + " and " + text(flaw.id) + " are the same point " +
                       text(defect.where[0]) + ": merge them";
      return defect;
    default:
      break;
  }
  // Flat facets and segments: the extent of what they cover.
  defect.vertices = corners;
  const auto less = [&](Index a, Index b) { return complex.vertices[a] < complex.vertices[b]; };
  const auto [low, high] = std::minmax_element(corners.begin(), corners.end(), less);
  defect.where = {complex.vertices[*low]};
  if (complex.vertices[*high] != complex.vertices[*low]) defect.where.push_back(complex.vertices[*high]);
  // Corners at one place are adjacent.
  std::sort(corners.begin(), corners.end(),
            [&](Index a, Index b) { return less(a, b) || (!less(b, a) && a < b); });
  const auto same_place = [&](Index a, Index b) { return complex.vertices[a] == complex.vertices[b]; };
  const auto twin = std::adjacent_find(corners.begin(), corners.end(), same_place);
  const auto triangle = [&] {
    return name + " (" + text(defect.vertices[0]) + ", " + text(defect.vertices[1]) + ", " +
           text(defect.vertices[2]) + ")";
  };
  if (twin != corners.end() && twin[0] == twin[1]) {
    defect.message = name + " names vertex " + text(*twin) + " twice: remove it";
  } else if (flaw.kind == DefectKind::degenerate_segment) {
    defect.message = name + " has zero length" + places(defect.where) + ": remove it";
  } else if (twin != corners.end()) {
    defect.message = triangle() + " has zero area: vertices " + text(twin[0]) + " and " + text(twin[1]) +
                     " are one, at " + text(complex.vertices[*twin]) + "; remove it";
  } else {
    defect.message = triangle() + " has zero area: its vertices are collinear" + places(defect.where) +
                     "; remove it, or move a vertex";
  }
  return defect;
}

Defect describe(const Complex& complex, const Elements& elements, const Stars& stars,
                const Finding& finding) {
  Defect defect{finding.kind, vertices_of(finding), {}, {}, place_of(complex, finding), {}};
  if (finding.is_pair) {
    append(elements, finding.pair, defect);
  } else {
    append(elements, stars, finding.second, defect);
    append(elements, stars, finding.first, defect);
  }
  defect.message = message_of(complex, elements, stars, finding, defect);
  return defect;
}

}  // namespace holdfast
