#include "paste_result.h"

#include <fmt/core.h>

#include "command.h"
#include "summary.h"

namespace holdfast::cli {

Json parts_of(const PasteResult& pasted) {
  Json parts = Json::array();
  for (const PastedPart& part : pasted.parts)
    parts.push_back({{"file", part.name},
                     {"region", part.id},
                     {"first_vertex", part.first_vertex},
                     {"first_facet", part.first_facet}});
  return parts;
}

Json report_of(const PasteResult& result, Json options) {
  Json json = to_json(static_cast<const RepairResult&>(result), std::move(options));
  json["parts"] = parts_of(result);
  json["shared_facets"] = result.shared_facets;
  json["overlaps"] = Json::array();
  for (const PartOverlap& overlap : result.overlaps)
    json["overlaps"].push_back(
        {{"parts", {overlap.first, overlap.second}}, {"depth", overlap.depth}, {"where", overlap.where}});
  json["apart"] = Json::array();
  for (const PartApart& apart : result.apart)
    json["apart"].push_back(
        {{"parts", {apart.part, apart.nearest}}, {"distance", apart.distance}, {"where", apart.where}});
  return json;
}

void tell(const PasteResult& result, const std::filesystem::path& output) {
  for (const PartApart& apart : result.apart)
    say("holdfast: {} and {} do not touch: they are {:.6g} apart\n", result.parts[apart.part].name,
        result.parts[apart.nearest].name, apart.distance);
  say("{}: {}, {} ({} of several files, {} cut or joined), {} moved; at most {:.3g} from the input, {:.2f} "
      "s\n",
      output.string(), counted(result.surface.vertices.size(), "vertex", "vertices"),
      counted(result.surface.facets.size(), "triangle"), result.shared_facets, result.report.changed_facets,
      result.moved.size(), result.max_displacement, result.report.seconds.at("total"));
}

}  // namespace holdfast::cli
