// Reads VTK's XML files, .vtu and .vtp, with the surface beside a volume, and .vtm, a list of several
// (https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html).
#include <algorithm>
#include <cstring>
#include <numeric>
#include <set>
#include <system_error>
#include <utility>

#include "io/file_bytes.h"
#include "io/formats.h"
#include "io/mid_nodes.h"
#include "io/pieces.h"
#include "io/turn.h"
#include "io/vtu_join.h"

namespace holdfast::io {
namespace {

/// Copies the values of a piece's points to those of the whole.
void put(const PointArray& part, const std::vector<Index>& number, std::size_t points, PointArray& whole) {
  if (whole.values.empty()) {
    whole.components = part.components;
    whole.values.resize(points * part.components);
  }
  const auto each = static_cast<std::ptrdiff_t>(part.components);
  for (std::size_t v = 0; v < number.size(); ++v)
    std::copy_n(part.values.begin() + static_cast<std::ptrdiff_t>(v) * each, each,
                whole.values.begin() + static_cast<std::ptrdiff_t>(number[v]) * each);
}

/// Adds a surface whose points have their indices in the volume.
void attach(MeshData& mesh, VtuBlock&& part, const std::filesystem::path& path) {
  std::vector<Index> number;
  if (part.in_volume.size() != part.mesh.vertices.size())
    throw FileError(
        path, "", "its points do not tell which of the volume's they are; the two files are not of one run");
  for (std::size_t i = 0; i < part.in_volume.size(); ++i) {
    const std::int64_t v = part.in_volume[i];
    if (v < 0 || static_cast<std::uint64_t>(v) >= mesh.vertices.size() ||
        std::memcmp(&mesh.vertices[static_cast<std::size_t>(v)], &part.mesh.vertices[i], sizeof(Point)) != 0)
      throw FileError(path, "point " + std::to_string(i),
                      "is none of the volume's; the two files are not of one run");
    number.push_back(static_cast<Index>(v));
  }
  append(mesh, std::move(part.mesh), number);
}

/// The mesh of a file of one or more pieces, without the file that may be beside it.
struct WholeFile {
  VtuBlock block;
  PointArray array;  ///< the first of the requested ones
};
WholeFile read_whole(VtuFile& file, VtuGhosts ghosts, std::span<const char* const> arrays = {}) {
  WholeFile whole;
  if (file.pieces() == 1) {
    whole.block = read_vtu_block(file, ghosts);
    if (!arrays.empty()) whole.array = point_array(file, arrays);
    return whole;
  }
  std::vector<VtuPiece> pieces;
  std::vector<PointArray> of_pieces;
  for (std::size_t k = 0; k < file.pieces(); ++k) {
    file.turn_to(k);
    if (file.points() == 0) continue;  // processes may have no share
    pieces.push_back(
        {file.source().path, "piece " + std::to_string(k) + ": ", read_vtu_block(file, VtuGhosts::left_out)});
    whole.block.surface_beside |= pieces.back().block.surface_beside;
    if (!arrays.empty()) of_pieces.push_back(point_array(file, arrays));
  }
  whole.block.mesh = joined(pieces);
  const std::size_t points = whole.block.mesh.vertices.size();
  for (std::size_t k = 0; k < of_pieces.size(); ++k) {
    if (of_pieces[k].components != of_pieces.front().components)
      throw FileError(file.source().path, "", "the array that is asked for differs in size between pieces");
    put(of_pieces[k], pieces[k].number, points, whole.array);
  }
  std::vector<std::int64_t>& ids = whole.block.point_ids;
  for (const VtuPiece& piece : pieces)
    for (std::size_t v = 0; v < piece.block.point_ids.size(); ++v) {
      if (ids.empty()) ids.resize(points, -1);
      ids[piece.number[v]] = piece.block.point_ids[v];
    }
  return whole;
}

VtuBlock read_file(const Source& source, VtuGhosts ghosts = VtuGhosts::kept) {
  VtuFile file(source);
  return std::move(read_whole(file, ghosts).block);
}

}  // namespace

void append(MeshData& mesh, MeshData&& part, const std::vector<Index>& number) {
  const auto moved = [&](auto entities) {
    for (auto& entity : entities)
      for (Index& v : entity) v = v == no_entity ? v : number[v];
    return entities;
  };
  const std::vector<int> regions = part.regions.take(part.tetrahedra.size()),
                         facets = part.facet_markers.take(part.facets.size()),
                         segments = part.segment_markers.take(part.segments.size());
  const auto tetrahedra = moved(std::move(part.tetrahedra));
  const auto triangles = moved(std::move(part.facets));
  const auto lines = moved(std::move(part.segments));
  const auto mids_of_tetrahedra = moved(std::move(part.mids.tetrahedra));
  const auto mids_of_facets = moved(std::move(part.mids.facets));
  for (std::size_t i = 0; i < tetrahedra.size(); ++i) {
    if (i < mids_of_tetrahedra.size() && mids_of_tetrahedra[i][0] != no_entity)
      add_second_order(mesh, tetrahedra[i], mids_of_tetrahedra[i], tag_of(regions, i));
    else
      mesh.add_tetrahedron(tetrahedra[i], tag_of(regions, i));
  }
  for (const Index first : part.quadrangles)
    mesh.quadrangles.push_back(static_cast<Index>(mesh.facets.size()) + first);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    if (i < mids_of_facets.size() && mids_of_facets[i][0] != no_entity)
      add_second_order(mesh, triangles[i], mids_of_facets[i], tag_of(facets, i));
    else
      mesh.add_facet(triangles[i], tag_of(facets, i));
  }
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (i < part.mids.segments.size() && part.mids.segments[i] != no_entity)
      add_second_order(mesh, lines[i], number[part.mids.segments[i]], tag_of(segments, i));
    else
      mesh.add_segment(lines[i], tag_of(segments, i));
  }
  mesh.polygon_counts.add(part.polygon_counts);
  mesh.cells.hexahedra += part.cells.hexahedra;
  mesh.cells.prisms += part.cells.prisms;
  mesh.cells.pyramids += part.cells.pyramids;
  mesh.cells.tetrahedra += part.cells.tetrahedra;
  mesh.remarks.insert(mesh.remarks.end(), part.remarks.begin(), part.remarks.end());
  mesh.names.facets.merge(part.names.facets);
  mesh.names.regions.merge(part.names.regions);
  mesh.names.segments.merge(part.names.segments);
  mesh.names.vertices.merge(part.names.vertices);
}

