// The public functions of holdfast/paste.h: parts are joined, made to fit, and compared.
#include "holdfast/paste.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>
#include <utility>

#include "api/mesh.h"
#include "api/named_parts.h"
#include "api/part_components.h"
#include "api/part_details.h"
#include "api/part_orientation.h"
#include "api/parts_apart.h"
#include "api/repairing.h"
#include "api/turned.h"
#include "check_repair/examine.h"
#include "holdfast/check_repair.h"
#include "holdfast/io.h"
#include "mesh/limit_message.h"
#include "numbers/float_environment.h"
#include "repair/bounds.h"
#include "repair/deliver.h"
#include "repair/fuse.h"
#include "repair/glue.h"
#include "repair/opened.h"
#include "repair/rounding.h"
#include "repair/settle.h"
#include "repair/snap.h"
#include "repair/weld.h"
#include "surface/aabb_tree.h"
#include "text/decimal.h"

namespace holdfast {
namespace {

/// An index out of range in its own part would name a vertex of the next part.
template <class Entity>
void require_vertices(const char* what, const std::vector<Entity>& entities, const Surface& part,
                      std::size_t number) {
  for (std::size_t i = 0; i < entities.size(); ++i)
    for (const Index v : entities[i])
      if (v >= part.vertices.size())
        throw std::invalid_argument(what + (" " + std::to_string(i)) + " of part " +
                                    std::to_string(number + 1) + " names vertex " + std::to_string(v) +
                                    ", of " + std::to_string(part.vertices.size()));
}

void require_sensible(std::span<const Surface> parts, const PasteOptions& options) {
  if (!(options.tolerance >= 0) || !std::isfinite(options.tolerance))
    throw std::invalid_argument("the tolerance for pasting must be finite and not negative");
  if (options.keep == Keep::box)
    throw std::invalid_argument("a part contains what it encloses, so Keep::box cannot apply to it");
  const auto fits = [](const auto& marks, const auto& entities) {
    return marks.empty() || marks.size() == entities.size();
  };
  for (const Surface& part : parts)
    if (!fits(part.facet_markers, part.facets) || !fits(part.segment_markers, part.segments) ||
        !fits(part.vertex_markers, part.vertices))
      throw std::invalid_argument("as many markers as entities are needed, or none");
  for (std::size_t k = 0; k < parts.size(); ++k) {
    require_vertices("triangle", parts[k].facets, parts[k], k);
    require_vertices("segment", parts[k].segments, parts[k], k);
  }
}

double largest_coordinate(const Complex& complex) {
  double most = 0;
  for (const Point& p : complex.vertices)
    for (const double x : p)
      if (std::isfinite(x)) most = std::max(most, std::fabs(x));
  return most;
}

/// The largest gap that rounding of coordinates may leave between touching parts; they are rounded to floats
/// if all of them are floats, in binary or as text.
double rounding_of(const Complex& complex) {
  const auto is_float = [](double x) { return !std::isfinite(x) || is_text_of_float(x); };
  // Vertices inside a volume, of which a part is the surface, are ignored.
  const bool are_floats = std::all_of(complex.facets.begin(), complex.facets.end(), [&](const Triangle& t) {
    return std::all_of(t.begin(), t.end(), [&](Index v) {
      const Point& p = complex.vertices[v];
      return std::all_of(p.begin(), p.end(), is_float);
    });
  });
  constexpr double kDoubles = 0x1p-50, kFloats = 0x1p-21;
  return largest_coordinate(complex) * (are_floats ? kFloats : kDoubles);
}

/// By facet of all parts in order.
std::vector<Index> parts_of_facets(std::span<const Surface> parts) {
  std::vector<Index> part;
  for (Index k = 0; k < parts.size(); ++k) part.insert(part.end(), parts[k].facets.size(), k);
  return part;
}

/// A tolerance of half a part's extent would collapse it.
void require_smaller_than_parts(const Complex& complex, const PasteResult& result, double tolerance) {
  std::vector<Box> boxes(result.parts.size());
  std::vector<std::uint8_t> is_known(boxes.size(), 0);
  for (std::size_t f = 0; f < complex.facets.size(); ++f)
    for (const Index v : complex.facets[f]) {
      if (v >= complex.vertices.size()) continue;
      const Point& p = complex.vertices[v];
      if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2])) continue;
      const Index k = result.part_of_facet[f];
      if (std::exchange(is_known[k], std::uint8_t{1}) == 0) boxes[k] = {p, p};
      boxes[k].extend({p, p});
    }
  for (std::size_t k = 0; k < boxes.size(); ++k) {
    double extent = 0;
    for (std::size_t i = 0; i < 3; ++i) extent = std::max(extent, boxes[k].high[i] - boxes[k].low[i]);
    if (is_known[k] != 0 && !(tolerance < extent / 2))
      throw std::invalid_argument("a tolerance of " + decimal(tolerance) +
                                  " is no less than half the extent of " + result.parts[k].name +
                                  ", which is " + decimal(extent));
  }
}

