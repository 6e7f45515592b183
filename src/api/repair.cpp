// The public function of holdfast/repair.h: limits and outcomes around the work of src/repair.
#include "holdfast/repair.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <new>
#include <stdexcept>
#include <string>

#include "api/scale.h"
#include "api/unite.h"
#include "mesh/limit_message.h"
#include "mesh/memory.h"
#include "mesh/plain_monitor.h"
#include "numbers/finite.h"
#include "numbers/float_environment.h"
#include "repair/bounds.h"
#include "repair/covered.h"
#include "repair/deliver.h"
#include "repair/holes.h"
#include "repair/near.h"
#include "repair/plans.h"
#include "repair/rounding.h"
#include "repair/weld.h"
#include "text/decimal.h"

namespace holdfast {
namespace {

void require_sensible(const Complex& complex, const RepairOptions& options) {
  const auto fits = [](const auto& marks, const auto& entities) {
    return marks.empty() || marks.size() == entities.size();
  };
  if (!fits(complex.facet_markers, complex.facets))
    throw std::invalid_argument("as many facet markers as facets are needed, or none");
  if (!fits(complex.segment_markers, complex.segments))
    throw std::invalid_argument("as many segment markers as segments are needed, or none");
  if (!fits(complex.vertex_markers, complex.vertices))
    throw std::invalid_argument("as many vertex markers as vertices are needed, or none");
  if (!(options.weld >= 0) || !std::isfinite(options.weld))
    throw std::invalid_argument("the tolerance for welding must be finite and not negative");
  if (!(options.join >= 0) || !std::isfinite(options.join))
    throw std::invalid_argument("the distance at which facets are joined must be finite and not negative");
  if (options.exact && options.join > 0)
    throw std::invalid_argument("the exact arrangement is of facets as they are: leave out the join");
  constexpr std::size_t kMostVertices = std::size_t{1} << 28;
  if (complex.vertices.size() > kMostVertices)
    throw std::length_error("more than 2^28 vertices are too many");
}

void end(RepairResult& result, Outcome outcome, std::string message) {
  result.outcome = outcome;
  result.message = std::move(message);
}

/// The power of two that scales finite vertices to near one. An exact arrangement is not scaled.
int scale_of(const Complex& complex, const RepairOptions& options) {
  if (options.exact) return 0;
  std::vector<Point> finite;
  for (const Point& p : complex.vertices)
    if (std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2])) finite.push_back(p);
  return choose_scale(finite);
}

/// Undoes a scale. Returns false if a point or distance becomes denormal and loses bits.
bool scale_back(repairing::Rounded& rounded, int k) {
  for (Point& p : rounded.state.vertices) {
    const Point before = p;
    p = scaled(p, -k);
    for (std::size_t i = 0; i < 3; ++i)
      if (std::isfinite(before[i]) && std::ldexp(p[i], k) != before[i]) return false;
  }
  rounded.joined_within = std::ldexp(rounded.joined_within, -k);
  const double before = rounded.displacement;
  rounded.displacement = std::ldexp(before, -k);
  return std::ldexp(rounded.displacement, k) == before;
}

/// Sign filters need products that do not overflow or underflow; otherwise each sign would need exact
/// arithmetic.
repairing::Rounded round_scaled(const Complex& complex, repairing::State state, const RepairOptions& options,
                                RepairResult& result, const Step& step, const Threads& threads,
                                repairing::Trials trials = repairing::Trials::all) {
  if (const int k = scale_of(complex, options); k != 0) {
    repairing::State moved = state;
    moved.vertices = scaled(state.vertices, k);
    RepairOptions there = options;
    there.join = std::ldexp(options.join, k);
    RepairReport report = result.report;
    repairing::Rounded rounded =
        repairing::round_arranged(std::move(moved), there, report, result.exact, step, threads, trials);
    if (scale_back(rounded, k)) {
      result.report = std::move(report);
      return rounded;
    }
  }
  return repairing::round_arranged(std::move(state), options, result.report, result.exact, step, threads,
                                   trials);
}

/// Whether a vertex of the input would be listed as moved by more than a tolerance.
bool moves_beyond(const Complex& complex, const repairing::State& state, double tolerance) {
  constexpr double kRoundedUp = 1 + 0x1p-48;
  for (std::size_t v = 0; v < complex.vertices.size(); ++v) {
    const Point &before = complex.vertices[v], &after = state.vertices[v];
    if (is_finite(before) && repairing::length(after - before) * kRoundedUp > tolerance) return true;
  }
  return false;
}

