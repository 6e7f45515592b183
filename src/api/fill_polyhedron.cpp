#include "api/fill_polyhedron.h"

#include <utility>

#include "api/attempt.h"
#include "api/input.h"
#include "mesh/parallel.h"

namespace holdfast {

std::optional<Filling> fill_polyhedron(const Complex& polyhedron, PointsOfFilling points,
                                       const Limits& limits, Monitor& whole) {
  Options options;
  static_cast<Limits&>(options) = limits;
  options.add_points = points.may_be_added;
  options.progress = [&](const Progress&) {
    whole.poll_again();
    return true;
  };
  Monitor monitor(options);
  monitor.poll_again();
  const Threads one(1);
  Input input(polyhedron, SamePlace::defect, options, one, monitor);
  Result result;
  if (!input.validate(result.report.input).empty()) return std::nullopt;
  const Attempt attempt{input, options, options.seed, one, monitor, nullptr};
  std::optional<Recovered> recovered = recover(attempt, result);
  if (!recovered || result.report.forced_points > points.most_recovered) return std::nullopt;
  fill(attempt, *recovered, result);
  if (result.outcome != Outcome::done) return std::nullopt;
  std::vector<Point>& vertices = result.volume.vertices;
  vertices.erase(vertices.begin(),
                 vertices.begin() + static_cast<std::ptrdiff_t>(polyhedron.vertices.size()));
  return Filling{std::move(vertices), std::move(result.volume.tetrahedra)};
}

}  // namespace holdfast
