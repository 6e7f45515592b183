#include "io/dxf_faces.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "io/polygon.h"

namespace holdfast::io {
namespace {

constexpr std::int64_t kClosedInRows = 1, kSmooth = 4, kGrid = 16, kClosedInColumns = 32, kPolyface = 64;
constexpr std::int64_t kFrame = 16, kPosition = 64, kFaceOfVertices = 128;  // of a vertex

}  // namespace

DxfFaces::DxfFaces(const Source& source)
    : mesh_(without_polygons(source)), takes_lines_(source.keeps_polygons), lines_(source.arc_step) {}

bool DxfFaces::add(DxfText& text, const DxfEntity& entity, int layer) {
  if (entity.type == "VERTEX" && polyline_ != Polyline::none) return add_vertex(text, entity), true;
  if (entity.type == "SEQEND" && polyline_ != Polyline::none) return end_polyline(text), true;
  require_end(text);
  layer_ = layer;
  if (entity.type == "3DFACE")
    add_face(text, entity);
  else if (entity.type == "POLYLINE")
    begin_polyline(text, entity);
  else if (entity.type == "MESH")
    add_mesh(text, entity);
  else
    return entity.type == "SEQEND" || (takes_lines_ && lines_.add(mesh_, text, entity, layer));
  return true;
}

void DxfFaces::finish(const DxfText& text) {
  require_end(text);
  lines_.join_ends(mesh_);
}

void DxfFaces::require_end(const DxfText& text) const {
  if (polyline_ != Polyline::none)
    text.fail_at(place_, "the POLYLINE has no SEQEND; the file is truncated or damaged");
}

void DxfFaces::add_face(DxfText& text, const DxfEntity& entity) {
  const std::size_t first = mesh_.vertices.size();
  for (const int code : {10, 11, 12, 13}) {
    const bool has_corner = std::any_of(entity.groups.begin(), entity.groups.end(),
                                        [code](const DxfGroup& group) { return group.code == code; });
    if (has_corner) mesh_.vertices.push_back(text.point(entity, code));
  }
  const std::size_t count = mesh_.vertices.size() - first;
  if (count < 3) text.fail_at(entity.place, "a 3DFACE of " + std::to_string(count) + " corners");
  // A triangle repeats its last corner.
  const bool is_triangle = count == 3 || mesh_.vertices[first + 2] == mesh_.vertices[first + 3];
  if (is_triangle) mesh_.vertices.resize(first + 3);
  std::vector<std::size_t> corners{0, 1, 2};
  if (!is_triangle) corners.push_back(3);
  add_polygon_of(text, corners, first, corners.size(), entity.place);
}

void DxfFaces::begin_polyline(DxfText& text, const DxfEntity& entity) {
  place_ = entity.place;
  flags_ = text.integer(entity, 70, 0);
  polyline_ = (flags_ & kPolyface) != 0 ? Polyline::polyface
              : (flags_ & kGrid) != 0   ? Polyline::grid
                                        : Polyline::line;
  const bool is_smooth = (flags_ & kSmooth) != 0;
  const auto count = [&](int code) {
    const std::int64_t value = text.integer(entity, code, 0);
    if (value < 0 || value > 32767)
      text.fail_at(entity.place, "a polygon mesh of " + std::to_string(value) + " rows");
    return static_cast<std::size_t>(value);
  };
  if (polyline_ == Polyline::grid) {
    rows_ = count(is_smooth ? 73 : 71);
    columns_ = count(is_smooth ? 74 : 72);
  }
  points_.clear();
  faces_.clear();
  if (polyline_ == Polyline::line && takes_lines_) outline_ = outline_of_polyline(text, entity);
}

void DxfFaces::add_vertex(DxfText& text, const DxfEntity& entity) {
  const std::int64_t flags = text.integer(entity, 70, 0);
  const bool is_face =
      polyline_ == Polyline::polyface && (flags & kFaceOfVertices) != 0 && (flags & kPosition) == 0;
  if (polyline_ == Polyline::line) {
    if (takes_lines_ && (flags & kFrame) == 0) outline_.add(text, entity);
    return;
  }
  if (!is_face) {
    // Control points of a smooth grid are no points of it.
    if (polyline_ != Polyline::grid || (flags & kFrame) == 0) points_.push_back(text.point(entity, 10));
    return;
  }
  Face face{{}, entity.place};
  for (const int code : {71, 72, 73, 74}) {
    const std::int64_t corner = text.integer(entity, code, 0);  // negative: the side after it is invisible
    constexpr std::int64_t kMost = std::int64_t{1} << 32;
    if (corner < -kMost || corner > kMost)
      text.fail_at(entity.place, "a face of the vertex " + std::to_string(corner));
    if (corner != 0) face.corners.push_back(static_cast<std::size_t>(std::abs(corner)) - 1);
  }
  faces_.push_back(std::move(face));
}

void DxfFaces::end_polyline(const DxfText& text) {
  const Polyline kind = std::exchange(polyline_, Polyline::none);
  if (kind == Polyline::line)
    return takes_lines_ ? lines_.add(mesh_, text, outline_, layer_) : void(++lines_left_out_);
  if (kind == Polyline::grid) add_grid(text);
  const std::size_t first = mesh_.vertices.size();
  mesh_.vertices.insert(mesh_.vertices.end(), points_.begin(), points_.end());
  for (const Face& face : faces_)
    if (face.corners.size() >= 3) add_polygon_of(text, face.corners, first, points_.size(), face.place);
}

void DxfFaces::add_grid(const DxfText& text) {
  if (rows_ * columns_ != points_.size())
    text.fail_at(place_, "a polygon mesh of " + std::to_string(rows_) + " times " + std::to_string(columns_) +
                             " points, but with " + std::to_string(points_.size()));
  const std::size_t rows = (flags_ & kClosedInRows) != 0 ? rows_ : rows_ - std::min<std::size_t>(rows_, 1);
  const std::size_t columns =
      (flags_ & kClosedInColumns) != 0 ? columns_ : columns_ - std::min<std::size_t>(columns_, 1);
  const auto at = [&](std::size_t i, std::size_t j) { return i % rows_ * columns_ + j % columns_; };
  for (std::size_t i = 0; i < rows; ++i)
    for (std::size_t j = 0; j < columns; ++j)
      faces_.push_back({{at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)}, place_});
}

