#include "reports.h"

#include <utility>

#include "holdfast/condition.h"
#include "holdfast/names.h"

namespace holdfast::reports {
namespace {

Json to_json(const Defect& defect) {
  return {{"rule", static_cast<int>(defect.kind)},
          {"name", name(defect.kind)},
          {"vertices", defect.vertices},
          {"facets", defect.facets},
          {"segments", defect.segments},
          {"where", defect.where},
          {"message", defect.message}};
}

Json to_json(const std::vector<Warning>& warnings) {
  Json list = Json::array();
  for (const Warning& warning : warnings)
    list.push_back({{"kind", static_cast<int>(warning.kind)},
                    {"name", name(warning.kind)},
                    {"facets", warning.facets},
                    {"border", warning.border},
                    {"where", warning.where},
                    {"message", warning.message}});
  return list;
}

Json to_json(const Report::Shape& shape) {
  return {{"min_dihedral_deg", shape.min_dihedral_deg},
          {"max_dihedral_deg", shape.max_dihedral_deg},
          {"least_dihedral_histogram", shape.least_dihedral},
          {"quality_bins", Report::quality_bins},
          {"quality_histogram", shape.quality}};
}

Json to_json(const Report::Field& field) {
  Json forced = Json::array();
  for (const Report::Forced& f : field.worst_forced)
    forced.push_back(
        {{"tetrahedron", f.tetrahedron}, {"min_dihedral_deg", f.min_dihedral_deg}, {"facets", f.facets}});
  Json limiting = Json::array();
  for (const Report::Field::Limiting& f : field.limiting)
    limiting.push_back({{"facet", f.facet},
                        {"wanted", f.wanted},
                        {"bearable", f.bearable},
                        {"volume", f.volume},
                        {"place", f.place}});
  Json smaller = Json::array();
  for (const Report::Field::SmallerSize& s : field.smaller_sizes)
    smaller.push_back({{"region", s.region}, {"asked", s.asked}, {"used", s.used}});
  return {{"gradation", field.gradation},
          {"before", to_json(field.before)},
          {"after", to_json(field.after)},
          {"edge_length_histogram", field.edge_lengths},
          {"moves", field.moves},
          {"swaps", field.swaps},
          {"contractions", field.contractions},
          {"insertions", field.insertions},
          {"below_10_deg", field.below_10_deg},
          {"forced", field.forced},
          {"across", field.across},
          {"limited_volume", field.limited_volume},
          {"limited_asked_volume", field.limited_asked_volume},
          {"limiting", limiting},
          {"smaller_sizes", smaller},
          {"stopped_early", field.stopped_early},
          {"worst_forced", forced}};
}

Json to_json(const UntangleReport::Improved::Figures& figures) {
  return {{"min_dihedral_deg", figures.min_dihedral_deg},
          {"mean_q", figures.mean_quality},
          {"below_10_deg", figures.below_10_deg},
          {"tetrahedra", figures.tetrahedra}};
}

}  // namespace

Json to_json(const std::vector<Defect>& defects) {
  Json list = Json::array();
  for (const Defect& defect : defects) list.push_back(to_json(defect));
  return list;
}

Json to_json(const std::vector<Remark>& remarks) {
  Json list = Json::array();
  for (const Remark& remark : remarks)
    list.push_back(
        {{"kind", static_cast<int>(remark.kind)}, {"count", remark.count}, {"message", remark.message}});
  return list;
}

Json to_json(const DefectSummary& summary) {
  Json causes = Json::array(), gaps = Json::array();
  for (const DefectGroup& group : summary.groups)
    causes.push_back({{"cause", name(group.cause)},
                      {"count", group.count},
                      {"defects", group.defects},
                      {"worst", group.worst},
                      {"message", group.message}});
  for (const Gap& gap : summary.gaps)
    gaps.push_back({{"vertex", gap.vertex},
                    {"other", gap.other},
                    {"distance", gap.distance},
                    {"open", gap.open},
                    {"message", gap.message}});
  Json json = {{"parts", summary.parts}, {"causes", causes}, {"gaps", gaps}, {"open_sides", summary.border}};
  json["encloses"] = summary.enclosed ? Json(*summary.enclosed) : Json();
  return json;
}

Json to_json(const Names& names) {
  const auto by_id = [](const std::map<int, std::string>& of) {
    Json json = Json::object();
    for (const auto& [id, name] : of) json[std::to_string(id)] = name;
    return json;
  };
  return {{"facets", by_id(names.facets)},
          {"regions", by_id(names.regions)},
          {"segments", by_id(names.segments)},
          {"vertices", by_id(names.vertices)}};
}

Json to_json(const Intermediate& intermediate) {
  Json chains = Json::array(), sub_facets = Json::array(), added = Json::array();
  for (const Intermediate::Chain& chain : intermediate.chains)
    chains.push_back({{"segment", chain.segment}, {"vertices", chain.vertices}});
  for (const Intermediate::SubFacets& pieces : intermediate.sub_facets)
    sub_facets.push_back({{"facet", pieces.facet}, {"faces", pieces.faces}});
  for (const Intermediate::Added& point : intermediate.added) {
    Json json = {{"vertex", point.vertex}};
    if (point.segment) json["segment"] = *point.segment;
    if (point.facet) json["facet"] = *point.facet;
    added.push_back(std::move(json));
  }
  return {{"missing_segments", intermediate.missing_segments},
          {"missing_facets", intermediate.missing_facets},
          {"chains", chains},
          {"sub_facets", sub_facets},
          {"added", added}};
}

Json to_json(const Result& result, Json options) {
  const Report& report = result.report;
  const Condition condition = holdfast::condition(result.volume);
  Json sets = Json::object();
  for (const auto& [marker, set] : result.marker_sets) sets[std::to_string(marker)] = set;
  const auto missing = [](const Report::Missing& m) {
    return Json{{"missing_segments", m.segments}, {"missing_facets", m.facets}};
  };
  return {
      {"input",
       {{"vertices", report.input.vertices},
        {"merged_vertices", report.input.merged_vertices},
        {"left_out_vertices", report.input.left_out_vertices},
        {"segments", report.input.segments},
        {"facets", report.input.facets},
        {"components", report.input.components},
        {"closed", report.input.closed},
        {"nonmanifold_segments", report.input.nonmanifold_segments},
        {"dangling_facets", report.input.dangling_facets}}},
      {"delaunay", missing(report.delaunay)},
      {"flips", missing(report.flips)},
      {"partition", {{"segment_points", report.segment_points}, {"facet_points", report.facet_points}}},
      {"steiner",
       {{"count", report.steiner_points},
        {"forced", report.forced_points},
        {"unrounded", report.unrounded_points}}},
      {"field_points", report.field.points},
      {"field", to_json(report.field)},
      {"bounds",
       {{"points", report.bounds.points},
        {"fullest", report.bounds.fullest},
        {"flat", report.bounds.flat},
        {"ratio_points", report.bounds.ratio_points},
        {"worst_ratio", report.bounds.worst_ratio},
        {"above_ratio", report.bounds.above_ratio}}},
      {"layers",
       {{"points", report.layers.points},
        {"left", report.layers.left},
        {"places", report.layers.places},
        {"at_rims", report.layers.at_rims}}},
      {"optimise",
       {{"exchanges", report.optimised.exchanges},
        {"moves", report.optimised.moves},
        {"points", report.optimised.points}}},
      {"mesh",
       {{"vertices", report.vertices}, {"tetrahedra", report.tetrahedra}, {"regions", report.regions}}},
      {"names", to_json(result.volume.names)},
      {"marker_sets", std::move(sets)},
      {"quality",
       {{"target", report.elements.target},
        {"worst", report.elements.worst},
        {"min_dihedral_deg", report.elements.min_dihedral_deg},
        {"max_dihedral_deg", report.elements.max_dihedral_deg},
        {"below_10_deg", report.elements.below_10_deg},
        {"histogram", report.elements.histogram},
        {"below", condition.below},
        {"volume_below", condition.volume_below},
        {"element_eigenvalue", condition.element_eigenvalue},
        {"stiffness_bound", condition.stiffness_bound}}},
      {"seconds", report.seconds},
      {"peak_memory_bytes", report.peak_memory_bytes},
      {"version", version()},
      {"options", std::move(options)},
      {"outcome", name(result.outcome)},
      {"attempts", report.attempts},
      {"keep", {{"rule", name(report.keep)}, {"turned_facets", report.turned_facets}}},
      {"message", result.message},
      {"warnings", to_json(result.warnings)},
      {"defects", to_json(result.defects)},
      {"vertex_map", result.vertex_map},
  };
}

Json to_json(const UntangleResult& result, Json options) {
  const UntangleReport& report = result.report;
  return {{"input",
           {{"vertices", report.vertices},
            {"free_vertices", report.free_vertices},
            {"tetrahedra", report.tetrahedra},
            {"turned", report.turned},
            {"negative", report.negative},
            {"null", report.null}}},
          {"left", {{"negative", report.negative_after}, {"null", report.null_after}}},
          {"moved", report.moved},
          {"swapped", report.swapped},
          {"cavities", report.cavities},
          {"added", report.added},
          {"removed", report.removed},
          {"rounds", report.rounds},
          {"improved",
           {{"moves", report.improved.moves},
            {"swaps", report.improved.swaps},
            {"contractions", report.improved.contractions},
            {"insertions", report.improved.insertions},
            {"before", to_json(report.improved.before)},
            {"after", to_json(report.improved.after)}}},
          {"mesh",
           {{"vertices", result.volume.vertices.size()}, {"tetrahedra", result.volume.tetrahedra.size()}}},
          {"seconds", report.seconds},
          {"peak_memory_bytes", report.peak_memory_bytes},
          {"version", version()},
          {"options", std::move(options)},
          {"outcome", name(result.outcome)},
          {"message", result.message},
          {"defects", to_json(result.defects)}};
}

Json to_json(const CheckResult& result) {
  Json rules = Json::array();
  for (const Rule& rule : result.rules)
    rules.push_back({{"name", rule.name}, {"holds", rule.holds}, {"detail", rule.detail}});
  return {{"holds", result.holds()}, {"rules", rules}, {"version", version()}};
}

std::string text_of(const Json& json, int indent) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace holdfast::reports
