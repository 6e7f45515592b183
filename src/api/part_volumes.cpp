#include "api/part_volumes.h"

#include <algorithm>
#include <set>
#include <stdexcept>

#include "io/part_names.h"
#include "numbers/sorted.h"

namespace holdfast {
namespace {

struct FaceOfTet {
  Triangle key;
  Index code;
  bool operator<(const FaceOfTet& other) const {
    return key != other.key ? key < other.key : code < other.code;
  }
};

Boundary boundary_of(const Volume& volume) {
  if (!volume.regions.empty() && volume.regions.size() != volume.tetrahedra.size())
    throw std::invalid_argument("as many region ids as tetrahedra are needed, or none");
  std::vector<FaceOfTet> faces;
  faces.reserve(4 * volume.tetrahedra.size());
  for (Index t = 0; t < volume.tetrahedra.size(); ++t)
    for (Index i = 0; i < 4; ++i) {
      for (const Index v : volume.tetrahedra[t])
        if (v >= volume.vertices.size())
          throw std::invalid_argument("tetrahedron " + std::to_string(t) + " names a vertex that is none");
      faces.push_back({ascending(face_of(volume.tetrahedra[t], i)), 4 * t + i});
    }
  std::sort(faces.begin(), faces.end());
  std::vector<Index> codes;
  for (std::size_t i = 0, j = 0; i < faces.size(); i = j) {
    for (j = i + 1; j < faces.size() && faces[j].key == faces[i].key;) ++j;
    if (j > i + 2)
      throw std::invalid_argument("a face of tetrahedron " + std::to_string(faces[i].code / 4) +
                                  " has more than two tetrahedra");
    if (j == i + 1) codes.push_back(faces[i].code);
  }
  std::sort(codes.begin(), codes.end());
  Boundary boundary;
  for (const Index code : codes) {
    boundary.face.push_back(code);
    boundary.facets.push_back(face_of(volume.tetrahedra[code / 4], code % 4));
    for (const Index v : boundary.facets.back()) boundary.vertices.push_back(v);
  }
  sort_unique(boundary.vertices);
  return boundary;
}

/// Whether some region id differs from the default.
bool has_ids(const Volume& volume) {
  return std::any_of(volume.regions.begin(), volume.regions.end(), [](int id) { return id != 0; });
}

}  // namespace

std::vector<Boundary> boundaries_of(std::span<const Volume> volumes) {
  std::vector<Boundary> boundaries;
  std::size_t tetrahedra = 0;
  for (const Volume& volume : volumes) {
    boundaries.push_back(boundary_of(volume));
    boundaries.back().first_tetrahedron = tetrahedra;
    tetrahedra += volume.tetrahedra.size();
  }
  return boundaries;
}

Surface surface_of(const Volume& volume, const Boundary& boundary) {
  Surface surface;
  std::map<Index, Index> number;
  for (const Index v : boundary.vertices) {
    number[v] = static_cast<Index>(surface.vertices.size());
    surface.vertices.push_back(volume.vertices[v]);
    if (!volume.vertex_markers.empty()) surface.vertex_markers.push_back(volume.vertex_markers[v]);
  }
  std::map<Triangle, int> marker;
  if (!volume.facet_markers.empty())
    for (std::size_t f = 0; f < volume.facets.size(); ++f)
      marker[ascending(volume.facets[f])] = volume.facet_markers[f];
  for (const Triangle& t : boundary.facets) {
    surface.facets.push_back({number[t[0]], number[t[1]], number[t[2]]});
    if (!volume.facet_markers.empty()) {
      const auto found = marker.find(ascending(t));
      surface.facet_markers.push_back(found == marker.end() ? 0 : found->second);
    }
  }
  surface.names.facets = volume.names.facets;
  return surface;
}

void number_regions(std::span<const Volume> volumes, std::span<Boundary> boundaries,
                    std::span<const std::string> part_names, PasteResult& pasted) {
  std::vector<std::map<int, std::string>> of_volumes;
  for (const Volume& volume : volumes) of_volumes.push_back(volume.names.regions);
  of_volumes = io::names_apart(std::move(of_volumes), part_names);
  std::map<int, std::string>& names = pasted.surface.names.regions;
  const std::map<int, std::string> of_parts = std::move(names);
  names.clear();
  std::set<int> taken;
  for (const Volume& volume : volumes)
    if (has_ids(volume)) taken.insert(volume.regions.begin(), volume.regions.end());
  const auto next_free = [&](int wanted) {
    while (!taken.insert(wanted).second) ++wanted;
    return wanted;
  };
  std::map<int, std::string> meaning;
  for (std::size_t k = 0; k < volumes.size(); ++k) {
    const Volume& volume = volumes[k];
    if (!has_ids(volume)) continue;
    for (const int id : std::set<int>(volume.regions.begin(), volume.regions.end())) {
      const auto named = of_volumes[k].find(id);
      const std::string name = named == of_volumes[k].end() ? "" : named->second;
      const auto [there, is_new] = meaning.try_emplace(id, name);
      int number = id;
      if (!is_new && there->second != name) meaning[number = next_free(1)] = name;
      boundaries[k].id_of[id] = number;
    }
  }
  for (std::size_t k = 0; k < volumes.size(); ++k) {
    if (has_ids(volumes[k])) continue;
    const int number = next_free(static_cast<int>(k) + 1);
    boundaries[k].id_of[0] = number;
    const auto named = of_parts.find(pasted.parts[k].id);
    if (named != of_parts.end()) meaning[number] = named->second;
  }
  for (const auto& [id, name] : meaning)
    if (!name.empty()) names[id] = name;
  for (std::size_t k = 0; k < volumes.size(); ++k)
    if (!boundaries[k].id_of.empty()) pasted.parts[k].id = boundaries[k].id_of.begin()->second;
}

}  // namespace holdfast