void compare_with_parents(const Complex& joined, std::span<const Index> part, PasteResult& result) {
  std::set<Index> of;
  for (std::size_t f = 0; f < result.parents.size(); ++f) {
    of.clear();
    for (const Index p : result.parents[f]) {
      of.insert(part[p]);
      result.turned.push_back(
          turned_alike(result.surface.vertices, result.surface.facets[f], joined.vertices, joined.facets[p])
              ? 0
              : 1);
    }
    if (of.size() > 1) ++result.shared_facets;
  }
  orient_folds(joined, part, result);
}

bool is_within(const Complex& joined, double distance, const Step& step, const PasteResult& result) {
  RepairClaims claims = claims_of(result, {});
  claims.max_displacement = distance;
  return checking::is_within_distance(joined, result.surface.view(), claims, step);
}

/// Snapping may move points by the tolerance, and then leading and cutting may again; the sum of these bounds
/// is up to three times the actual distance. A smaller bound is taken if it can be proved for the result. The
/// sum is computed in floating point: if it fails by some last bits, larger bounds are tried.
void prove_distance(const Complex& joined, double tolerance, const Step& step, PasteResult& result) {
  constexpr double kRounding = 1 + 0x1p-20;
  const double claimed = result.max_displacement;
  for (const double times : {1.0, 1.125, 1.25, 1.5, 1.75, 2.0, 2.5}) {
    const double distance = times * tolerance * kRounding;
    if (!(tolerance > 0) || !(distance < claimed)) break;
    if (!is_within(joined, distance, step, result)) continue;
    result.max_displacement = distance;
    return;
  }
  if (is_within(joined, claimed, step, result)) return;
  double distance = std::max(claimed, largest_coordinate(joined) * 0x1p-53);
  constexpr int kDoublings = 6;  // a rounded bound is wrong by last bits only
  for (int k = 0; k < kDoublings; ++k, distance *= 2) {
    if (!is_within(joined, distance, step, result)) continue;
    result.max_displacement = distance;
    return;
  }
}

/// A tolerance above the size of details multiplies the number of facets, and most of them cross.
bool is_hopeless(repairing::State& state, const Step& step, const Threads& threads) {
  const std::size_t most = 1000 + 10 * state.input_vertices;
  return repairing::trouble_of(state, step, threads, most).size() > most;
}

PartsOfComplex parts_of(const PasteResult& pasted) {
  PartsOfComplex parts;
  parts.parts = pasted.parts;
  parts.overlap = pasted.overlap;
  parts.gap = pasted.gap;
  parts.first = pasted.parents.first;
  for (std::size_t k = 0; k < pasted.parents.all.size(); ++k)
    parts.walls.push_back({pasted.part_of_facet[pasted.parents.all[k]], pasted.turned[k] != 0});
  return parts;
}

/// Finds out whether parts overlap, by the regions of a mesh.
void judge(const PasteOptions& options, const std::string& advice, const Step& step, PasteResult& result) {
  Options meshing;
  static_cast<Limits&>(meshing) = options;
  meshing.keep = options.keep;
  meshing.drop_outside = true;
  meshing.stop_after = Stage::classify;
  meshing.threads = options.threads;
  meshing.progress = [&](const Progress& progress) {
    step(progress.overall);
    return true;
  };
  PartsOfComplex parts = parts_of(result);
  const Result found = mesh_parts(result.surface.view(), meshing, parts);
  result.overlaps = parts.overlaps;
  const bool is_limit = is_interruption(found.outcome);
  if (!is_limit && !parts.refuses()) return;  // parts that enclose nothing are pasted, too
  result.outcome = found.outcome;
  result.message = found.message;
  if (!is_limit && !advice.empty()) result.message += "; " + advice;
}