VtuBlock read_vtu_blocks(const Source& source, VtuGhosts ghosts) {
  VtuBlock block = read_file(source, ghosts);
  if (!block.surface_beside) return block;
  std::filesystem::path beside = surface_beside(without_gz(source.path));
  std::error_code error;
  if (!std::filesystem::exists(beside, error)) beside += ".gz";
  if (!can_have_a_file_beside(source.path) || !std::filesystem::exists(beside, error)) {
    block.mesh.remarks.push_back({RemarkKind::left_out, 1,
                                  "the facets and segments, which are in " +
                                      surface_beside(without_gz(source.path)).filename().string() +
                                      ", are left out: this file is not there"});
    return block;
  }
  const FileBytes bytes(beside, source.watch);
  attach(block.mesh, read_file({beside, bytes.view(), source.finite, source.watch}, ghosts), beside);
  return block;
}

MeshData read_vtu(const Source& source) {
  MeshData mesh = read_vtu_blocks(source).mesh;
  turn_to_vtk(mesh);
  return mesh;
}

MeshData read_vtm(const Source& source) {
  XmlReader xml(source);
  MeshData mesh;
  bool is_index = false;
  std::set<std::filesystem::path> seen;
  while (const std::optional<XmlTag> tag = xml.next()) {
    if (tag->name == "VTKFile" && !tag->closing) is_index = tag->attribute("type") == "vtkMultiBlockDataSet";
    if (tag->name != "DataSet" || tag->closing || tag->attribute("file").empty()) continue;
    if (!is_index) break;
    const std::filesystem::path part = source.path.parent_path() / tag->attribute("file");
    if (!seen.insert(part).second) xml.fail(*tag, "the file is named twice");
    if (const std::string ending = lower(part.extension().string()); ending != ".vtu" && ending != ".vtp")
      xml.fail(*tag, "a block in the format " + in_quotes(ending) + " is not read; only .vtu and .vtp are");
    const FileBytes bytes(part, source.watch);
    VtuBlock block = read_file({part, bytes.view(), source.finite, source.watch});
    if (!block.in_volume.empty() && !seen.empty() && !mesh.vertices.empty()) {
      attach(mesh, std::move(block), part);
      continue;
    }
    std::vector<Index> number(block.mesh.vertices.size());
    if (number.size() > no_entity - mesh.vertices.size()) xml.fail(*tag, "more points than 32 bits count");
    std::iota(number.begin(), number.end(), static_cast<Index>(mesh.vertices.size()));
    const std::vector<int> markers = block.mesh.vertex_markers.take(number.size());
    for (std::size_t i = 0; i < number.size(); ++i)
      mesh.add_vertex(block.mesh.vertices[i], tag_of(markers, i));
    append(mesh, std::move(block.mesh), number);
  }
  if (!is_index)
    throw FileError(source.path, "", "not a VTK multi-block file: it has no VTKFile of this type");
  if (seen.empty()) throw FileError(source.path, "", "the file names no blocks");
  turn_to_vtk(mesh);
  return mesh;
}

MeshData read_vtu(const Source& source, std::span<const char* const> names, PointArray& array) {
  VtuFile file(source);
  WholeFile whole = read_whole(file, VtuGhosts::kept, names);
  array = std::move(whole.array);
  return std::move(whole.block.mesh);
}

}  // namespace holdfast::io
