// The report of pasting.
#include "holdfast/paste.h"

#include "holdfast/names.h"
#include "reports.h"

namespace holdfast::reports {

Json parts_of(const PasteResult& pasted) {
  Json parts = Json::array();
  for (const PastedPart& part : pasted.parts)
    parts.push_back({{"file", part.name},
                     {"region", part.id},
                     {"first_vertex", part.first_vertex},
                     {"first_facet", part.first_facet}});
  return parts;
}

Json to_json(const PasteResult& result, Json options) {
  Json json = to_json(static_cast<const RepairResult&>(result), std::move(options));
  json["parts"] = parts_of(result);
  json["shared_facets"] = result.shared_facets;
  json["overlaps"] = Json::array();
  for (const PartOverlap& overlap : result.overlaps)
    json["overlaps"].push_back({{"parts", {overlap.first, overlap.second}},
                                {"depth", overlap.depth},
                                {"thickness", overlap.thickness},
                                {"where", overlap.where}});
  json["apart"] = Json::array();
  for (const PartApart& apart : result.apart)
    json["apart"].push_back(
        {{"parts", {apart.part, apart.nearest}}, {"distance", apart.distance}, {"where", apart.where}});
  return json;
}

Json to_json(const PastedVolumes& result, Json options) {
  Json json = to_json(result.boundary, std::move(options));
  json["tetrahedra"] = {{"count", result.volume.tetrahedra.size()}, {"replaced", result.replaced}};
  json["outcome"] = name(result.outcome);
  json["message"] = result.message;
  return json;
}

}  // namespace holdfast::reports
