#include "api/fill_polyhedron.h"

#include <utility>

#include "api/attempt.h"
#include "api/input.h"
#include "mesh/parallel.h"

namespace holdfast {

std::optional<Filling> fill_polyhedron(const Complex& polyhedron, const Limits& limits, Monitor& whole) {
  Options options;
  static_cast<Limits&>(options) = limits;
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
  attempt(input, options, options.seed, one, monitor, nullptr, result);
  if (result.outcome != Outcome::done) return std::nullopt;
  std::vector<Point>& vertices = result.volume.vertices;
  vertices.erase(vertices.begin(),
                 vertices.begin() + static_cast<std::ptrdiff_t>(polyhedron.vertices.size()));
  return Filling{std::move(vertices), std::move(result.volume.tetrahedra)};
}

}  // namespace holdfast
