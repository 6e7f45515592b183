// Arbitrary bytes as a volume of a solver's format: read, or refused with a FileError; a volume that is read
// is in range, and can be written and read again in a format that holds everything.
//
// The first byte chooses the format, the rest is the file (or files, if a format needs several).
#include <array>

#include "bytes.h"
#include "holdfast/io.h"
#include "same_tetrahedra.h"

namespace {

using namespace holdfast;

constexpr std::array<std::array<const char*, 2>, 17> kFormats{{{".inp"},
                                                               {".unv"},
                                                               {".bdf"},
                                                               {".su2"},
                                                               {".mfem"},
                                                               {".vol"},
                                                               {".vtm"},
                                                               {".msh"},
                                                               {".exo"},
                                                               {".cgns"},
                                                               {".med"},
                                                               {".fluent"},
                                                               {".k"},
                                                               {".cdb"},
                                                               {".feb"},
                                                               {".xml"},
                                                               {".case", ".geo"}}};

bool finite(const std::vector<Point>& points) {
  return std::all_of(points.begin(), points.end(), [](const Point& p) {
    return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
  });
}

template <class Entities>
void require_in_range(const Entities& entities, std::size_t count) {
  for (const auto& entity : entities)
    for (const Index v : entity) fuzz::require(v < count, "an index out of range");
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::Folder folder;
  fuzz::Bytes bytes(data, size);
  const auto& format = kFormats[bytes.below(kFormats.size())];
  folder.empty();
  folder.write_parts(bytes.text(), {format.data(), format[1] == nullptr ? 1u : 2u});
  Volume volume;
  try {
    volume = read_volume(folder / (std::string("a") + format[0]));
  } catch (const FileError&) {
    return 0;
  }
  const std::size_t vertices = volume.vertices.size(), nodes = vertices + volume.mid_nodes.points.size();
  require_in_range(volume.tetrahedra, vertices);
  require_in_range(volume.facets, vertices);
  require_in_range(volume.segments, vertices);
  require_in_range(volume.mid_nodes.tetrahedra, nodes);
  require_in_range(volume.mid_nodes.facets, nodes);
  fuzz::require(volume.mid_nodes.empty() || volume.mid_nodes.facets.size() == volume.facets.size(),
                "mid nodes of another number than facets");
  if (!finite(volume.vertices) || !finite(volume.mid_nodes.points)) return 0;
  write_volume(folder / "copy.vtk", volume, WriteOptions{});
  const Volume copy = read_volume(folder / "copy.vtk");
  fuzz::require(fuzz::same_tetrahedra(copy.tetrahedra, volume.tetrahedra, volume.vertices) &&
                    copy.facets == volume.facets,
                "other entities");
  fuzz::require(copy.names == volume.names, "other names after writing and reading");
  return 0;
}
