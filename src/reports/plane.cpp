#include <utility>

#include "holdfast/names.h"
#include "plane_report.h"

namespace holdfast::reports {

std::size_t points_of(const PlaneMesh& mesh) {
  return mesh.in_space.empty() ? mesh.points.size() : mesh.in_space.size();
}

Json to_json(const PlaneResult& result, Json options, bool stopped,
             const std::optional<PlaneRepairReport>& repaired) {
  const PlaneReport& report = result.report;
  Json json = {{"input", {{"points", report.points}, {"segments", report.segments}, {"holes", report.holes}}},
               {"idle_holes", report.idle_holes},
               {"idle_seeds", report.idle_seeds},
               {"missing_segments", report.missing_segments},
               {"swaps", report.swaps},
               {"delaunay_swaps", report.delaunay_swaps},
               {"partition_points", report.partition_points},
               {"most_partition_points", report.most_partition_points},
               {"ears", report.ears},
               {"joined", report.joined},
               {"links", report.links},
               {"field_points", report.field_points},
               {"segment_points", report.segment_points},
               {"small_angles", report.small_angles},
               {"small_angles_left", report.small_angles_left},
               {"large_left", report.large_left},
               {"capped", report.capped},
               {"mesh",
                {{"points", points_of(result.mesh)},
                 {"triangles", report.triangles},
                 {"regions", report.regions},
                 {"least_angle", report.least_angle}}},
               {"seconds", report.seconds},
               {"version", version()},
               {"options", std::move(options)},
               {"outcome", name(result.outcome)},
               {"message", result.message},
               {"defects", to_json(result.defects)}};
  if (repaired)
    json["repair"] = {
        {"cut_segments", repaired->cut_segments}, {"left_out_segments", repaired->left_out_segments},
        {"new_points", repaired->new_points},     {"joined_points", repaired->joined_points},
        {"moved_points", repaired->moved_points}, {"max_displacement", repaired->max_displacement}};
  if (stopped) json["intermediate"] = to_json(result.intermediate);
  return json;
}

}  // namespace holdfast::reports
