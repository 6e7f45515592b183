// The lines of a DXF file, as outlines in a plane: LINE, LWPOLYLINE, POLYLINE, ARC, CIRCLE, ELLIPSE and
// SPLINE.
#pragma once

#include <functional>
#include <vector>

#include "io/dxf_text.h"
#include "io/mesh_data.h"
#include "io/placement.h"

namespace holdfast::io {

/// Corners of a polyline. The side behind a corner is an arc if its bulge is not 0: the tangent of a quarter
/// of its angle, positive if it turns to the left.
struct Outline {
  std::vector<Point> corners;
  std::vector<double> bulges;
  bool closed = false, in_space = false;
  double elevation = 0;  ///< of corners that are not in space
  Placement plane;
  std::size_t place = 0;

  /// Adds the corner that an entity VERTEX gives.
  void add(DxfText& text, const DxfEntity& entity);
};

/// An outline without corners, for POLYLINE.
[[nodiscard]] Outline outline_of_polyline(DxfText& text, const DxfEntity& entity);

class DxfLines {
 public:
  /// Arcs become pieces of at most `arc_step` degrees; 0: they are refused.
  explicit DxfLines(double arc_step) : arc_step_(arc_step) {}

  /// Adds the segments of an entity to a mesh; false if it is none of these lines.
  bool add(MeshData& mesh, DxfText& text, const DxfEntity& entity, int layer);
  void add(MeshData& mesh, const DxfText& text, const Outline& outline, int layer);

  /// The ends of an ARC, which the file gives by angles, get the place of the nearest end of another line
  /// within a millionth of the radius: what six digits may differ from it.
  void join_ends(MeshData& mesh) const;

 private:
  struct ArcEnd {
    Index vertex;
    double radius;
  };
  void add_light_polyline(MeshData& mesh, DxfText& text, const DxfEntity& entity, int layer);
  void add_arc(MeshData& mesh, DxfText& text, const DxfEntity& entity, int layer);
  void add_ellipse(MeshData& mesh, DxfText& text, const DxfEntity& entity, int layer);
  /// False for a spline without control points.
  bool add_spline(MeshData& mesh, DxfText& text, const DxfEntity& entity, int layer);
  /// `at` gives its points, from 0 to 1.
  void add_curve(MeshData& mesh, std::size_t pieces, bool is_closed, double radius,
                 const std::function<Point(double)>& at, int layer);
  /// Throws FileError if arcs are refused.
  void require_step(const DxfText& text, std::size_t place) const;
  /// The number of pieces of an arc. Throws FileError if arcs are refused.
  [[nodiscard]] std::size_t pieces_of(const DxfText& text, std::size_t place, double degrees) const;

  double arc_step_;
  std::vector<ArcEnd> arc_ends_;
  std::vector<Index> line_ends_;
};

}  // namespace holdfast::io
