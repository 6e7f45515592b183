// Reads VTK's parallel XML formats, .pvtu and .pvtp, whose files list the pieces of processes
// (https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html, "PUnstructuredGrid"). Copies of other
// pieces' cells are skipped, and points are joined by their global ids or, without ids, by their places.
#include <set>
#include <system_error>
#include <utility>

#include "io/file_bytes.h"
#include "io/formats.h"
#include "io/named_files.h"
#include "io/turn.h"
#include "io/vtu_join.h"

namespace holdfast::io {
namespace {

namespace fs = std::filesystem;

struct NamedPiece {
  XmlTag tag;
  fs::path path;
};

/// The pieces in order. Throws FileError, with the line, for an invalid name.
std::vector<NamedPiece> named_pieces(const Source& source, XmlReader& xml) {
  std::vector<NamedPiece> pieces;
  std::set<fs::path> seen;
  std::string_view ending_of_pieces;
  while (std::optional<XmlTag> tag = xml.next()) {
    if (tag->closing) continue;
    if (tag->name == "VTKFile") {
      const std::string type = tag->attribute("type");
      if (type != "PUnstructuredGrid" && type != "PPolyData")
        xml.fail(*tag,
                 "the type " + in_quotes(type) + " is not read; only PUnstructuredGrid and PPolyData are");
      ending_of_pieces = type == "PPolyData" ? ".vtp" : ".vtu";
    }
    if (tag->name != "Piece") continue;
    const std::string name = unescaped(tag->attribute("Source"));
    if (name.empty()) xml.fail(*tag, "the piece names no file: it has no Source");
    const fs::path path = source.path.parent_path() / name;
    if (const std::string ending = lower(without_gz(path).extension().string()); ending != ending_of_pieces)
      xml.fail(*tag, "a piece in the format " + in_quotes(ending) + " is not read; only " +
                         std::string(ending_of_pieces) + " is");
    if (!seen.insert(path.lexically_normal()).second)
      xml.fail(*tag, "the piece " + in_quotes(name) + " is named twice");
    pieces.push_back({*std::move(tag), path});
  }
  if (ending_of_pieces.empty())
    throw FileError(source.path, "", "not a VTK XML file: it has no VTKFile element");
  if (pieces.empty()) throw FileError(source.path, "", "the file names no pieces");
  return pieces;
}

std::vector<VtuPiece> read_pieces(const Source& source) {
  XmlReader xml(source);
  std::vector<VtuPiece> pieces;
  for (const NamedPiece& named : named_pieces(source, xml)) {
    std::error_code error;
    if (!fs::is_regular_file(named.path, error))
      xml.fail(named.tag, "the piece " + in_quotes(named.path.string()) +
                              (fs::exists(named.path, error) ? " is no file" : ": there is no such file"));
    const FileBytes bytes(named.path, source.watch);
    pieces.push_back(
        {named.path,
         named.path.filename().string() + ": ",
         read_vtu_blocks({named.path, bytes.view(), source.finite, source.watch, source.tolerance},
                         VtuGhosts::left_out),
         {}});
    const auto has_ids = [](const VtuPiece& piece) {
      return piece.block.mesh.vertices.empty() || !piece.block.point_ids.empty();
    };
    if (has_ids(pieces.back()) != has_ids(pieces.front()) && !pieces.back().block.mesh.vertices.empty() &&
        !pieces.front().block.mesh.vertices.empty())
      xml.fail(named.tag, "some pieces have ids of their points in the whole, and some have none");
  }
  return pieces;
}

}  // namespace

MeshData read_pvtu(const Source& source) {
  std::vector<VtuPiece> pieces = read_pieces(source);
  MeshData mesh = joined(pieces);
  turn_to_vtk(mesh);
  return mesh;
}

std::vector<fs::path> pvtu_files(const fs::path& path) {
  return with_named_files(path, [](const Source& source) {
    XmlReader xml(source);
    std::vector<fs::path> files;
    for (const NamedPiece& piece : named_pieces(source, xml)) {
      files.push_back(piece.path);
      files.push_back(surface_beside(without_gz(piece.path)));
    }
    return files;
  });
}

}  // namespace holdfast::io
