#include "api/interior.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "api/report.h"
#include "api/scale.h"
#include "mesh/shape_counts.h"
#include "optimise/improve_parts.h"
#include "optimise/optimise.h"
#include "optimise/shape.h"
#include "refine/bound_volumes.h"
#include "refine/field_points.h"
#include "refine/layers.h"
#include "refine/limited_sizes.h"

namespace holdfast {
namespace {

bool is_explicit(const TetMesh& mesh, const std::vector<Tet>& tets) {
  return mesh.exact_vertex_count() == 0 || std::all_of(tets.begin(), tets.end(), [&](Tet t) {
           const TetMesh::Corners& v = mesh.corners(t);
           return std::all_of(v.begin(), v.end(), [&](Vertex x) { return mesh.is_explicit(x); });
         });
}

void optimise_worst_of(const Attempt& attempt, BoxMesh& box, Division& division, const std::vector<Tet>& tets,
                       PointsToRemove remove, Report& report) {
  const OptimiseStats stats =
      optimise(box.mesh, tets, box.first_free, attempt.input.target(), attempt.threads, attempt.monitor,
               {.add_points = attempt.options.add_points,
                .remove = remove,
                .seed = attempt.seed,
                .fill_anew = attempt.fill_anew});
  report.optimised = {stats.exchanged + stats.unflattened + stats.reconnected + stats.filled_anew,
                      stats.relocated, stats.inserted};
  if (stats.changed > 0)
    find_regions_again(box.mesh, attempt.complex().facets, division.regions, attempt.threads);
}

void note(const ImproveStats& stats, Report::Field& report) {
  report.moves += stats.moved;
  report.swaps += stats.swapped;
  report.contractions += stats.contracted;
  report.insertions += stats.inserted;
  report.points += stats.filled_in;
  report.stopped_early |= stats.filling_stopped_early;
}

// The share of the stage's work that every effort does.
constexpr double kCommonWork = 0.6;
constexpr std::array<double, 2> kNoProgress{kCommonWork, kCommonWork};

// If facets force most bad elements, more elements hardly help; other meshers use about as many as the volume
// takes without field points. Points are removed until kTimesThoseWithout times that many elements are left,
// or nearly as many as the user's sizes ask for. Points that pay are added again, up to that number.
constexpr double kTimesThoseWithout = 1.25;
double many_of(const WithoutField& without) {
  return kTimesThoseWithout * static_cast<double>(without.elements());
}
double elements_left_of(const WithoutField& without) {
  return std::max(many_of(without), without.elements_to_be_left());
}
bool asks_for_most(const WithoutField& without) { return without.elements_asked_for() >= many_of(without); }

// If the user limits sizes, a removed element may cost more, and the elements may grow only to so many times
// those that removal leaves even where the mesh falls behind the one without field points.
constexpr double kMostCostWhereLimited = 0.2, kMostTimesThoseLeft = 1.15;
// Points are removed in a mesh without a comparison, too, if a larger share of the elements is bad. Smooth
// surfaces have 0.012 at most.
constexpr double kManyBadWhereLimited = 0.03;

double growth_to(double most, double elements) { return std::max(0.0, most / elements - 1); }

double elements_of(const Report::Shape& shape) {
  return static_cast<double>(std::accumulate(shape.quality.begin(), shape.quality.end(), std::size_t{0}));
}

// The pass is brief if work may continue when it falls behind the mesh without field points. If the user's
// sizes ask for more elements than that mesh has, and no more were made, there is nothing to compare.
Extent extent_of_fast(const Attempt& attempt, Field& field, double elements) {
  Extent extent = Effort::fast;
  if (!field.without || field.without->elements() == 0) return extent;
  const WithoutField& without = *field.without;
  const Sizes& asked = *attempt.options.sizes;
  const bool may_remove = asked.grow && !asked.gradation;
  const bool are_too_many = may_remove && elements > without.elements_asked_for();
  extent.is_brief = without.is_given() && (are_too_many || !asks_for_most(without));
  const double left = elements_left_of(without);
  if (may_remove && (extent.is_brief || without.elements_to_be_left() < without.elements_asked_for())) {
    extent.least_part = left / elements;
    extent.part_of_bad = kManyBadWhereLimited;
  }
  if (field.is_limited()) {
    extent.most_cost = kMostCostWhereLimited;
    if (extent.is_brief) extent.most_growth = growth_to(kMostTimesThoseLeft * left, elements);
  }
  if (!extent.is_brief) field.without.reset();
  return extent;
}

// The first pass of every effort.
ImproveStats improve_as_fast(const Attempt& attempt, Field& field, Report::Field& report) {
  const Threads& threads = attempt.threads;
  report.before =
      describe_shape(field.parts ? shape_of(*field.parts, threads) : shape_of(field.volume(), threads));
  const Extent extent = extent_of_fast(attempt, field, elements_of(report.before));
  std::optional<FilledParts> filled;
  if (field.parts) filled.emplace(FilledParts{std::move(field.parts), field.size_function()});
  const ImproveStats stats =
      improve_in_parts(field.volume(), std::move(filled), extent, threads, attempt.monitor);
  note(stats, report);
  return stats;
}

// Long thin facets may leave flat elements, for which the optimisation without field points is made.
void improve_flat(const Attempt& attempt, BoxMesh& box, Division& division, Report& report) {
  std::vector<Tet> flat = division.tets(box.mesh);
  std::erase_if(flat, [&](Tet t) {
    attempt.monitor.poll(Stage::optimise, kCommonWork);
    const TetMesh& mesh = box.mesh;
    const auto& v = mesh.corners(t);
    return !is_flat(mesh.position(v[0]), mesh.position(v[1]), mesh.position(v[2]), mesh.position(v[3]));
  });
  if (!flat.empty()) optimise_worst_of(attempt, box, division, flat, PointsToRemove::added_here, report);
}

// A mesh after field points and the common work.
struct Begun {
  bool was_brief;                  // and a brief pass was enough
  std::optional<Figures> figures;  // if they are known
};

// A brief pass was too little. At first the complete one may add only so many points: without a limit it
// makes up to twice as many elements, where few points do as well. Then points that pay follow; if these
// close the gap, there is no need for more than after a brief pass.
std::optional<Begun> begin_with_few_points(const Attempt& attempt, Field& field, Figures& now,
                                           Report::Field& report) {
  constexpr double kTimesThoseLeft = 1.08, kFurtherGrowth = 0.04;
  const auto is_behind = [&] {
    now = figures_of(field.volume(), attempt.threads);
    return field.without->is_better_somewhere(now);
  };
  Extent few = Effort::fast;
  few.most_growth =
      growth_to(kTimesThoseLeft * elements_left_of(*field.without), static_cast<double>(now.elements()));
  note(improve_in_parts(field.volume(), {}, few, attempt.threads, attempt.monitor), report);
  if (!is_behind()) return Begun{false, now};
  if (!field.without->is_within_reach(now)) return std::nullopt;
  Extent further = Effort::good;
  further.lowers_shares = true;
  further.most_growth = kFurtherGrowth;
  note(improve_further_in_parts(field.volume(), further, now, kNoProgress, attempt.threads, attempt.monitor),
       report);
  if (is_behind()) return std::nullopt;
  return Begun{true, now};
}

// Field points must not make any figure worse than it is without them. A brief pass is completed first. If
// the gap is small, more work may close it; otherwise the mesh without field points is taken, and gets only
// points that improve their surroundings.
Begun keep_what_pays(const Attempt& attempt, BoxMesh& box, Division& division, Field& field, bool was_brief,
                     Report& report) {
  WithoutField& without = *field.without;
  if (!without.is_given()) return {was_brief, std::nullopt};
  Figures now = figures_of(field.volume(), attempt.threads);
  if (!without.is_better_somewhere(now)) return {was_brief, now};
  if (was_brief) {
    if (const std::optional<Begun> begun = begin_with_few_points(attempt, field, now, report.field))
      return *begun;
    Extent complete = Effort::fast;
    if (field.is_limited())
      complete.most_growth =
          growth_to(kMostTimesThoseLeft * elements_left_of(without), static_cast<double>(now.elements()));
    note(improve_in_parts(field.volume(), {}, complete, attempt.threads, attempt.monitor), report.field);
    now = figures_of(field.volume(), attempt.threads);
    if (!without.is_better_somewhere(now)) return {false, now};
  }
  if (without.is_within_reach(now)) {
    note(improve_further_in_parts(field.volume(), Effort::good, now, kNoProgress, attempt.threads,
                                  attempt.monitor),
         report.field);
    now = figures_of(field.volume(), attempt.threads);
    if (!without.is_better_somewhere(now)) return {false, now};
  }
  if (field.is_limited()) return {false, now};  // its edges would exceed the user's limit
  without.take(box, division);
  field.set_sizes(attempt);
  report.field.points = 0;
  note(improve_further_in_parts(field.volume(), Effort::fast, std::nullopt, kNoProgress, attempt.threads,
                                attempt.monitor),
       report.field);
  return {false, std::nullopt};
}

// If facets force many of the bad elements, only the shares of elements with small angles can be improved.
Extent extent_of_good(Field& field, Begun& begun, const Threads& threads) {
  constexpr double kManySmall = 0.3;
  Extent extent = Effort::good;
  if (!field.without || !field.without->is_given()) return extent;
  if (!begun.figures) begun.figures = figures_of(field.volume(), threads);
  const auto elements = static_cast<double>(begun.figures->elements());
  const auto below_30_deg = static_cast<double>(begun.figures->below_30_deg());
  extent.lowers_shares = begun.was_brief || below_30_deg > kManySmall * elements;
  if (begun.was_brief || field.is_limited())
    extent.most_growth = growth_to(elements_left_of(*field.without), elements);
  return extent;
}

// More effort starts from the result of less effort and makes no figure worse, so less effort never gives a
// better mesh.
void improve_with_field(const Attempt& attempt, BoxMesh& box, Division& division, Field& field,
                        Report& report) {
  const Threads& threads = attempt.threads;
  const ImproveStats common = improve_as_fast(attempt, field, report.field);
  // Flatness is measured in space; in a metric, flat elements may be right.
  if (common.worst > kEnergyOfFlat && !field.has_metric()) {
    improve_flat(attempt, box, division, report);
    field.give_sizes_to_new_vertices();
  }
  Begun begun{common.was_brief, std::nullopt};
  if (field.without) {
    begun = keep_what_pays(attempt, box, division, field, begun.was_brief, report);
    field.worst_without = field.without->worst_quality();
  }
  Extent extent = extent_of_good(field, begun, threads);
  if (common.was_thinned) extent.most_growth = 0;
  field.without.reset();
  const Effort effort = attempt.options.effort;
  constexpr double kUpToGood = 0.75;  // share of progress
  if (effort != Effort::fast)
    note(improve_further_in_parts(field.volume(), extent, begun.figures,
                                  {kCommonWork, effort == Effort::good ? 1 : kUpToGood}, threads,
                                  attempt.monitor),
         report.field);
  if (effort == Effort::best)
    note(improve_further_in_parts(field.volume(), Effort::best, std::nullopt, {kUpToGood, 1}, threads,
                                  attempt.monitor),
         report.field);
  report.field.edge_lengths = edge_lengths_of(field.volume(), threads);
}

// Each region has its own levels, which improvement preserves.
void keep_layers(const Attempt& attempt, const VolumeData& volume, bool improves, Report::Layers& report) {
  const unsigned layers = attempt.options.sizes->layers;
  if (layers < 2) return;
  std::vector<std::vector<Tet>> tets_of(volume.kept.size());
  for (Tet t = 0; t < volume.mesh.slot_count(); ++t)
    if (volume.is_inside(t)) tets_of[volume.region_of[t]].push_back(t);
  Levels levels;
  for (RegionId region = 0; region < tets_of.size(); ++region) {
    if (tets_of[region].empty()) continue;
    const std::vector<std::uint8_t> fresh(volume.mesh.vertex_count(), 0);
    const LayerStats made = make_layers(volume, tets_of[region], layers, levels, attempt.monitor);
    report.points += made.points;
    report.left += made.left;
    report.at_rims += made.at_rims;
    report.places.insert(report.places.end(), made.places.begin(), made.places.end());
    if (!improves || made.points == 0) continue;
    std::vector<bool> alone(volume.kept.size(), false);
    alone[region] = true;
    const VolumeData own{volume.mesh,         volume.region_of,  volume.sizes,   alone,
                         volume.first_free,   nullptr,           volume.metrics, volume.seed,
                         volume.most_volumes, volume.most_sizes, &levels};
    improve(own, attempt.options.effort, attempt.monitor, {}, fresh);
  }
}

// Points for ratios make angles smaller. Improvement ignores ratios but only makes angles larger, so it keeps
// nearly all of these points. It respects bounds on volumes, so a second pass finds next to nothing to do; a
// last pass without improvement makes the bounds exact.
void bound(const Attempt& attempt, const VolumeData& volume, bool improves, Report::Bounds& report) {
  const std::vector<std::uint8_t> fresh(volume.mesh.vertex_count(), 0);
  const double most_ratio = attempt.options.sizes->max_ratio;
  if (most_ratio > 0) report.ratio_points += lower_ratios(volume, most_ratio, attempt.monitor).points;
  report.points += bound_volumes(volume, attempt.monitor).points;
  if (!improves || volume.mesh.vertex_count() == fresh.size()) return;
  improve(volume, attempt.options.effort, attempt.monitor, {}, fresh);
  report.points += bound_volumes(volume, attempt.monitor).points;
}

// Layers come last: points for bounds could join what levels separate, and splitting edges breaks no bound.
void keep_bounds(const Attempt& attempt, Field& field, bool improves, Report& report) {
  field.give_sizes_to_new_vertices();  // points added against flat elements have none
  bound(attempt, field.volume(), improves, report.bounds);
  keep_layers(attempt, field.volume(), improves, report.layers);
}

void note_limited_sizes(const Attempt& attempt, Field& field, int scale, Report::Field& report) {
  constexpr std::size_t kMostTold = 100;
  const LimitedSizes limited = limited_sizes(field.volume(), field.size_function(), attempt.threads);
  report.limited_volume = limited.volume;
  report.limited_asked_volume = limited.asked_volume;
  report.limiting.clear();
  for (const LimitedSizes::AtFacet& f : limited.facets) {
    if (report.limiting.size() == kMostTold) break;
    report.limiting.push_back({f.facet, std::ldexp(f.wanted, -scale), std::ldexp(f.bearable, -scale),
                               f.volume, scaled(f.place, -scale)});
  }
}

}  // namespace

std::unique_ptr<Field> add_field_points(const Attempt& attempt, BoxMesh& box, Division& division,
                                        Report& all) {
  Report::Field& report = all.field;
  if (box.mesh.exact_vertex_count() > 0 && !is_explicit(box.mesh, division.tets(box.mesh))) return nullptr;
  auto field = std::make_unique<Field>(attempt, box, division);
  const SizeFunction& sizes = field->size_function();
  require_few_enough(field->volume(), sizes);
  const std::size_t before = box.mesh.vertex_count();
  report.stopped_early = add_enough_points(attempt, box, division, *field, report);
  report.gradation = sizes.gradation();
  const bool improves = attempt.options.optimise && attempt.last_stage() == Stage::optimise;
  if (!improves)
    report.stopped_early |= join_filled(std::move(field->parts), sizes, attempt.threads, attempt.monitor);
  report.points = box.mesh.vertex_count() - before + (field->parts ? field->parts->new_vertices() : 0);
  if (!improves) {
    keep_bounds(attempt, *field, false, all);
    note_limited_sizes(attempt, *field, box.scale, report);
  }
  return field;
}

void improve_elements(const Attempt& attempt, BoxMesh& box, Division& division, Field* field,
                      Report& report) {
  if (!attempt.options.optimise) return;
  if (field == nullptr) {
    const std::vector<Tet> tets = division.tets(box.mesh);
    if (is_explicit(box.mesh, tets))
      optimise_worst_of(attempt, box, division, tets, PointsToRemove::all, report);
    return;
  }
  improve_with_field(attempt, box, division, *field, report);
  keep_bounds(attempt, *field, true, report);
  note_limited_sizes(attempt, *field, box.scale, report.field);
}

}  // namespace holdfast
