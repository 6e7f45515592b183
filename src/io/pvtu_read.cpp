// Reads VTK's parallel XML format, whose file names the pieces of processes
// (https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html, "PUnstructuredGrid"): copies of other
// pieces' cells are left out, and points are joined by their ids in the whole, or by their places where they
// have none.
#include <algorithm>
#include <array>
#include <cstring>
#include <map>
#include <set>
#include <system_error>
#include <utility>

#include "io/file_bytes.h"
#include "io/formats.h"
#include "io/vtu_block.h"
#include "numbers/finite.h"

namespace holdfast::io {
namespace {

namespace fs = std::filesystem;

struct NamedPiece {
  XmlTag tag;
  fs::path path;
};

/// The pieces in their order. Throws FileError for the line of a name that is none.
std::vector<NamedPiece> named_pieces(const Source& source, XmlReader& xml) {
  std::vector<NamedPiece> pieces;
  std::set<fs::path> seen;
  bool is_index = false;
  while (std::optional<XmlTag> tag = xml.next()) {
    if (tag->closing) continue;
    if (tag->name == "VTKFile") {
      const std::string type = tag->attribute("type");
      if (type != "PUnstructuredGrid")
        xml.fail(*tag, "the type " + in_quotes(type) + " is not read; only PUnstructuredGrid is");
      is_index = true;
    }
    if (tag->name != "Piece") continue;
    const std::string name = unescaped(tag->attribute("Source"));
    if (name.empty()) xml.fail(*tag, "the piece names no file: it has no Source");
    const fs::path path = source.path.parent_path() / name;
    if (const std::string ending = lower(without_gz(path).extension().string()); ending != ".vtu")
      xml.fail(*tag, "a piece in the format " + in_quotes(ending) + " is not read; only .vtu is");
    if (!seen.insert(path.lexically_normal()).second)
      xml.fail(*tag, "the piece " + in_quotes(name) + " is named twice");
    pieces.push_back({*std::move(tag), path});
  }
  if (!is_index) throw FileError(source.path, "", "not a VTK XML file: it has no VTKFile element");
  if (pieces.empty()) throw FileError(source.path, "", "the file names no pieces");
  return pieces;
}

struct Piece {
  fs::path path;
  VtuBlock block;
  std::vector<Index> number;  ///< of its vertices in the whole
};

std::vector<Piece> read_pieces(const Source& source) {
  XmlReader xml(source);
  std::vector<Piece> pieces;
  for (const NamedPiece& named : named_pieces(source, xml)) {
    std::error_code error;
    if (!fs::is_regular_file(named.path, error))
      xml.fail(named.tag, "the piece " + in_quotes(named.path.string()) +
                              (fs::exists(named.path, error) ? " is no file" : ": there is no such file"));
    const FileBytes bytes(named.path, source.watch);
    pieces.push_back(
        {named.path,
         read_vtu_blocks({named.path, bytes.view(), source.finite, source.watch, source.tolerance},
                         VtuGhosts::left_out),
         {}});
    const auto has_ids = [](const Piece& piece) {
      return piece.block.mesh.vertices.empty() || !piece.block.point_ids.empty();
    };
    if (has_ids(pieces.back()) != has_ids(pieces.front()) && !pieces.back().block.mesh.vertices.empty() &&
        !pieces.front().block.mesh.vertices.empty())
      xml.fail(named.tag, "some pieces have ids of their points in the whole, and some have none");
  }
  return pieces;
}

bool same(const Point& a, const Point& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

/// Numbers vertices in the order of their ids.
void number_by_ids(std::vector<Piece>& pieces, MeshData& whole) {
  struct Named {
    std::int64_t id;
    std::size_t piece, vertex;
  };
  std::vector<Named> all;
  for (std::size_t k = 0; k < pieces.size(); ++k)
    for (std::size_t v = 0; v < pieces[k].block.point_ids.size(); ++v)
      all.push_back({pieces[k].block.point_ids[v], k, v});
  std::stable_sort(all.begin(), all.end(), [](const Named& a, const Named& b) { return a.id < b.id; });
  std::vector<std::vector<int>> markers;
  for (Piece& piece : pieces) {
    piece.number.resize(piece.block.mesh.vertices.size());
    markers.push_back(piece.block.mesh.vertex_markers.take(piece.number.size()));
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Named& named = all[i];
    const Point& p = pieces[named.piece].block.mesh.vertices[named.vertex];
    const auto fail = [&](const std::string& reason) {
      throw FileError(pieces[named.piece].path, "point " + std::to_string(named.vertex), reason);
    };
    if (named.id < 0) fail("its id in the whole, " + std::to_string(named.id) + ", is negative");
    if (i == 0 || all[i - 1].id != named.id)
      whole.add_vertex(p, tag_of(markers[named.piece], named.vertex));
    else if (!same(p, whole.vertices.back()))
      fail("it has the id " + std::to_string(named.id) +
           " in the whole, as a point at another place has in " + pieces[all[i - 1].piece].path.string());
    pieces[named.piece].number[named.vertex] = static_cast<Index>(whole.vertices.size() - 1);
  }
}

/// A vertex at the place of one of an earlier piece is this; points of one piece stay apart.
void number_by_places(std::vector<Piece>& pieces, MeshData& whole) {
  std::map<Point, Index> at;
  std::size_t joined = 0;
  for (Piece& piece : pieces) {
    MeshData& mesh = piece.block.mesh;
    const std::vector<int> markers = mesh.vertex_markers.take(mesh.vertices.size());
    const auto before = static_cast<Index>(whole.vertices.size());
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
      const auto there = is_finite(mesh.vertices[v]) ? at.find(mesh.vertices[v]) : at.end();
      const bool is_known = there != at.end() && there->second < before;
      if (!is_known) whole.add_vertex(mesh.vertices[v], tag_of(markers, v));
      joined += is_known ? 1 : 0;
      piece.number.push_back(is_known ? there->second : static_cast<Index>(whole.vertices.size() - 1));
    }
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
      if (is_finite(mesh.vertices[v])) at.try_emplace(mesh.vertices[v], piece.number[v]);
  }
  whole.leave_out(joined, "points at the places of others, of pieces that have no ids of points,",
                  "point at the place of another, of pieces that have no ids of points,");
}

template <std::size_t N>
std::array<Index, N> ascending_corners(std::array<Index, N> corners, const std::vector<Index>& number) {
  for (Index& v : corners) v = number[v];
  std::sort(corners.begin(), corners.end());
  return corners;
}

/// Keeps the entities that no earlier piece has.
template <std::size_t N>
void keep_new(std::vector<std::array<Index, N>>& entities, Tags& markers, const std::vector<Index>& number,
              std::set<std::array<Index, N>>& earlier) {
  const std::vector<int> given = markers.take(entities.size());
  std::vector<std::array<Index, N>> kept;
  std::vector<std::array<Index, N>> fresh;
  Tags kept_markers;
  for (std::size_t i = 0; i < entities.size(); ++i) {
    const std::array<Index, N> corners = ascending_corners(entities[i], number);
    if (earlier.count(corners) > 0) continue;
    fresh.push_back(corners);
    kept_markers.add(kept.size(), tag_of(given, i));
    kept.push_back(entities[i]);
  }
  earlier.insert(fresh.begin(), fresh.end());
  entities = std::move(kept);
  markers = std::move(kept_markers);
}

/// Adds the tetrahedra of all pieces in the order of their ids, and takes them from the pieces.
void add_tetrahedra_by_ids(std::vector<Piece>& pieces, MeshData& whole) {
  struct Named {
    std::int64_t id;
    Tetrahedron corners;
    int region;
  };
  std::vector<Named> all;
  for (Piece& piece : pieces) {
    MeshData& mesh = piece.block.mesh;
    const std::vector<int> regions = mesh.regions.take(mesh.tetrahedra.size());
    for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) {
      Tetrahedron corners = mesh.tetrahedra[t];
      for (Index& v : corners) v = piece.number[v];
      all.push_back({piece.block.tetrahedron_ids[t], corners, tag_of(regions, t)});
    }
    mesh.tetrahedra.clear();
    mesh.regions = {};
  }
  std::stable_sort(all.begin(), all.end(), [](const Named& a, const Named& b) { return a.id < b.id; });
  for (const Named& named : all) whole.add_tetrahedron(named.corners, named.region);
}

bool has_second_order(const MeshData& mesh) {
  return !mesh.mids.tetrahedra.empty() || !mesh.mids.facets.empty() || !mesh.mids.segments.empty();
}

MeshData joined(std::vector<Piece> pieces) {
  MeshData whole;
  const auto all_of = [&](auto has) { return std::all_of(pieces.begin(), pieces.end(), has); };
  const bool by_ids = all_of(
      [](const Piece& piece) { return piece.block.point_ids.size() == piece.block.mesh.vertices.size(); });
  if (by_ids)
    number_by_ids(pieces, whole);
  else
    number_by_places(pieces, whole);
  if (all_of([](const Piece& piece) {
        return piece.block.tetrahedron_ids.size() == piece.block.mesh.tetrahedra.size() &&
               !has_second_order(piece.block.mesh);
      }))
    add_tetrahedra_by_ids(pieces, whole);
  std::set<Triangle> facets;
  std::set<Segment> segments;
  for (Piece& piece : pieces) {
    MeshData& mesh = piece.block.mesh;
    if (!has_second_order(mesh) && mesh.quadrangles.empty()) {
      keep_new(mesh.facets, mesh.facet_markers, piece.number, facets);
      keep_new(mesh.segments, mesh.segment_markers, piece.number, segments);
    }
    for (Remark& remark : mesh.remarks)
      remark.message = piece.path.filename().string() + ": " + remark.message;
    append(whole, std::move(mesh), piece.number);
  }
  return whole;
}

}  // namespace

MeshData read_pvtu(const Source& source) { return joined(read_pieces(source)); }

std::vector<fs::path> pvtu_files(const fs::path& path) {
  std::vector<fs::path> files{path};
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return files;
  try {
    const FileBytes bytes(path);
    const Source source{path, bytes.view()};
    XmlReader xml(source);
    for (const NamedPiece& piece : named_pieces(source, xml)) {
      files.push_back(piece.path);
      files.push_back(surface_beside(without_gz(piece.path)));
    }
  } catch (const FileError&) {
    // The reader says so.
  }
  return files;
}

}  // namespace holdfast::io
