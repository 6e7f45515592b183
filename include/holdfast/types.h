// Holdfast: public value types. Everything here is plain data without invariants of its own.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace holdfast {

/// Index of a vertex, facet, segment or tetrahedron; always zero-based.
using Index = std::uint32_t;
/// Stands for no tetrahedron, vertex, facet or segment.
inline constexpr Index no_entity = ~Index{0};
/// x, y, z in the input's own unit.
using Point = std::array<double, 3>;
/// A symmetric tensor, m11 m12 m22 m13 m23 m33. As a metric it gives a vector e the length sqrt(e^T M e).
using Metric = std::array<double, 6>;
/// Vertex indices of an input segment.
using Segment = std::array<Index, 2>;
/// Vertex indices of an input triangle (facet).
using Triangle = std::array<Index, 3>;
/// Vertex indices of a tetrahedron with det(b-a, c-a, d-a) > 0.
using Tetrahedron = std::array<Index, 4>;
/// The corners of the face opposite each corner of a tetrahedron, counterclockwise as seen from outside.
inline constexpr std::array<std::array<std::size_t, 3>, 4> outward_faces{
    {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
/// The face opposite corner i, as seen from outside.
[[nodiscard]] constexpr Triangle outward_face(const Tetrahedron& t, std::size_t i) {
  return {t[outward_faces[i][0]], t[outward_faces[i][1]], t[outward_faces[i][2]]};
}

/// Names of ids, in UTF-8. Several ids may share a name. Formats that allow each name only once write such
/// ids as one set, or add a number to the name (docs/formats.md). An id without an entry has no name.
struct Names {
  std::map<int, std::string> facets;    ///< of facet markers
  std::map<int, std::string> regions;   ///< of region ids
  std::map<int, std::string> segments;  ///< of segment markers
  std::map<int, std::string> vertices;  ///< of vertex markers

  [[nodiscard]] bool empty() const {
    return facets.empty() && regions.empty() && segments.empty() && vertices.empty();
  }
  friend bool operator==(const Names&, const Names&) = default;
};

/// A piecewise linear complex as non-owning views: the input of the mesher.
///
/// Vertices with identical coordinates (+0 and -0 are one) are one vertex, whatever their indices: a place.
/// Vertices that no facet and no segment uses are isolated points and become mesh vertices, too. Only those
/// that are not finite or at the place of another vertex are left out.
/// Marker spans are either empty or as long as the entities that they mark.
struct Complex {
  std::span<const Point> vertices;
  std::span<const Triangle> facets;
  std::span<const Segment> segments;
  std::span<const int> facet_markers;
  std::span<const int> segment_markers;
  std::span<const int> vertex_markers = {};
  const Names* names = nullptr;  ///< copied to the volume's `names`; null: none
};

/// What a remark is about. The numbers are stable.
enum class RemarkKind : int {
  left_out = 1,      ///< something in the file that a surface or volume cannot hold
  polygons_cut = 2,  ///< polygons of more than three corners, cut into triangles
  size_limits = 3,   ///< limits on volumes, taken as sizes
  not_held = 4,      ///< something that the format of a written file cannot hold
  renumbered = 5,    ///< ids that differ from the numbers in the file, because the format reserves these or
                     ///< several things in the file share a number
  cells_split = 6,   ///< hexahedra, prisms and pyramids, split into tetrahedra
};

/// Something that a reader or a writer did not carry over as it was.
struct Remark {
  RemarkKind kind;
  std::size_t count;    ///< of the entities or values concerned
  std::string message;  ///< one sentence
};

/// A piecewise linear complex that owns its arrays: the result of the readers.
struct Surface {
  std::vector<Point> vertices;
  std::vector<Triangle> facets;
  std::vector<Segment> segments;
  std::vector<int> facet_markers;    ///< empty, or one per facet
  std::vector<int> segment_markers;  ///< empty, or one per segment
  std::vector<int> vertex_markers;   ///< empty, or one per vertex
  /// Region seeds and hole seeds that some formats carry (.poly, .smesh).
  struct RegionSeed {
    Point where;
    int id;
    /// Longest edge of the region, or less, for field points (as Sizes::size); 0: no limit.
    double size = 0;
    double max_volume = 0;  ///< largest volume of a tetrahedron of the region; 0: no limit
  };
  std::vector<RegionSeed> regions;
  std::vector<Point> holes;
  std::vector<Remark> remarks;  ///< what the file also has, or has in another form
  Names names = {};

  /// A view of this surface, which must outlive it.
  [[nodiscard]] Complex view() const& {
    return {vertices, facets, segments, facet_markers, segment_markers, vertex_markers, &names};
  }
  Complex view() const&& = delete;
};

/// Mid-edge nodes turn straight elements into elements of second order. The corners stay as they are.
///
/// Nodes are numbered after the vertices of the volume: node k is `points[k - vertices.size()]`, and
/// elements that share an edge share its node. Either all edges of the volume have a node, or none.
struct MidNodes {
  std::vector<Point> points;
  /// Of edges 01 12 02 03 13 23, one per tetrahedron (VTK's order).
  std::vector<std::array<Index, 6>> tetrahedra;
  std::vector<std::array<Index, 3>> facets;  ///< of edges 01 12 02, one per facet
  std::vector<Index> segments;               ///< one per segment

  [[nodiscard]] bool empty() const { return points.empty() && tetrahedra.empty(); }
};

/// A tetrahedral mesh that conforms to a complex.
struct Volume {
  /// First the input's distinct places, in the order and with the bits of the first vertex at each, so that
  /// an input without repeated vertices keeps its indices; then the Steiner points.
  std::vector<Point> vertices;
  std::vector<Tetrahedron> tetrahedra;
  std::vector<int> regions;  ///< region id, one per tetrahedron
  std::vector<Triangle> facets;
  std::vector<int> facet_markers;  ///< empty, or one per facet
  std::vector<Segment> segments;
  std::vector<int> segment_markers;  ///< empty, or one per segment
  std::vector<int> vertex_markers;   ///< empty, or one per vertex: 0 for Steiner points
  /// Empty, or one per vertex: the first input vertex at its place, -1 for an added vertex.
  std::vector<std::int64_t> input_vertices;
  Names names = {};
  MidNodes mid_nodes = {};  ///< of a mesh of second order; empty for one of first order
};

/// Which rule of a valid input is broken. The numbers are stable.
enum class DefectKind : int {
  non_finite_coordinate = 1,      ///< a vertex in use has a coordinate that is NaN or infinite
  index_out_of_range = 2,         ///< a facet or segment names a vertex that does not exist
  repeated_vertex = 3,            ///< two vertices at one place; in volumes only, in surfaces they count as
                                  ///< one
  degenerate_facet = 4,           ///< a facet that names one place twice, or of zero area
  degenerate_segment = 5,         ///< a segment that names one place twice
  repeated_facet = 6,             ///< two facets with the same three vertices (places)
  vertex_in_segment = 7,          ///< a vertex in the interior of a segment or facet side (T-junction)
  vertex_in_facet = 8,            ///< a vertex in the interior of a facet
  segments_cross = 9,             ///< two segments or sides meet in an interior point
  segment_pierces_facet = 10,     ///< a segment or side pierces a facet's interior
  facets_cross = 11,              ///< two facets meet outside a common vertex or side
  facets_overlap = 12,            ///< two coplanar facets that share area
  segments_overlap = 13,          ///< two collinear segments or sides that share length
  encloses_nothing = 14,          ///< no region is bounded by the facets
  outside_region = 15,            ///< facets, segments or vertices border on no kept region
  inconsistent_orientation = 16,  ///< facets are oriented so that there is no winding number (Keep::winding
                                  ///< only)
};

/// One broken rule and the entities that break it, by their indices in the input.
struct Defect {
  DefectKind kind;
  std::vector<Index> vertices;
  std::vector<Index> facets;
  std::vector<Index> segments;
  /// 1 point, or the 2 ends of the intersection, rounded to doubles. For `encloses_nothing`: the ends of
  /// every open border edge, in pairs.
  std::vector<Point> where;
  std::string message;  ///< one sentence with indices, coordinates and what to do
};

}  // namespace holdfast
