// Holdfast: what a list of defects comes to.
//
// Defects say which rule is broken where, one by one and exactly. Here they are grouped by what has probably
// gone wrong. Distances serve as hints in this, measured by the edges nearby; they decide nothing.
#pragma once

#include "holdfast/export.h"
#include "holdfast/types.h"

namespace holdfast {

/// What has probably gone wrong, in the order in which it is best mended.
enum class Cause {
  not_finite,        ///< coordinates that are not finite
  bad_index,         ///< indices of vertices that do not exist
  repeated_vertex,   ///< vertices at one place
  no_extent,         ///< triangles without area, segments without length
  repeated_facet,    ///< a triangle twice
  unwelded,          ///< elements that do not fit, with two vertices that are almost at one place
  t_junction,        ///< a vertex inside a side or segment
  vertex_in_facet,   ///< a vertex inside a triangle
  overlap,           ///< triangles that share area, sides that share length
  parts_cross,       ///< parts of the surface that pass through each other
  self_crossing,     ///< a part that passes through itself
  encloses_nothing,  ///< nothing to fill
  outside,           ///< what borders on no region that is kept
  orientation,       ///< triangles turned against each other
  crack,             ///< no broken rule: borders that almost meet
  open_border,       ///< no broken rule: sides of one triangle alone
};

/// "unwelded vertices" and so on.
[[nodiscard]] HOLDFAST_API const char* name(Cause cause);

/// A vertex that lies almost on another one, or almost on a side where a border is open: nearer than a
/// fiftieth of every edge at it, and of every edge at the other vertex.
struct Gap {
  Index vertex;
  Segment other;  ///< ends of a side, or one vertex twice
  double distance;
  bool open;  ///< between open borders; else between elements that do not fit
  std::string message;
};

struct DefectGroup {
  Cause cause;
  std::size_t count = 0;             ///< of defects, of gaps, or of sides
  std::vector<std::size_t> defects;  ///< which of those given; none for cracks and open borders
  std::vector<Point> worst;          ///< the worst place: a point or two ends
  std::string message;               ///< one sentence: what, how many, the worst, what to do
};

struct DefectSummary {
  std::vector<DefectGroup> groups;  ///< by cause; none is empty
  std::vector<Gap> gaps;            ///< unwelded vertices and cracks, widest first
  std::vector<Segment> border;      ///< sides of one triangle alone
  std::size_t parts = 0;            ///< components of the triangles
  /// Bounded regions that the triangles enclose, if no defect says that they do not fit together. Exact, and
  /// by counting alone: the rank of their second homology (Alexander duality).
  std::optional<std::size_t> enclosed;
};

/// Groups defects that `diagnose` or `mesh` has found in a complex. Vertices at one place count as one.
[[nodiscard]] HOLDFAST_API DefectSummary summarise(const Complex& complex, std::span<const Defect> defects);

}  // namespace holdfast
