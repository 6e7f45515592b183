#include "api/report.h"

#include <array>
#include <cstdio>

namespace holdfast {

Report::Input describe_input(const Complex& complex, const SegmentTable* table) {
  Report::Input input;
  input.vertices = complex.vertices.size();
  input.facets = complex.facets.size();
  input.segments = complex.segments.size();
  if (table == nullptr) return input;
  const SurfaceTopology topology = surface_topology(complex, *table);
  input.segments = topology.segments;
  input.components = topology.components;
  input.closed = topology.closed;
  input.nonmanifold_segments = topology.nonmanifold_segments;
  input.dangling_facets = topology.dangling_facets;
  return input;
}

Stopwatch::~Stopwatch() {
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  report_.seconds[key_] += seconds;
}

std::string interruption_message(Outcome outcome, Stage stage, const Options& options) {
  const auto with = [](const char* format, double value) {
    std::array<char, 80> text{};
    std::snprintf(text.data(), text.size(), format, value);
    return std::string(text.data());
  };
  std::string what;
  if (outcome == Outcome::time_limit)
    what = with("the time limit of %.6g s ran out", options.time_limit);
  else if (outcome == Outcome::memory_limit)
    what = with("the memory limit of %.6g GB was reached", static_cast<double>(options.memory_limit) * 1e-9);
  else
    what = "cancelled";
  return what + " in stage " + name(stage);
}

}  // namespace holdfast