/// MESH: the number of vertices, these, the length of the list of faces, for each the number of its corners
/// and these.
void DxfFaces::add_mesh(DxfText& text, const DxfEntity& entity) {
  constexpr int kFaces = 93, kEdges = 94, kNumber = 90;
  const std::size_t first = mesh_.vertices.size();
  std::vector<std::int64_t> list;
  bool in_faces = false;
  for (const DxfGroup& group : entity.groups) {
    if (group.code == 10)
      mesh_.vertices.push_back({text.real(group), 0, 0});
    else if ((group.code == 20 || group.code == 30) && mesh_.vertices.size() > first)
      mesh_.vertices.back()[static_cast<std::size_t>(group.code / 10 - 1)] = text.real(group);
    else if (group.code == kFaces || group.code == kEdges)
      in_faces = group.code == kFaces;
    else if (group.code == kNumber && in_faces)
      list.push_back(text.integer(group));
  }
  const std::size_t count = mesh_.vertices.size() - first;
  std::vector<std::size_t> corners;
  for (std::size_t i = 0; i < list.size(); i += corners.size() + 1) {
    if (list[i] < 3 || static_cast<std::uint64_t>(list[i]) >= list.size() - i)
      text.fail_at(entity.place, "a face of " + std::to_string(list[i]) + " corners in a MESH");
    corners.clear();
    for (std::size_t k = 1; k <= static_cast<std::size_t>(list[i]); ++k)
      corners.push_back(static_cast<std::size_t>(list[i + k]));
    add_polygon_of(text, corners, first, count, entity.place);
  }
}

void DxfFaces::add_polygon_of(const DxfText& text, const std::vector<std::size_t>& corners, std::size_t first,
                              std::size_t count, std::size_t place) {
  std::vector<Index> polygon;
  for (const std::size_t corner : corners) {
    if (corner >= count)
      text.fail_at(place,
                   "a face names a vertex that is not among the " + std::to_string(count) + " before it");
    polygon.push_back(static_cast<Index>(first + corner));
  }
  add_polygon(mesh_, polygon, layer_, [&](const std::string& reason) { text.fail_at(place, reason); });
}

}  // namespace holdfast::io
