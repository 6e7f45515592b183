#include "any_mesh.h"

#include <algorithm>
#include <system_error>

#include "files.h"
#include "holdfast/surface_io.h"

namespace holdfast::cli {
namespace {

namespace fs = std::filesystem;

/// The format's name with its dot, in lower case.
std::string format_of(const fs::path& path, const std::string& format) {
  return volume_format_of(path.extension() == ".gz" ? path.parent_path() / path.stem() : path, format);
}

bool can_be_read_again(const fs::path& path) {
  std::error_code error;
  return !descriptor_of(path) && fs::is_regular_file(path, error);
}

Surface surface_in(Volume&& volume) {
  Surface surface;
  surface.vertices = std::move(volume.vertices);
  surface.facets = std::move(volume.facets);
  surface.segments = std::move(volume.segments);
  surface.facet_markers = std::move(volume.facet_markers);
  surface.segment_markers = std::move(volume.segment_markers);
  surface.vertex_markers = std::move(volume.vertex_markers);
  surface.names = std::move(volume.names);
  return surface;
}

}  // namespace

bool may_be_volume(const fs::path& path, const std::string& format) {
  const std::string kind = format_of(path, format);
  if (!is_one_of(readable_volume_formats(), kind)) return false;
  if (kind != ".node") return true;
  const std::vector<fs::path> files = files_of_volume(path, format);
  return std::any_of(files.begin(), files.end(), [](const fs::path& file) {
    std::error_code error;
    return format_of(file, {}) == ".ele" && fs::exists(file, error);
  });
}

void read_any(FilesOfRun& files, const fs::path& path, const std::string& format) {
  if (may_be_volume(path, format))
    files.read_volume(path, format);
  else
    files.read_surfaces({path}, format);
}

AnyMesh read_any(const fs::path& path, const ReadOptions& options) {
  AnyMesh mesh;
  if (may_be_volume(path, options.format)) {
    mesh.volume = read_volume(path, options, &mesh.remarks);
    mesh.is_volume = !mesh.volume.tetrahedra.empty();
    if (mesh.is_volume) return mesh;
    if (!can_be_read_again(path)) {
      mesh.surface = surface_in(std::move(mesh.volume));
      return mesh;
    }
  }
  mesh.surface = read_surface(path, options);
  mesh.remarks = mesh.surface.remarks;
  return mesh;
}

AnyTarget write_any(FilesOfRun& files, const char* option, const fs::path& path, const std::string& format) {
  const std::string kind = format_of(path, format);
  AnyTarget target;
  target.holds_surfaces = is_one_of(surface_formats(), kind);
  // A format known neither for surfaces nor for volumes is refused as a volume format, which lists those
  // known.
  target.holds_volumes = !target.holds_surfaces || is_one_of(volume_formats(), kind);
  target.options = target.holds_volumes ? files.write_volume(option, path, format, true).options
                                        : files.write_surface(option, path, format);
  return target;
}

}  // namespace holdfast::cli
