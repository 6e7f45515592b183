#include "check/examine.h"

#include "check/examination.h"

namespace holdfast::checking {

CheckResult examine(const Complex& surface, const Volume& volume, const CheckOptions& options,
                    const std::function<void(double)>& step) {
  Pulse pulse(step);
  Examination on{surface, volume, options, input_of(surface, pulse), pulse};
  // The calls are in the order in which rules establish facts for later ones. Shares are the measured times
  // of the steps on large meshes.
  pulse.reach(0.05);
  Rule vertices = vertices_kept(on);
  Rule form = well_formed(on);
  pulse.reach(0.1);
  Rule positive = positive_volumes(on);
  pulse.reach(0.2);
  find_input_faces(on);
  pulse.reach(0.5);
  Rule matched = faces_matched(on);
  Rule overlap = no_overlap(on);
  pulse.reach(0.75);
  find_fates(on);
  Rule unused = no_vertex_unused(on);
  Rule facets = facets_kept(on);
  Rule segments = segments_kept(on);
  Rule boundary = boundary_is_input(on);
  pulse.reach(0.8);
  Rule inside = steiner_points_inside(on);
  pulse.reach(0.9);
  Rule regions = regions_numbered(on);
  Rule markers = markers_kept(on);
  CheckResult result{{std::move(vertices), std::move(form), std::move(unused), std::move(positive),
                      std::move(facets), std::move(segments), std::move(matched), std::move(boundary),
                      std::move(overlap), std::move(inside), std::move(regions), std::move(markers),
                      nothing_dropped(on)}};
  if (!volume.mid_nodes.empty())
    for (Rule& rule : second_order(on)) result.rules.push_back(std::move(rule));
  return result;
}

}  // namespace holdfast::checking
