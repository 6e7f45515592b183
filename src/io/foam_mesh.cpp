#include "io/foam_mesh.h"

#include <algorithm>
#include <stdexcept>

#include "io/mesh_sets.h"
#include "numbers/sorted.h"

namespace holdfast::io {
namespace {

struct Side {
  Triangle key;
  Index cell;
  std::uint8_t side;
};

std::vector<Side> sorted_sides(const Volume& volume, Watch& watch) {
  std::vector<Side> sides;
  sides.reserve(4 * volume.tetrahedra.size());
  for (Index t = 0; t < volume.tetrahedra.size(); ++t)
    for (std::uint8_t i = 0; i < 4; ++i) {
      watch.beat();
      sides.push_back({ascending(outward_face(volume.tetrahedra[t], i)), t, i});
    }
  std::sort(sides.begin(), sides.end(), [&](const Side& a, const Side& b) {
    watch.beat();
    return a.key != b.key ? a.key < b.key : a.cell < b.cell;
  });
  return sides;
}

/// Finds the inner and boundary faces with their facets.
void find_faces(const Volume& volume, FoamMesh& mesh, Watch& watch) {
  std::map<Triangle, Index> facet_at;
  for (Index f = 0; f < volume.facets.size(); ++f) facet_at.emplace(ascending(volume.facets[f]), f);
  const std::vector<Side> sides = sorted_sides(volume, watch);
  for (std::size_t i = 0, j = 0; i < sides.size(); i = j) {
    watch.beat();
    for (j = i; j < sides.size() && sides[j].key == sides[i].key;) ++j;
    if (j > i + 2)
      throw std::invalid_argument("a face of more than two tetrahedra, which OpenFOAM has no place for");
    FoamFace face{outward_face(volume.tetrahedra[sides[i].cell], sides[i].side), sides[i].cell, no_entity,
                  no_entity};
    if (j == i + 2) face.neighbour = sides[i + 1].cell;
    if (const auto found = facet_at.find(sides[i].key); found != facet_at.end()) face.facet = found->second;
    (j == i + 2 ? mesh.inside : mesh.boundary).push_back(face);
  }
  std::sort(mesh.inside.begin(), mesh.inside.end(), [&](const FoamFace& a, const FoamFace& b) {
    watch.beat();
    return a.owner != b.owner ? a.owner < b.owner : a.neighbour < b.neighbour;
  });
}

bool has_facet(const FoamFace& face) { return face.facet != no_entity; }

/// Sorts faces by patch: first those on facets, by id, then the others.
void sort_boundary(FoamMesh& mesh) {
  const auto id_of = [&](const FoamFace& face) { return mesh.facets.ids[face.facet]; };
  std::sort(mesh.boundary.begin(), mesh.boundary.end(), [&](const FoamFace& a, const FoamFace& b) {
    if (has_facet(a) != has_facet(b)) return has_facet(a);
    if (has_facet(a) && id_of(a) != id_of(b)) return id_of(a) < id_of(b);
    return a.owner != b.owner ? a.owner < b.owner : a.corners < b.corners;
  });
}

/// The name of the patch without facets: OpenFOAM's own, or a free one like it.
std::string name_of_rest(const Labels& facets) {
  std::set<std::string> taken;
  for (const auto& [id, name] : facets.names) taken.insert(name);
  std::string rest = "defaultFaces";
  while (taken.contains(rest)) rest += '_';
  return rest;
}

void make_patches(FoamMesh& mesh) {
  const auto id_of = [&](const FoamFace& face) { return mesh.facets.ids[face.facet]; };
  sort_boundary(mesh);
  const std::string rest = name_of_rest(mesh.facets);
  for (std::size_t i = 0, j = 0; i < mesh.boundary.size(); i = j) {
    const bool named = has_facet(mesh.boundary[i]);
    for (j = i; j < mesh.boundary.size() && has_facet(mesh.boundary[j]) == named &&
                (!named || id_of(mesh.boundary[j]) == id_of(mesh.boundary[i]));)
      ++j;
    mesh.patches.push_back({named ? mesh.facets.names.at(id_of(mesh.boundary[i])) : rest, i, j - i});
  }
}

void make_zones(FoamMesh& mesh) {
  for (std::size_t i = 0; i < mesh.inside.size(); ++i)
    if (has_facet(mesh.inside[i])) mesh.zones[mesh.facets.ids[mesh.inside[i].facet]].push_back(i);
}

// --- Pieces

/// The position of a face among those between pieces.
using PlaceOnInterface = std::map<Triangle, std::pair<std::size_t, std::size_t>>;

PlaceOnInterface places_on_interfaces(const MeshPiece& piece) {
  PlaceOnInterface places;
  for (std::size_t i = 0; i < piece.interfaces.size(); ++i)
    for (std::size_t k = 0; k < piece.interfaces[i].faces.size(); ++k)
      places[ascending(piece.interfaces[i].faces[k])] = {i, k};
  return places;
}

/// Moves the faces between pieces out of the boundary, in their common order on both sides.
std::vector<std::vector<FoamFace>> take_interfaces(FoamMesh& mesh, const MeshPiece& piece) {
  const PlaceOnInterface places = places_on_interfaces(piece);
  std::vector<std::vector<FoamFace>> between;
  for (const MeshPiece::Interface& interface : piece.interfaces) between.emplace_back(interface.faces.size());
  std::erase_if(mesh.boundary, [&](FoamFace& face) {
    const auto found = places.find(ascending(face.corners));
    if (found == places.end()) return false;
    const auto [i, k] = found->second;
    face.corners = piece.interfaces[i].faces[k];
    between[i][k] = face;
    return true;
  });
  return between;
}

void make_patches_of_piece(FoamMesh& mesh, const FoamNames& names) {
  sort_boundary(mesh);
  std::size_t i = 0;
  const auto add = [&](const std::string& name, auto&& belongs) {
    std::size_t j = i;
    while (j < mesh.boundary.size() && belongs(mesh.boundary[j])) ++j;
    mesh.patches.push_back({name, i, j - i});
    i = j;
  };
  for (const int id : names.patches)
    add(mesh.facets.names.at(id),
        [&](const FoamFace& face) { return has_facet(face) && mesh.facets.ids[face.facet] == id; });
  if (names.has_rest) add(name_of_rest(mesh.facets), [](const FoamFace&) { return true; });
}

/// One id per facet or tetrahedron, 0 if there are no tags.
std::vector<int> ids_of(const std::vector<int>& tags, std::size_t count) {
  std::vector<int> ids = tags;
  ids.resize(count, 0);
  return ids;
}

}  // namespace

FoamMesh foam_mesh(const Volume& volume, Watch& watch) {
  FoamMesh mesh;
  mesh.regions = labels_of(kRegionStem, volume.regions, volume.tetrahedra.size(), volume.names.regions,
                           kFoamNames, kFoamIds);
  mesh.facets = labels_of(kFacetStem, volume.facet_markers, volume.facets.size(), volume.names.facets,
                          kFoamNames, kFoamIds);
  find_faces(volume, mesh, watch);
  make_patches(mesh);
  make_zones(mesh);
  return mesh;
}

Volume own_volume(const MeshPiece& piece) {
  const auto first = [](const auto& all, std::size_t count) {
    return std::decay_t<decltype(all)>(
        all.begin(), all.begin() + static_cast<std::ptrdiff_t>(std::min(count, all.size())));
  };
  Volume own;
  own.vertices = first(piece.volume.vertices, piece.own_vertices);
  own.tetrahedra = first(piece.volume.tetrahedra, piece.own_tetrahedra);
  own.regions = first(piece.volume.regions, piece.own_tetrahedra);
  own.facets = piece.volume.facets;
  own.facet_markers = piece.volume.facet_markers;
  own.names = piece.volume.names;
  return own;
}

void FoamNamesOfPieces::add(const Volume& own, const MeshPiece& piece, Watch& watch) {
  FoamMesh mesh;
  find_faces(own, mesh, watch);
  const std::vector<int> facets = ids_of(own.facet_markers, own.facets.size());
  const std::vector<int> regions = ids_of(own.regions, own.tetrahedra.size());
  regions_.insert(regions.begin(), regions.end());
  facets_.insert(facets.begin(), facets.end());
  for (const auto& faces : take_interfaces(mesh, piece))
    mesh.inside.insert(mesh.inside.end(), faces.begin(), faces.end());
  for (const FoamFace& face : mesh.inside)
    if (has_facet(face)) zones_.insert(facets[face.facet]);
  for (const FoamFace& face : mesh.boundary) {
    if (has_facet(face))
      patches_.insert(facets[face.facet]);
    else
      has_rest_ = true;
  }
  names_ = own.names;
}

FoamNames FoamNamesOfPieces::take() {
  FoamNames names;
  const auto labels = [](std::string_view stem, const std::set<int>& ids,
                         const std::map<int, std::string>& of) {
    return labels_of(stem, std::vector<int>(ids.begin(), ids.end()), ids.size(), of, kFoamNames, kFoamIds);
  };
  names.regions = labels(kRegionStem, regions_, names_.regions);
  names.facets = labels(kFacetStem, facets_, names_.facets);
  names.patches = std::move(patches_);
  names.zones = std::move(zones_);
  names.has_rest = has_rest_;
  return names;
}

FoamMesh foam_mesh(const Volume& own, const MeshPiece& piece, const FoamNames& names, Watch& watch) {
  FoamMesh mesh;
  mesh.regions = names.regions;
  mesh.regions.ids = ids_of(own.regions, own.tetrahedra.size());
  mesh.facets = names.facets;
  mesh.facets.ids = ids_of(own.facet_markers, own.facets.size());
  find_faces(own, mesh, watch);
  const std::vector<std::vector<FoamFace>> between = take_interfaces(mesh, piece);
  make_patches_of_piece(mesh, names);
  for (const int id : names.zones) mesh.zones[id];
  make_zones(mesh);
  for (std::size_t i = 0; i < between.size(); ++i) {
    mesh.patches.push_back({{}, mesh.boundary.size(), between[i].size(), piece.interfaces[i].other});
    for (const FoamFace& face : between[i]) {
      if (has_facet(face))
        mesh.zones[mesh.facets.ids[face.facet]].push_back(mesh.inside.size() + mesh.boundary.size());
      mesh.boundary.push_back(face);
    }
  }
  return mesh;
}

}  // namespace holdfast::io