void end_without_surface(const PasteOptions& options, const std::string& message, const std::string& advice,
                         PasteResult& result) {
  result.outcome = Outcome::not_representable;
  result.message = message;
  if (!advice.empty())
    result.message += "; " + advice;
  else if (options.tolerance > 0)
    result.message +=
        "; the tolerance must be above the depth of gaps and overlaps, and below the size of the parts' "
        "details";
}

/// Parts where they touch.
struct Together {
  repairing::State state;
  double moved = 0;
};

Together bring_together(const Complex& complex, const PasteOptions& options, const Step& step,
                        const Threads& threads, PasteResult& result) {
  const std::vector<Index>& part = result.part_of_facet;
  const double rounding = rounding_of(complex), gap = std::max(options.tolerance, rounding);
  result.gap = gap;
  const auto to = options.tolerance > 0 ? repairing::SnapTo::all : repairing::SnapTo::vertices;
  Together parts{repairing::state_of(complex)};
  parts.moved = repairing::snap(parts.state, part, to, gap, step, threads);
  repairing::glue(parts.state, part);
  parts.moved += repairing::fuse(parts.state, part, gap, rounding, step);
  repairing::glue(parts.state, part);
  return parts;
}

/// Cuts touching and crossing parts so that they fit; nullopt if no such surface is found.
std::optional<repairing::Rounded> fit(const Complex& complex, const PasteOptions& options,
                                      const std::string& advice, const Step& step, const Threads& threads,
                                      PasteResult& result) {
  const auto end = [&](const std::string& message) {
    end_without_surface(options, message, advice, result);
    return std::nullopt;
  };
  Together parts = bring_together(complex, options, step, threads, result);
  const std::string within = " within " + decimal(options.tolerance) + " of ";
  if (options.tolerance > 0 && is_hopeless(parts.state, step, threads))
    return end("the parts, brought together" + within + "each other, cross nearly everywhere");
  // If there is advice, details below the tolerance are the obstacle; reporting that is better than long
  // trials.
  const auto trials = advice.empty() ? repairing::Trials::all : repairing::Trials::near_trouble;
  RepairOptions arranging;
  static_cast<Limits&>(arranging) = options;
  const auto rounded_of = [&](Together&& given) {
    ExactSurface exact;
    repairing::Rounded rounded = repairing::round_arranged(std::move(given.state), arranging, result.report,
                                                           exact, step, threads, trials);
    rounded.displacement += given.moved;
    return rounded;
  };
  const auto opened_by = [&](const repairing::Rounded& rounded) {
    return repairing::opened_part(repairing::state_of(complex), rounded.state, result.part_of_facet);
  };
  repairing::Rounded rounded = rounded_of(std::move(parts));
  if (!rounded.is_valid)
    return end("no doubles were found for the new points with which the surface is valid");
  const Index opened = opened_by(rounded);
  if (opened == no_index) return rounded;
  // A corner that reaches into another part by less than doubles can tell is cut off and stays as a strip.
  // The surface that it touches can be led through it instead.
  for (const double last_bits : {repairing::kThinnest / 8, repairing::kThinnest}) {
    parts = bring_together(complex, options, step, threads, result);
    parts.moved += repairing::weld(parts.state, last_bits * repairing::last_bit(parts.state.vertices), step);
    rounded = rounded_of(std::move(parts));
    if (rounded.is_valid && opened_by(rounded) == no_index) return rounded;
  }
  return end(opened_text(result.parts[opened], options.tolerance, result.gap));
}

