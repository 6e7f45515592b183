#include "api/report.h"

#include <new>

#include "mesh/limit_message.h"

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

Report::Elements describe_elements(const VolumeShape& shape, double target) {
  const auto& angles = shape.elements.least_dihedral;  // in bins of five degrees
  return {target,         shape.worst, shape.min_dihedral_deg, shape.max_dihedral_deg, angles[0] + angles[1],
          shape.dihedrals};
}

Report::Shape describe_shape(const ShapeCounts& counts) {
  static_assert(kQualityBins == Report::quality_bins);
  return {counts.min_dihedral_deg, counts.max_dihedral_deg, counts.least_dihedral, counts.quality};
}

Stopwatch::~Stopwatch() {
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  // The stage may have ended because memory ran out. Then a new entry may throw, and nothing could catch it.
  try {
    report_.seconds[key_] += seconds;
  } catch (const std::bad_alloc&) {
    return;
  }
}

std::string interruption_message(Outcome outcome, Stage stage, const Options& options) {
  return limit_message(outcome, options) + " in stage " + name(stage);
}

}  // namespace holdfast
