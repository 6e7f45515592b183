// Writes pieces as one XDMF mesh with its arrays in HDF5, for DOLFINx: cells are ordered by part, so that
// process k reads and keeps the rows of part k. NAME.h5 has these arrays besides those of every .xdmf:
//   part                    the part of each cell
//   ghost_offsets, ghosts   cell i is a ghost of the parts ghosts[ghost_offsets[i] : ghost_offsets[i + 1]]
//   interfaces              rows of two parts and three points, for the faces between parts
#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <unordered_map>

#include "io/formats.h"
#include "io/hdf5_write.h"
#include "io/mesh_sets.h"
#include "io/pieces.h"
#include "io/vtk_cells.h"
#include "io/xdmf_grid.h"
#include "io/xml_reader.h"

namespace holdfast::io {
namespace {

struct Gathered {
  std::vector<Point> points;
  std::vector<std::int64_t> tetrahedra, triangles, interfaces;
  std::vector<std::int32_t> regions, parts, markers, ghosts;
  std::vector<std::int64_t> ghost_offsets{0};
  Names names;
};

void add_own(Gathered& to, const MeshPiece& piece, Index k, Watch& watch) {
  const Volume& volume = piece.volume;
  const auto put = [&](std::vector<std::int64_t>& into, const auto& corners) {
    for (const Index v : corners) into.push_back(static_cast<std::int64_t>(piece.vertices[v]));
  };
  for (std::size_t v = 0; v < piece.own_vertices; ++v) {
    if (piece.vertices[v] >= to.points.size()) to.points.resize(piece.vertices[v] + 1);
    to.points[piece.vertices[v]] = volume.vertices[v];
  }
  for (std::size_t t = 0; t < piece.own_tetrahedra; ++t) {
    watch.beat();
    put(to.tetrahedra, volume.tetrahedra[t]);
    to.regions.push_back(tag_of(volume.regions, t));
    to.parts.push_back(static_cast<std::int32_t>(k));
  }
  for (std::size_t f = 0; f < volume.facets.size(); ++f) {
    if (piece.facet_owners[f] != k) continue;
    put(to.triangles, volume.facets[f]);
    to.markers.push_back(tag_of(volume.facet_markers, f));
  }
  for (const MeshPiece::Interface& interface : piece.interfaces) {
    if (interface.other < k) continue;
    for (const Triangle& face : interface.faces) {
      to.interfaces.insert(to.interfaces.end(), {std::int64_t{k}, std::int64_t{interface.other}});
      put(to.interfaces, face);
    }
  }
  to.names = volume.names;
}

/// Adds ghosts, by the rows of the cells.
void add_ghosts(Gathered& to, std::vector<std::pair<std::int64_t, std::int32_t>>& ghosts) {
  std::sort(ghosts.begin(), ghosts.end());
  std::size_t next = 0;
  for (std::size_t row = 0; row < to.parts.size(); ++row) {
    for (; next < ghosts.size() && ghosts[next].first == static_cast<std::int64_t>(row); ++next)
      to.ghosts.push_back(ghosts[next].second);
    to.ghost_offsets.push_back(static_cast<std::int64_t>(to.ghosts.size()));
  }
}

Gathered gather(std::size_t parts, const PieceLoader& load, Watch& watch) {
  Gathered all;
  std::vector<std::pair<std::uint64_t, std::int32_t>> ghosts;  // by global number
  std::unordered_map<std::uint64_t, std::int64_t> row;         // of tetrahedra that are ghosts somewhere
  for (std::size_t k = 0; k < parts; ++k) {
    const MeshPiece piece = load(k);
    add_own(all, piece, static_cast<Index>(k), watch);
    for (std::size_t t = piece.own_tetrahedra; t < piece.tetrahedra.size(); ++t) {
      ghosts.emplace_back(piece.tetrahedra[t], static_cast<std::int32_t>(k));
      row[piece.tetrahedra[t]] = -1;
    }
  }
  std::int64_t next = 0;
  for (std::size_t k = 0; k < parts; ++k) {
    const MeshPiece piece = load(k);
    for (std::size_t t = 0; t < piece.own_tetrahedra; ++t, ++next)
      if (const auto found = row.find(piece.tetrahedra[t]); found != row.end()) found->second = next;
  }
  std::vector<std::pair<std::int64_t, std::int32_t>> by_row;
  for (const auto& [tetrahedron, part] : ghosts) by_row.emplace_back(row.at(tetrahedron), part);
  add_ghosts(all, by_row);
  return all;
}

}  // namespace

void write_xdmf_pieces(const std::filesystem::path& path, std::size_t parts, const PieceLoader& load,
                       const WriteOptions&, Watch& watch) {
  const Gathered all = gather(parts, load, watch);
  const std::uint64_t cells = all.parts.size(), facets = all.markers.size(), points = all.points.size();
  const std::filesystem::path heavy_path = with_ending(path, ".h5"),
                              surface_heavy_path = surface_beside(heavy_path);
  AtomicWriter heavy(heavy_path, &watch), surface_heavy(surface_heavy_path, &watch),
      volume_file(path, &watch), surface_file(surface_beside(path), &watch);
  write_hdf5(heavy, {"",
                     {},
                     {{"points", Hdf5Type::float64, points, 3, all.points.data()},
                      {"tetrahedra", Hdf5Type::int64, cells, 4, all.tetrahedra.data()},
                      {"region", Hdf5Type::int32, cells, 1, all.regions.data()},
                      {"part", Hdf5Type::int32, cells, 1, all.parts.data()},
                      {"ghost_offsets", Hdf5Type::int64, cells + 1, 1, all.ghost_offsets.data()},
                      {"ghosts", Hdf5Type::int32, all.ghosts.size(), 1, all.ghosts.data()},
                      {"interfaces", Hdf5Type::int64, all.interfaces.size() / 5, 5, all.interfaces.data()}},
                     {}});
  write_hdf5(surface_heavy, {"",
                             {},
                             {{"triangles", Hdf5Type::int64, facets, 3, all.triangles.data()},
                              {"marker", Hdf5Type::int32, facets, 1, all.markers.data()}},
                             {}});
  const std::string heavy_name = escaped(heavy_path.filename().string()),
                    surface_heavy_name = escaped(surface_heavy_path.filename().string());
  write_xdmf_grid(volume_file, {heavy_name, heavy_name, points},
                  {"Tetrahedron", "tetrahedra", cells, 4, {"region", "part"}}, all.names, true);
  write_xdmf_grid(surface_file, {surface_heavy_name, heavy_name, points},
                  {"Triangle", "triangles", facets, 3, {"marker"}}, all.names);
  // All files are completed before any gets its name.
  for (AtomicWriter* file : {&heavy, &surface_heavy, &surface_file, &volume_file}) file->finish();
  for (AtomicWriter* file : {&heavy, &surface_heavy, &surface_file, &volume_file}) file->commit();
}

}  // namespace holdfast::io