void run(const Surface& joined, const PasteOptions& options, PlainMonitor& monitor, PasteResult& result) {
  const Threads threads = Threads(options.threads).polling([&] { monitor.poll_again(); });
  const Step step = [&](double fraction) { monitor.poll(fraction); };
  const Complex complex = joined.view();
  std::string advice;
  if (options.cut && options.tolerance > 0) {
    require_smaller_than_parts(complex, result, options.tolerance);
    advice = advice_on_tolerance(complex, result, options.tolerance, step);
  }
  repairing::Rounded rounded;
  if (options.cut) {
    std::optional<repairing::Rounded> fitted = fit(complex, options, advice, step, threads, result);
    if (!fitted) return;
    rounded = *std::move(fitted);
  } else {
    repairing::State state = repairing::state_of(complex);
    repairing::glue(state, result.part_of_facet);
    rounded.state = std::move(state);
  }
  repairing::deliver(complex, std::move(rounded), result);
  compare_with_parents(complex, result.part_of_facet, result);
  if (options.cut) prove_distance(complex, options.tolerance, step, result);
  if (!options.judge) return;
  result.apart = find_apart(result, [&] { monitor.poll_again(); });
  judge(options, advice, step, result);
}

bool overlap(std::span<const PartOverlap> overlaps, const PartApart& apart) {
  return std::any_of(overlaps.begin(), overlaps.end(), [&](const PartOverlap& o) {
    return std::minmax(o.first, o.second) == std::minmax(apart.part, apart.nearest);
  });
}

void paste_joined(const Surface& joined, const PasteOptions& options, PasteResult& result) {
  const FloatEnvironment environment;
  result.overlap = options.overlap;
  result.report.vertices = joined.vertices.size();
  result.report.facets = joined.facets.size();
  result.report.segments = joined.segments.size();
  run_within(options, options.progress, result,
             [&](PlainMonitor& monitor) { run(joined, options, monitor, result); });
  if (result.outcome != Outcome::done) {
    result.surface = {};
    result.parents = result.segment_parents = {};
    result.turned.clear();
    return;
  }
  result.surface.remarks = joined.remarks;
  std::erase_if(result.apart, [&](const PartApart& apart) { return overlap(result.overlaps, apart); });
}

}  // namespace

PasteResult paste(std::span<const Surface> parts, const PasteOptions& options,
                  std::span<const std::string> names) {
  require_sensible(parts, options);
  if (parts.size() < 2) throw std::invalid_argument("at least two parts are needed to paste");
  const Surface joined = join(parts, names);
  PasteResult result;
  NamedParts named = name_parts(parts, names, options.labels);
  result.parts = std::move(named.parts);
  result.part_of_facet = parts_of_facets(parts);
  paste_joined(joined, options, result);
  result.surface.names.regions = std::move(named.regions);
  return result;
}

PasteResult paste_components(const Surface& surface, const PasteOptions& options) {
  require_sensible({&surface, 1}, options);
  PasteResult result;
  result.part_of_facet = parts_by_components(surface);
  Index parts = 0;
  for (const Index p : result.part_of_facet) parts = std::max(parts, p + 1);
  if (parts < 2) throw std::invalid_argument("the surface is one part, so that there is nothing to paste");
  for (Index p = 0; p < parts; ++p) {
    PastedPart part;
    part.name = (options.labels.empty() ? "part " : options.labels[0] + " part ") + std::to_string(p + 1);
    part.id = static_cast<int>(p) + 1;
    result.parts.push_back(std::move(part));
  }
  paste_joined(surface, options, result);
  result.surface.regions = surface.regions;
  result.surface.holes = surface.holes;
  return result;
}

Result mesh(const PasteResult& pasted, const Options& options) {
  if (pasted.outcome != Outcome::done)
    throw std::invalid_argument("there is no pasted surface: " + pasted.message);
  PartsOfComplex parts = parts_of(pasted);
  parts.seeds = options.regions.size();
  Options with_sizes = options;
  for (const PastedPart& part : pasted.parts)
    with_sizes.regions.insert(with_sizes.regions.end(), part.seeds.begin(), part.seeds.end());
  Result result = mesh_parts(pasted.surface.view(), with_sizes, parts);
  result.marker_sets = pasted.marker_sets;
  if (result.outcome != Outcome::done) return result;
  for (const PartApart& apart : find_apart(pasted, [] {}))
    if (!overlap(parts.overlaps, apart)) result.warnings.push_back(warn_of_apart(pasted, apart));
  return result;
}

}  // namespace holdfast
