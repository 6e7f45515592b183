// The public functions of holdfast/io.h: formats by extension, and what a file must hold.
#include "holdfast/io.h"

#include <algorithm>

#include "io/file_bytes.h"
#include "io/formats.h"
#include "io/text_reader.h"

namespace holdfast {
namespace io {
namespace {

using Reader = MeshData (*)(const Source&);
using Writer = void (*)(AtomicWriter&, const Volume&, const WriteOptions&);

struct Format {
  std::string_view extension;
  Reader read;
  bool surface, volume;  ///< which of the two it may be read as
  Writer write;          ///< null: volumes are not written in it
};

constexpr Format kFormats[] = {
    {".off", read_off, true, false, nullptr},
    {".mesh", read_medit, true, true,
     [](AtomicWriter& out, const Volume& volume, const WriteOptions&) { write_medit(out, volume); }},
    {".vtk", nullptr, false, false,
     [](AtomicWriter& out, const Volume& volume, const WriteOptions&) { write_vtk(out, volume); }},
    {".vtu", nullptr, false, false, write_vtu},
};

/// The format's name as the table spells it: in lower case, with a dot.
std::string extension_of(const std::filesystem::path& path, std::string_view format) {
  std::string extension = lower(format.empty() ? path.extension().string() : std::string(format));
  if (!extension.empty() && extension[0] != '.') extension.insert(0, 1, '.');
  return extension;
}

/// The entry of an extension that `suits`; else throws, with the ones that would do.
template <typename Suits>
const Format& find_format(const std::filesystem::path& path, std::string_view extension, const char* use,
                          Suits&& suits) {
  std::string known;
  for (const Format& format : kFormats) {
    if (!suits(format)) continue;
    if (format.extension == extension) return format;
    known += (known.empty() ? "" : ", ") + std::string(format.extension);
  }
  const std::string name =
      extension.empty() ? "a name without extension" : "the format " + in_quotes(extension);
  throw FileError(path, "", name + " cannot be " + use + "; the formats are " + known);
}

/// A volume whose tags do not match its entities is the caller's mistake.
void require_consistent(const Volume& volume) {
  const auto matches = [](const std::vector<int>& tags, std::size_t count) {
    return tags.empty() || tags.size() == count;
  };
  if (!matches(volume.regions, volume.tetrahedra.size()) ||
      !matches(volume.facet_markers, volume.facets.size()) ||
      !matches(volume.segment_markers, volume.segments.size()))
    throw std::invalid_argument("a volume with regions or markers of another number than their entities");
}

}  // namespace

MeshData parse(const Source& source, std::string_view format) {
  return find_format(source.path, extension_of(source.path, format), "read",
                     [](const Format& f) { return f.read != nullptr; })
      .read(source);
}

}  // namespace io

Surface read_surface(const std::filesystem::path& path, std::string_view format) {
  const io::Format& reader = io::find_format(path, io::extension_of(path, format), "read as a surface",
                                             [](const io::Format& f) { return f.surface; });
  const io::FileBytes bytes(path);
  io::MeshData mesh = reader.read({path, bytes.view()});
  Surface surface;
  surface.facet_markers = mesh.facet_markers.take(mesh.facets.size());
  surface.segment_markers = mesh.segment_markers.take(mesh.segments.size());
  surface.vertices = std::move(mesh.vertices);
  surface.facets = std::move(mesh.facets);
  surface.segments = std::move(mesh.segments);
  surface.regions = std::move(mesh.region_seeds);
  surface.holes = std::move(mesh.holes);
  return surface;
}

Volume read_volume(const std::filesystem::path& path, std::string_view format) {
  const io::Format& reader = io::find_format(path, io::extension_of(path, format), "read as a volume",
                                             [](const io::Format& f) { return f.volume; });
  const io::FileBytes bytes(path);
  io::MeshData mesh = reader.read({path, bytes.view()});
  Volume volume;
  volume.regions = mesh.regions.take(mesh.tetrahedra.size());
  volume.regions.resize(mesh.tetrahedra.size(), 0);
  volume.facet_markers = mesh.facet_markers.take(mesh.facets.size());
  volume.segment_markers = mesh.segment_markers.take(mesh.segments.size());
  volume.vertices = std::move(mesh.vertices);
  volume.tetrahedra = std::move(mesh.tetrahedra);
  volume.facets = std::move(mesh.facets);
  volume.segments = std::move(mesh.segments);
  return volume;
}

void write_volume(const std::filesystem::path& path, const Volume& volume, const WriteOptions& options) {
  const io::Format& writer = io::find_format(path, io::extension_of(path, options.format), "written",
                                             [](const io::Format& f) { return f.write != nullptr; });
  io::require_consistent(volume);
  io::AtomicWriter out(path);
  writer.write(out, volume, options);
  out.commit();
}

}  // namespace holdfast