/// What is welded within a tolerance may pass itself by some last bits in the end, where hardly any mesh
/// could be in between. Such vertices and sides are welded once more, within 64 last bits, unless that takes
/// new resorts, or moves a vertex beyond the tolerance in all.
void weld_thin(const Complex& complex, repairing::Rounded& rounded, const RepairOptions& options,
               RepairResult& result, const Step& step, const Threads& threads) {
  const double thin = repairing::kThinnest * repairing::last_bit(rounded.state.vertices);
  const Rung rung = result.report.rung;
  // Of 17 results whose points were only rounded, all had a mesh, and this would take up to as long again.
  if (options.exact || options.weld <= thin || rung == Rung::nearest || rung > Rung::coarser) return;
  repairing::State state = rounded.state;
  constexpr repairing::MostWork kWork{100'000, 100};  // 3,000 comparisons a facet on a surface of needles
  repairing::Work work{kWork.of(state.facets.size())};
  const double moved = repairing::weld(state, thin, work, step);
  if (moved == 0 || work.is_spent()) return;
  RepairOptions again = options;
  again.weld = again.join = 0;
  again.exact = false;
  RepairResult second;
  repairing::Rounded welded;
  try {
    welded = round_scaled(complex, std::move(state), again, second, step, threads, repairing::Trials::little);
  } catch (const arrange::TooManyPoints&) {
    return;  // the first result is valid
  }
  if (!welded.is_valid || second.report.rung > Rung::coarser) return;
  if (moves_beyond(complex, welded.state, options.weld)) return;
  welded.displacement =
      repairing::sum_above(rounded.displacement, repairing::sum_above(moved, welded.displacement));
  rounded = std::move(welded);
  result.report.rounds += second.report.rounds;
  result.report.rung = std::max(result.report.rung, second.report.rung);
}

std::string told_less_joined(double join, double within) {
  const std::string what = within > 0 ? "they are joined within " + decimal(within) : "none are joined";
  return "joining within " + decimal(join) + " multiplies the facets, and most of them cross: " + what;
}

void run(const Complex& complex, const RepairOptions& options, PlainMonitor& monitor, RepairResult& result) {
  const Threads threads = Threads(options.threads).polling([&] { monitor.poll_again(); });
  const Step step = [&](double fraction) { monitor.poll(fraction); };
  repairing::State state = repairing::state_of(complex);
  const double welded =
      options.weld > 0 ? repairing::weld(state, options.weld, step, repairing::Touching::is_left) : 0;
  repairing::Rounded rounded = round_scaled(complex, std::move(state), options, result, step, threads);
  if (!rounded.is_valid)
    return end(result, Outcome::not_representable,
               "no doubles were found for the new points with which the surface is valid");
  if (rounded.joined_within < options.join)
    result.message = told_less_joined(options.join, rounded.joined_within);
  if (options.weld > 0) weld_thin(complex, rounded, options, result, step, threads);
  if (welded > 0) {
    // Welding turns what is thinner than the tolerance into a line, which is lost unless other facets contain
    // it.
    const double most = rounded.displacement + welded;
    rounded.displacement = repairing::cover_distance(rounded.state, repairing::state_of(complex), most, step);
  }
  repairing::Holes holes;
  if (options.fill_holes) holes = repairing::fill_holes(rounded.state, *options.fill_holes, step, threads);
  if (options.unite) {
    const std::size_t before = rounded.state.facets.size();
    unite(complex, rounded.state, holes, step, threads);
    rounded.has_united = rounded.state.facets.size() < before;
  }
  result.filled = std::move(holes.filled);
  result.left_open = std::move(holes.left_open);
  repairing::deliver(complex, std::move(rounded), result);
}

}  // namespace

RepairResult repair(const Complex& complex, const RepairOptions& options) {
  const FloatEnvironment environment;
  require_sensible(complex, options);
  const auto begin = std::chrono::steady_clock::now();
  RepairResult result;
  result.report.vertices = complex.vertices.size();
  result.report.facets = complex.facets.size();
  result.report.segments = complex.segments.size();
  try {
    PlainMonitor monitor(options, options.progress);
    monitor.tell(0);
    run(complex, options, monitor, result);
    monitor.tell(1);
  } catch (const Interrupted& interrupted) {
    end(result, interrupted.outcome(), limit_message(interrupted.outcome(), options));
  } catch (const arrange::TooManyPoints& many) {
    end(result, Outcome::memory_limit,
        "the arrangement has more than " + std::to_string(options.most_points) + " new points (" +
            std::to_string(many.count()) + " so far)");
  } catch (const std::bad_alloc&) {
    if (options.memory_limit == 0) throw;
    end(result, Outcome::memory_limit, limit_message(Outcome::memory_limit, options));
  }
  result.report.seconds["total"] =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  result.report.peak_memory_bytes = peak_memory_bytes();
  return result;
}

}  // namespace holdfast
