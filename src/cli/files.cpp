#include "files.h"

#include <fmt/core.h>

#include <algorithm>
#include <iterator>
#include <string>

namespace holdfast::cli {
namespace {

namespace fs = std::filesystem;

/// The file's name without folder and extensions.
std::string stem(const fs::path& path) {
  fs::path name = path.filename();
  if (name.extension() == ".gz") name = name.stem();
  return name.stem().string();
}

}  // namespace

void tell(const std::vector<Remark>& remarks, const fs::path& file) {
  const std::string name = file.empty() ? "" : file.string() + ": ";
  for (const Remark& remark : remarks) fmt::print(stderr, "holdfast: {}{}\n", name, remark.message);
}

std::vector<Surface> read_parts(const std::vector<fs::path>& paths, const ReadOptions& options,
                                bool of_volumes) {
  const auto read = [&](const fs::path& path) {
    return of_volumes ? surface_of(read_volume(path, options)) : read_surface(path, options);
  };

  std::vector<Surface> parts;
  parts.reserve(paths.size());
  for (const fs::path& path : paths) {
    parts.push_back(read(path));
    for (Remark& remark : parts.back().remarks) remark.message = path.string() + ": " + remark.message;
  }
  return parts;
}

bool is_one_of(const std::vector<std::string>& formats, const std::string& format) {
  return std::find(formats.begin(), formats.end(), format) != formats.end();
}

std::vector<std::string> stems(const std::vector<fs::path>& paths) {
  std::vector<std::string> names;
  std::transform(paths.begin(), paths.end(), std::back_inserter(names), stem);
  return names;
}

Surface read_surfaces(const std::vector<fs::path>& paths, const ReadOptions& options, bool of_volumes) {
  std::vector<Surface> parts = read_parts(paths, options, of_volumes);
  if (parts.size() == 1) return std::move(parts.front());
  return join(parts, stems(paths));
}

}  // namespace holdfast::cli
