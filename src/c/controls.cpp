#include "c/controls.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "c/guard.h"
#include "c/handles.h"

namespace holdfast::c {
namespace {

/// A structure of the caller's, of which an older header knows the first members only.
template <class Struct>
Struct known_part(const Struct* given, void (*init)(Struct*)) {
  Struct whole;
  init(&whole);
  if (given == nullptr) return whole;
  if (given->struct_size < sizeof(std::size_t) || given->struct_size > sizeof(Struct))
    throw std::invalid_argument("a structure was not set up by its _init function, or is of a newer version");
  std::memcpy(&whole, given, given->struct_size);
  whole.struct_size = sizeof(Struct);
  return whole;
}

Sizes to_sizes(const holdfast_mesh_options& given, std::size_t vertices) {
  Sizes sizes;
  sizes.size = given.size;
  if (!(given.gradation < 0)) sizes.gradation = given.gradation;
  sizes.grow = given.no_growth == 0;
  if (given.vertex_sizes != nullptr)
    sizes.vertex_sizes.assign(given.vertex_sizes, given.vertex_sizes + vertices);
  if (given.size_field != nullptr)
    sizes.fields = [field = given.size_field, context = given.size_field_context](
                       std::span<const Point> points, std::span<double> found) {
      if (!points.empty()) field(context, points.size(), points.front().data(), found.data());
    };
  return sizes;
}

}  // namespace

holdfast_control known(const holdfast_control* control) { return known_part(control, holdfast_control_init); }

Limits limits_of(const holdfast_control& control) {
  Limits limits;
  limits.time_limit = control.time_limit;
  limits.memory_limit = control.memory_limit;
  if (control.cancel != nullptr) limits.cancel = control.cancel->token;
  return limits;
}

ProgressFunction progress_of(const holdfast_control& control) {
  if (control.progress == nullptr) return {};
  return [tell = control.progress, context = control.progress_context](double fraction) {
    return tell(context, "", fraction) != 0;
  };
}

Options to_options(const holdfast_mesh_options* options, const holdfast_control& control,
                   std::size_t vertices) {
  const holdfast_mesh_options given = known_part(options, holdfast_mesh_options_init);
  if (given.keep < HOLDFAST_KEEP_AUTO || given.keep > HOLDFAST_KEEP_BOX)
    throw std::invalid_argument("there is no such rule of regions to keep");
  if (given.effort < HOLDFAST_FAST || given.effort > HOLDFAST_BEST)
    throw std::invalid_argument("there is no such effort");
  if (given.hole_count > 0) require(given.holes, "holes are counted, but there are none");
  if (given.region_count > 0) require(given.regions, "regions are counted, but there are none");
  Options result;
  static_cast<Limits&>(result) = limits_of(control);
  result.threads = control.threads;
  if (control.progress != nullptr)
    result.progress = [tell = control.progress,
                       context = control.progress_context](const Progress& progress) {
      return tell(context, name(progress.stage), progress.overall) != 0;
    };
  if (given.field_points != 0) result.sizes = to_sizes(given, vertices);
  result.effort = static_cast<Effort>(given.effort);
  result.keep = static_cast<Keep>(given.keep);
  result.box_margin = given.box_margin;
  for (std::size_t i = 0; i < given.hole_count; ++i)
    result.holes.push_back({given.holes[3 * i], given.holes[3 * i + 1], given.holes[3 * i + 2]});
  for (std::size_t i = 0; i < given.region_count; ++i) {
    const holdfast_region_seed& seed = given.regions[i];
    result.regions.push_back({{seed.where[0], seed.where[1], seed.where[2]}, seed.id, seed.size});
  }
  result.drop_outside = given.drop_outside != 0;
  result.neighbours = given.neighbours != 0;
  result.seed = given.seed;
  return result;
}

}  // namespace holdfast::c

static_assert(static_cast<int>(holdfast::Keep::automatic) == HOLDFAST_KEEP_AUTO &&
              static_cast<int>(holdfast::Keep::box) == HOLDFAST_KEEP_BOX);
static_assert(static_cast<int>(holdfast::Effort::fast) == HOLDFAST_FAST &&
              static_cast<int>(holdfast::Effort::best) == HOLDFAST_BEST);

void holdfast_control_init(holdfast_control* control) {
  *control = {};
  control->struct_size = sizeof *control;
  control->threads = 1;
}

void holdfast_mesh_options_init(holdfast_mesh_options* options) {
  *options = {};
  options->struct_size = sizeof *options;
  options->gradation = -1;
  options->effort = HOLDFAST_GOOD;
  options->box_margin = holdfast::Options{}.box_margin;
  options->seed = 1;
}
