// Check: the rules of the promise (design §1) on one mesh, from nothing but the public arrays.
#include "holdfast/check.h"

#include "check/examination.h"
#include "numbers/float_environment.h"

namespace holdfast {

CheckResult check(const Complex& surface, const Volume& volume, const CheckOptions& options) {
  const FloatEnvironment environment;
  namespace rules = checking;
  rules::Examination on{surface, volume, options, rules::input_of(surface)};
  // The order of these calls is the order in which rules establish facts for later ones.
  Rule vertices = rules::vertices_kept(on);
  Rule form = rules::well_formed(on);
  Rule positive = rules::positive_volumes(on);
  rules::find_input_faces(on);
  Rule matched = rules::faces_matched(on);
  Rule overlap = rules::no_overlap(on);
  rules::find_fates(on);
  return {{std::move(vertices), std::move(form), rules::no_vertex_unused(on), std::move(positive),
           rules::facets_kept(on), rules::segments_kept(on), std::move(matched), rules::boundary_is_input(on),
           std::move(overlap), rules::steiner_points_inside(on), rules::regions_numbered(on),
           rules::markers_kept(on), rules::nothing_dropped(on)}};
}

}  // namespace holdfast
