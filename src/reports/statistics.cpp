// What a mesh holds, as JSON (docs/command-line.md has the keys).
#include "holdfast/holdfast.h"
#include "reports.h"

namespace holdfast::reports {
namespace {

using Group = Statistics::Group;

/// A list with the names that counts and measures have for this kind of entity.
Json list_of(const std::vector<Group>& groups, const char* count, const char* measure,
             bool with_area = false) {
  Json list = Json::array();
  for (const Group& group : groups) {
    Json item{{"id", group.id}, {count, group.count}};
    item["name"] = group.name.empty() ? Json() : Json(group.name);
    if (measure != nullptr) item[measure] = group.measure;
    if (with_area) item["area"] = group.area;
    list.push_back(std::move(item));
  }
  return list;
}

}  // namespace

Json to_json(const Statistics& s) {
  return {
      {"vertices", s.vertices},
      {"unused_vertices", s.unused_vertices},
      {"mid_nodes", s.mid_nodes},
      {"order", s.mid_nodes > 0 ? 2 : 1},
      {"tetrahedra", s.tetrahedra},
      {"triangles", s.facets},
      {"segments", s.segments},
      {"edges", s.edges},
      {"box", {s.low, s.high}},
      {"edge_length", {{"shortest", s.shortest_edge}, {"mean", s.mean_edge}, {"longest", s.longest_edge}}},
      {"area", s.area},
      {"volume", s.volume},
      {"boundary_area", s.boundary_area},
      {"closed", s.closed},
      {"regions", list_of(s.regions, "tetrahedra", "volume", true)},
      {"markers", list_of(s.facet_markers, "triangles", "area")},
      {"segment_markers", list_of(s.segment_markers, "segments", "length")},
      {"vertex_markers", list_of(s.vertex_markers, "vertices", nullptr)},
      {"quality",
       {{"negative", s.negative},
        {"null", s.null},
        {"worst", s.worst_quality},
        {"min_dihedral_deg", s.min_dihedral_deg},
        {"max_dihedral_deg", s.max_dihedral_deg},
        {"least_dihedral_histogram", s.least_dihedral},
        {"quality_bins", Report::quality_bins},
        {"quality_histogram", s.quality}}},
      {"version", version()}};
}

}  // namespace holdfast::reports
