// The C interface: meshing, defects, check, untangling.
#include <utility>

#include "c/controls.h"
#include "c/guard.h"
#include "c/handles.h"
#include "holdfast/check.h"
#include "holdfast/names.h"
#include "holdfast/untangle.h"

using holdfast::c::fail;
using holdfast::c::guarded;
using holdfast::c::require;
using holdfast::c::status_of;

const char* holdfast_version(void) { return holdfast::version(); }

const char* holdfast_status_name(holdfast_status status) {
  switch (status) {
    case HOLDFAST_OK:
      return "ok";
    case HOLDFAST_INVALID_INPUT:
      return "invalid_input";
    case HOLDFAST_TIME_LIMIT:
      return "time_limit";
    case HOLDFAST_MEMORY_LIMIT:
      return "memory_limit";
    case HOLDFAST_CANCELLED:
      return "cancelled";
    case HOLDFAST_NOT_REPRESENTABLE:
      return "not_representable";
    case HOLDFAST_BAD_ARGUMENT:
      return "bad_argument";
    case HOLDFAST_FILE_ERROR:
      return "file_error";
    case HOLDFAST_OUT_OF_MEMORY:
      return "out_of_memory";
    case HOLDFAST_TOO_LARGE:
      return "too_large";
    case HOLDFAST_INTERNAL_ERROR:
      return "internal_error";
  }
  return "unknown";
}

holdfast_status holdfast_mesh(const holdfast_surface* surface, const holdfast_mesh_options* options,
                              const holdfast_control* control, holdfast_result** out, holdfast_error* error) {
  return guarded(error, [&] {
    require(out, "there is no place for the result");
    *out = nullptr;
    require(surface, "there is no surface");
    const holdfast::Complex complex = surface->view();
    auto result = std::make_unique<holdfast_result>();
    result->rest = holdfast::mesh(
        complex, holdfast::c::to_options(options, holdfast::c::known(control), complex.vertices.size()));
    const holdfast::Outcome outcome = result->rest.outcome;
    if (outcome == holdfast::Outcome::done || outcome == holdfast::Outcome::not_representable)
      result->volume.reset(new holdfast_volume(std::move(result->rest.volume)));
    result->defects.list = std::move(result->rest.defects);
    *out = result.release();
    return fail(error, status_of(outcome), (*out)->rest.message);
  });
}

holdfast_volume* holdfast_result_volume(const holdfast_result* result) { return result->volume.get(); }

const uint32_t* holdfast_result_neighbours(const holdfast_result* result, size_t* rows) {
  const auto& neighbours = result->rest.neighbours;
  if (rows != nullptr) *rows = neighbours.size();
  return neighbours.empty() ? nullptr : neighbours.front().data();
}

unsigned holdfast_result_triangle_regions(const holdfast_result* result, size_t triangle, int* front,
                                          int* behind) {
  const auto& regions = result->rest.facet_regions;
  if (triangle >= regions.size()) return 0;
  unsigned there = 0;
  int* const ids[] = {front, behind};
  for (std::size_t side = 0; side < 2; ++side)
    if (const std::optional<int>& id = regions[triangle][side]) {
      there |= 1U << side;
      if (ids[side] != nullptr) *ids[side] = *id;
    }
  return there;
}

size_t holdfast_result_steiner_points(const holdfast_result* result) {
  return result->rest.report.steiner_points;
}

double holdfast_result_seconds(const holdfast_result* result) {
  const auto& seconds = result->rest.report.seconds;
  const auto total = seconds.find("total");
  return total == seconds.end() ? 0 : total->second;
}

size_t holdfast_result_warning_count(const holdfast_result* result) { return result->rest.warnings.size(); }

const char* holdfast_result_warning(const holdfast_result* result, size_t i) {
  return i < result->rest.warnings.size() ? result->rest.warnings[i].message.c_str() : nullptr;
}

void holdfast_result_free(holdfast_result* result) { delete result; }

holdfast_status holdfast_diagnose(const holdfast_surface* surface, size_t most,
                                  const holdfast_control* control, holdfast_defects** out,
                                  holdfast_error* error) {
  return guarded(error, [&] {
    require(out, "there is no place for the defects");
    *out = nullptr;
    require(surface, "there is no surface");
    const holdfast_control known = holdfast::c::known(control);
    holdfast::DiagnoseOptions options;
    static_cast<holdfast::Limits&>(options) = holdfast::c::limits_of(known);
    options.progress = holdfast::c::progress_of(known);
    options.threads = known.threads;
    options.most = most;
    auto defects = std::make_unique<holdfast_defects>();
    defects->list = holdfast::diagnose(surface->view(), options);
    *out = defects.release();
    return HOLDFAST_OK;
  });
}

const holdfast_defects* holdfast_result_defects(const holdfast_result* result) { return &result->defects; }

size_t holdfast_defects_count(const holdfast_defects* defects) { return defects->list.size(); }

int holdfast_defects_get(const holdfast_defects* defects, size_t i, holdfast_defect* defect) {
  if (i >= defects->list.size()) return 0;
  const holdfast::Defect& from = defects->list[i];
  *defect = {static_cast<int>(from.kind),
             holdfast::name(from.kind),
             from.message.c_str(),
             from.vertices.data(),
             from.vertices.size(),
             from.facets.data(),
             from.facets.size(),
             from.segments.data(),
             from.segments.size(),
             from.where.empty() ? nullptr : from.where.front().data(),
             from.where.size()};
  return 1;
}

void holdfast_defects_free(holdfast_defects* defects) { delete defects; }

holdfast_status holdfast_check(const holdfast_surface* surface, const holdfast_volume* volume,
                               const holdfast_control* control, int* holds, holdfast_error* error) {
  return guarded(error, [&] {
    require(holds, "there is no place for the answer");
    *holds = 0;
    require(surface, "there is no surface");
    require(volume, "there is no volume");
    const holdfast_control known = holdfast::c::known(control);
    holdfast::CheckOptions options;
    static_cast<holdfast::Limits&>(options) = holdfast::c::limits_of(known);
    options.progress = holdfast::c::progress_of(known);
    const holdfast::CheckResult result = holdfast::check(surface->view(), volume->mesh, options);
    *holds = result.holds() ? 1 : 0;
    for (const holdfast::Rule& rule : result.rules)
      if (!rule.holds) return fail(error, HOLDFAST_OK, rule.name + ": " + rule.detail);
    return HOLDFAST_OK;
  });
}

holdfast_status holdfast_untangle(const holdfast_volume* volume, const holdfast_control* control,
                                  holdfast_volume** out, holdfast_error* error) {
  return guarded(error, [&] {
    require(out, "there is no place for the volume");
    *out = nullptr;
    require(volume, "there is no volume");
    const holdfast_control known = holdfast::c::known(control);
    holdfast::UntangleOptions options;
    static_cast<holdfast::Limits&>(options) = holdfast::c::limits_of(known);
    if (known.progress != nullptr)
      options.progress = [&known](const holdfast::UntangleProgress& progress) {
        return known.progress(known.progress_context, name(progress.step), progress.fraction) != 0;
      };
    holdfast::UntangleResult result = holdfast::untangle(volume->mesh, options);
    if (result.outcome == holdfast::Outcome::done) *out = new holdfast_volume(std::move(result.volume));
    return fail(error, status_of(result.outcome), result.message);
  });
}
