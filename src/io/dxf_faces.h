// The faces of a DXF file: 3DFACE, polyface meshes and polygon meshes (POLYLINE), and MESH; for outlines its
// lines, too.
#pragma once

#include <string>
#include <vector>

#include "io/dxf_lines.h"
#include "io/dxf_text.h"
#include "io/mesh_data.h"

namespace holdfast::io {

/// Faces of a block, or of the entities outside blocks, in coordinates of the block. Markers of `mesh` are
/// layers.
class DxfFaces {
 public:
  explicit DxfFaces(const Source& source);

  /// Adds the faces of an entity, or its lines if the source keeps polygons; false if it has none of these
  /// types. A polyline takes several entities.
  bool add(DxfText& text, const DxfEntity& entity, int layer);
  /// Throws if a polyline has not ended.
  void require_end(const DxfText& text) const;
  /// The same at the end of the block; ends of arcs then get the places of ends of lines beside them.
  void finish(const DxfText& text);

  [[nodiscard]] const MeshData& mesh() const { return mesh_; }
  /// Polylines in space or the plane, which have no faces.
  [[nodiscard]] std::size_t lines_left_out() const { return lines_left_out_; }

 private:
  enum class Polyline { none, polyface, grid, line };

  void add_face(DxfText& text, const DxfEntity& entity);
  void begin_polyline(DxfText& text, const DxfEntity& entity);
  void add_vertex(DxfText& text, const DxfEntity& entity);
  void end_polyline(const DxfText& text);
  void add_grid(const DxfText& text);
  void add_mesh(DxfText& text, const DxfEntity& entity);
  /// A face of corners that follow the vertex `first`.
  void add_polygon_of(const DxfText& text, const std::vector<std::size_t>& corners, std::size_t first,
                      std::size_t count, std::size_t place);

  MeshData mesh_;
  int layer_ = 0;
  Polyline polyline_ = Polyline::none;
  std::size_t place_ = 0;  ///< of the polyline
  std::int64_t flags_ = 0;
  std::size_t rows_ = 0, columns_ = 0;  ///< of a grid
  std::vector<Point> points_;           ///< of the polyline
  struct Face {
    std::vector<std::size_t> corners;
    std::size_t place;
  };
  std::vector<Face> faces_;
  bool takes_lines_;
  DxfLines lines_;
  Outline outline_;  ///< the polyline's, if it is a line
  std::size_t lines_left_out_ = 0;
};

}  // namespace holdfast::io
