#include "exact_file.h"

#include <map>

#include "holdfast/io.h"
#include "report.h"

namespace holdfast::cli {

void write_exact(const std::filesystem::path& path, const Result& result) {
  std::map<Index, const ExactVertex*> exact;
  for (const ExactVertex& vertex : result.exact_vertices) exact[vertex.vertex] = &vertex;

  std::string text;
  for (Index i = 0; i < result.volume.vertices.size(); ++i) {
    const auto found = exact.find(i);
    Json coordinates = result.volume.vertices[i];
    if (found != exact.end()) coordinates = found->second->coordinates;
    text += Json{{"vertex", i}, {"coordinates", coordinates}}.dump() + "\n";
  }
  for (std::size_t i = 0; i < result.volume.tetrahedra.size(); ++i) {
    Json line = {{"tetrahedron", result.volume.tetrahedra[i]}};
    if (i < result.volume.regions.size()) line["region"] = result.volume.regions[i];
    text += line.dump() + "\n";
  }
  write_bytes(path, text);
}

}  // namespace holdfast::cli
