// Holdfast: sums up a list of defects.
//
// Each defect says exactly which rule is broken where. A summary groups defects by their probable cause.
// Distances, relative to the edges nearby, serve as hints only.
#pragma once

#include "holdfast/export.h"
#include "holdfast/types.h"

namespace holdfast {

/// Probable causes, in the order in which they are best repaired.
enum class Cause {
  not_finite,        ///< coordinates that are not finite
  bad_index,         ///< indices of vertices that do not exist
  repeated_vertex,   ///< vertices at one place
  no_extent,         ///< triangles without area, segments without length
  repeated_facet,    ///< a triangle twice
  unwelded,          ///< elements that do not fit, with two vertices almost at one place
  t_junction,        ///< a vertex inside a side or segment
  vertex_in_facet,   ///< a vertex inside a triangle
  overlap,           ///< triangles that share area, sides that share length
  parts_cross,       ///< parts of the surface that pass through each other
  self_crossing,     ///< a part that passes through itself
  encloses_nothing,  ///< nothing to fill
  outside,           ///< elements that border on no kept region
  orientation,       ///< triangles turned against each other
  crack,             ///< no broken rule: borders that almost meet
  open_border,       ///< no broken rule: sides with only one triangle
};

/// "unwelded vertices" and so on.
[[nodiscard]] HOLDFAST_API const char* name(Cause cause);

/// A vertex almost at another vertex, or almost on a side of an open border: nearer than a fiftieth of every
/// edge at it, and of every edge at the other vertex.
struct Gap {
  Index vertex;
  Segment other;  ///< ends of a side, or one vertex twice
  double distance;
  bool open;  ///< true: between open borders; false: between elements that do not fit
  std::string message;
};

struct DefectGroup {
  Cause cause;
  std::size_t count = 0;             ///< of defects, of gaps, or of sides
  std::vector<std::size_t> defects;  ///< indices into the given defects; none for cracks and open borders
  std::vector<Point> worst;          ///< the worst place: a point or two ends
  std::string message;               ///< one sentence: what, how many, the worst place, what to do
};

struct DefectSummary {
  std::vector<DefectGroup> groups;  ///< by cause; none is empty
  std::vector<Gap> gaps;            ///< unwelded vertices and cracks, widest first
  std::vector<Segment> border;      ///< sides of only one triangle
  std::size_t parts = 0;            ///< components of the triangles
  /// Number of bounded regions that the triangles enclose, unless a defect says that triangles do not fit
  /// together. Exact, computed by counting alone: the rank of the triangles' second homology (Alexander
  /// duality).
  std::optional<std::size_t> enclosed;
};

/// Groups defects that `diagnose` or `mesh` has found in a complex. Vertices at one place count as one.
[[nodiscard]] HOLDFAST_API DefectSummary summarise(const Complex& complex, std::span<const Defect> defects);

}  // namespace holdfast
