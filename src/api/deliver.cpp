#include "api/deliver.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "api/extract.h"
#include "api/forced.h"
#include "api/intermediate.h"
#include "api/report.h"
#include "api/scale.h"
#include "mesh/shape_counts.h"
#include "mesh/target_quality.h"
#include "optimise/shape.h"
#include "surface/describe.h"
#include "text/decimal.h"

namespace holdfast {
namespace {

Warning warn_of_field_points() {
  return {
      WarningKind::field_points,
      {},
      {},
      {},
      "field points stopped early: too many were tried in vain, so that edges may be longer than was asked "
      "for; the sizes differ too much from those of the surface's triangles"};
}

// Warns if a large part of the volume does not get the caller's sizes.
std::optional<Warning> warn_of_sizes(const Report::Field& field) {
  constexpr double kWorthTelling = 0.1;  // share of the volume
  if (field.limited_asked_volume < kWorthTelling || field.limiting.empty()) return std::nullopt;
  const Report::Field::Limiting& most = field.limiting.front();
  return Warning{
      WarningKind::sizes,
      {most.facet},
      {},
      {most.place},
      "on " + decimal(std::round(100 * field.limited_asked_volume)) +
          " % of the volume triangles of the surface are too large, or too thin, for elements of the "
          "size that was asked for: most near triangle " +
          std::to_string(most.facet) + ", where the size is " + decimal(most.bearable, 3) + " in place of " +
          decimal(most.wanted, 3) + ", at " + place(most.place) + "; smaller triangles there would bear it"};
}

// Sets the maps between vertices of the input and of the result.
void number_vertices(const Input& input, Result& result) {
  result.vertex_map = input.vertex_map();
  std::vector<std::int64_t>& of_volume = result.volume.input_vertices;
  of_volume.assign(result.volume.vertices.size(), -1);
  for (Index v = 0; v < input.complex().vertices.size(); ++v) of_volume[v] = input.names()(v);
}

// `volume` is at the mesh's scale: at other scales measures overflow or underflow.
void measure_volume(const Attempt& attempt, const Volume& volume, Field* field, Report& report) {
  report.vertices = volume.vertices.size();
  report.tetrahedra = volume.tetrahedra.size();
  const bool has_all = volume.facets.size() == attempt.complex().facets.size();
  const VolumeShape shape = measure(volume, attempt.threads);
  report.elements =
      describe_elements(shape, has_all ? attempt.input.target()
                                       : target_quality(volume.vertices, volume.facets, attempt.threads));
  if (field == nullptr) return;
  if (attempt.options.optimise && attempt.last_stage() == Stage::optimise)
    report.field.after =
        describe_shape(field->has_metric() ? shape_of(field->volume(), attempt.threads) : shape.elements);
  if (!field->has_metric() && report.elements.below_10_deg > 0)
    find_forced(volume, attempt.complex().vertices.size(), report.field, attempt.threads,
                [&] { attempt.monitor.poll(attempt.monitor.stage(), 1); });
}

}  // namespace

void deliver(const Attempt& attempt, const BoxMesh& box, const Division& division, Field* field,
             Result& result) {
  const Stage last = attempt.last_stage();
  const Source source{box.mesh, attempt.complex(), attempt.input.table(), box.scale, box.first_free};
  Extract extract = last >= Stage::classify
                        ? extract_kept(source, division.regions, division.kept, attempt.threads)
                        : extract_all(source, box.standing);
  result.volume = std::move(extract.volume);
  number_vertices(attempt.input, result);
  result.facet_regions = std::move(extract.facet_regions);
  result.exact_vertices = std::move(extract.exact_vertices);
  if (last < Stage::classify) result.intermediate = intermediate_of(attempt, box, extract.number);

  Report& report = result.report;
  report.steiner_points = extract.steiner_points;
  report.unrounded_points = result.exact_vertices.size();
  const std::vector<bool>& kept = division.kept.region;
  if (last >= Stage::classify)
    report.regions = static_cast<std::size_t>(std::count(kept.begin(), kept.end(), true));
  if (box.scale == 0) {
    measure_volume(attempt, result.volume, field, report);
  } else {
    Volume volume = result.volume;
    volume.vertices = scaled(result.volume.vertices, box.scale);
    measure_volume(attempt, volume, field, report);
  }
  if (std::optional<Warning> warning = warn_of_sizes(report.field))
    result.warnings.push_back(std::move(*warning));
  if (report.field.stopped_early) result.warnings.push_back(warn_of_field_points());
  if (last >= Stage::suppress && !result.exact_vertices.empty()) {
    result.outcome = Outcome::not_representable;
    result.message = "no positive mesh in double precision was found";
  }
}

}  // namespace holdfast
