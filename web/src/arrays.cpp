#include "arrays.h"

#include <bit>
#include <charconv>
#include <fstream>

namespace holdfast::web {
namespace {

static_assert(std::endian::native == std::endian::little);

std::string path_of(const char* name) { return std::string(kArrays) + name; }

template <typename Row>
std::vector<Row> taken(const char* name) {
  std::ifstream file(path_of(name), std::ios::binary | std::ios::ate);
  if (!file) return {};
  const auto bytes = static_cast<std::size_t>(file.tellg());
  if (bytes % sizeof(Row) != 0)
    throw std::invalid_argument(std::string(name) + ": the last row is not whole");
  std::vector<Row> rows(bytes / sizeof(Row));
  file.seekg(0);
  file.read(reinterpret_cast<char*>(rows.data()), static_cast<std::streamsize>(bytes));
  return rows;
}

template <typename Row>
void put(const char* name, const std::vector<Row>& rows) {
  if (rows.empty()) return;
  std::ofstream file(path_of(name), std::ios::binary);
  file.write(reinterpret_cast<const char*>(rows.data()),
             static_cast<std::streamsize>(rows.size() * sizeof(Row)));
  if (!file.flush()) throw std::bad_alloc();
}

void require_number(std::size_t markers, std::size_t entities, const char* name) {
  if (markers != 0 && markers != entities)
    throw std::invalid_argument(std::string(name) + ": there are " + std::to_string(markers) + " for " +
                                std::to_string(entities));
}

template <std::size_t N>
void require_range(const std::vector<std::array<Index, N>>& rows, std::size_t vertices, const char* name) {
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (const Index v : rows[i])
      if (v >= vertices)
        throw std::invalid_argument(std::string(name) + ", row " + std::to_string(i) +
                                    ": there is no vertex " + std::to_string(v));
}

std::map<int, std::string> names_of(const Json& names, const char* kind) {
  std::map<int, std::string> result;
  if (!names.is_object() || !names.contains(kind)) return result;
  for (const auto& [id, name] : names[kind].items()) {
    int number = 0;
    const auto parsed = std::from_chars(id.data(), id.data() + id.size(), number);
    if (parsed.ec != std::errc() || parsed.ptr != id.data() + id.size() || !name.is_string())
      throw std::invalid_argument(std::string("names: ") + kind + ": texts by integer ids are expected");
    result[number] = name.get<std::string>();
  }
  return result;
}

Names names_of(const Json& request) {
  const auto found = request.find("names");
  if (found == request.end()) return {};
  return {names_of(*found, "facets"), names_of(*found, "regions"), names_of(*found, "segments"),
          names_of(*found, "vertices")};
}

/// What surfaces and volumes have alike.
template <typename Mesh>
void take_common(Mesh& mesh, const Json& request) {
  mesh.vertices = taken<Point>("vertices");
  mesh.facets = taken<Triangle>("triangles");
  mesh.segments = taken<Segment>("segments");
  mesh.facet_markers = taken<int>("triangle_markers");
  mesh.segment_markers = taken<int>("segment_markers");
  mesh.vertex_markers = taken<int>("vertex_markers");
  mesh.names = names_of(request);
}

template <typename Mesh>
void require_whole_common(const Mesh& mesh) {
  require_number(mesh.facet_markers.size(), mesh.facets.size(), "triangle_markers");
  require_number(mesh.segment_markers.size(), mesh.segments.size(), "segment_markers");
  require_number(mesh.vertex_markers.size(), mesh.vertices.size(), "vertex_markers");
  require_range(mesh.facets, mesh.vertices.size(), "triangles");
  require_range(mesh.segments, mesh.vertices.size(), "segments");
}

template <typename Mesh>
void give_common(const Mesh& mesh, Json& response) {
  put("vertices", mesh.vertices);
  put("triangles", mesh.facets);
  put("segments", mesh.segments);
  put("triangle_markers", mesh.facet_markers);
  put("segment_markers", mesh.segment_markers);
  put("vertex_markers", mesh.vertex_markers);
  if (!mesh.names.empty()) response["names"] = reports::to_json(mesh.names);
}

}  // namespace

Surface surface_of_arrays(const Json& request) {
  Surface surface;
  take_common(surface, request);
  if (const auto seeds = request.find("seeds"); seeds != request.end()) {
    surface.holes = points_of(seeds->value("holes", Json::array()), "seeds: holes");
    surface.regions = seeds_of(seeds->value("regions", Json::array()));
  }
  return surface;
}

Volume volume_of_arrays(const Json& request) {
  Volume volume;
  take_common(volume, request);
  volume.tetrahedra = taken<Tetrahedron>("tetrahedra");
  volume.regions = taken<int>("regions");
  for (const int v : taken<int>("input_vertices")) volume.input_vertices.push_back(v);
  require_whole_common(volume);
  require_number(volume.regions.size(), volume.tetrahedra.size(), "regions");
  require_number(volume.input_vertices.size(), volume.vertices.size(), "input_vertices");
  require_range(volume.tetrahedra, volume.vertices.size(), "tetrahedra");
  return volume;
}

void require_whole(const Surface& surface) { require_whole_common(surface); }

void give(const Surface& surface, Json& response) {
  give_common(surface, response);
  if (surface.holes.empty() && surface.regions.empty()) return;
  Json regions = Json::array();
  for (const RegionSeed& seed : surface.regions)
    regions.push_back(
        {{"where", seed.where}, {"id", seed.id}, {"size", seed.size}, {"max_volume", seed.max_volume}});
  response["seeds"] = {{"holes", surface.holes}, {"regions", regions}};
}

void give(const Volume& volume, Json& response) {
  give_common(volume, response);
  put("tetrahedra", volume.tetrahedra);
  put("regions", volume.regions);
  std::vector<int> origins;
  origins.reserve(volume.input_vertices.size());
  for (const std::int64_t v : volume.input_vertices) origins.push_back(static_cast<int>(v));
  put("input_vertices", origins);
}

}  // namespace holdfast::web
