#include "files.h"

#include <fmt/core.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>
#include <unordered_map>

#include "command.h"

namespace holdfast::cli {
namespace {

namespace fs = std::filesystem;

struct PointHash {
  std::size_t operator()(const Point& point) const {
    std::size_t hash = 0;
    for (const double x : point) hash = hash * 0x9E3779B97F4A7C15u + std::hash<double>{}(x);
    return hash;
  }
};

/// Appends `part` to `whole`; `known` maps the coordinates of earlier files to their vertices.
void append(Surface& whole, const Surface& part, std::unordered_map<Point, Index, PointHash>& known) {
  std::vector<Index> index(part.vertices.size());
  const std::size_t before = whole.vertices.size();
  for (std::size_t i = 0; i < index.size(); ++i) {
    const auto found = known.find(part.vertices[i]);
    if (found != known.end()) {
      index[i] = found->second;
    } else {
      index[i] = static_cast<Index>(whole.vertices.size());
      whole.vertices.push_back(part.vertices[i]);
    }
  }
  // Only now: identical vertices within one file are that file's own defect, which `diagnose` reports.
  for (std::size_t i = before; i < whole.vertices.size(); ++i)
    known.emplace(whole.vertices[i], static_cast<Index>(i));

  // An index that names no vertex must stay wrong after the shift.
  const auto shifted = [&](Index vertex) { return vertex < index.size() ? index[vertex] : ~Index{0}; };
  for (const Triangle& f : part.facets) whole.facets.push_back({shifted(f[0]), shifted(f[1]), shifted(f[2])});
  for (const Segment& s : part.segments) whole.segments.push_back({shifted(s[0]), shifted(s[1])});
  whole.regions.insert(whole.regions.end(), part.regions.begin(), part.regions.end());
  whole.holes.insert(whole.holes.end(), part.holes.begin(), part.holes.end());
}

/// Appends the markers of `part`, or `otherwise` for each of its `count` entities when it has none.
void append_markers(std::vector<int>& whole, const std::vector<int>& part, std::size_t count, int otherwise) {
  if (part.empty())
    whole.insert(whole.end(), count, otherwise);
  else
    whole.insert(whole.end(), part.begin(), part.end());
}

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

}  // namespace

Surface read_surfaces(const std::vector<fs::path>& paths, std::string_view format) {
  if (paths.size() == 1) return read_surface(paths.front(), format);

  std::vector<Surface> parts;
  parts.reserve(paths.size());
  for (const fs::path& path : paths) parts.push_back(read_surface(path, format));
  const bool facets_marked =
      std::any_of(parts.begin(), parts.end(), [](const Surface& s) { return !s.facet_markers.empty(); });
  const bool segments_marked =
      std::any_of(parts.begin(), parts.end(), [](const Surface& s) { return !s.segment_markers.empty(); });

  Surface whole;
  std::unordered_map<Point, Index, PointHash> known;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    append(whole, parts[i], known);
    append_markers(whole.facet_markers, parts[i].facet_markers, parts[i].facets.size(),
                   facets_marked ? 0 : static_cast<int>(i) + 1);
    if (segments_marked)
      append_markers(whole.segment_markers, parts[i].segment_markers, parts[i].segments.size(), 0);
  }
  return whole;
}

VolumeTarget volume_target(const fs::path& path, std::string format, const std::vector<fs::path>& inputs) {
  VolumeTarget target{path, {}};
  if (!format.empty() && format.front() != '.') format.insert(format.begin(), '.');
  target.options.format = lower(format);
  if (target.options.format == ".msh2") {
    target.options.format = ".msh";
    target.options.legacy_msh = true;
  }
  const std::string kind =
      target.options.format.empty() ? lower(path.extension().string()) : target.options.format;
  const std::vector<std::string> known = volume_formats();
  if (std::find(known.begin(), known.end(), kind) == known.end())
    throw UsageError(
        fmt::format("{}: '{}' is no volume format; use {} (--format msh2 for version 2.2 of .msh) as the "
                    "file's ending or by --format",
                    path.string(), kind, fmt::join(known, " ")));
  for (const fs::path& input : inputs) {
    std::error_code ignored;
    if (fs::equivalent(path, input, ignored))
      throw UsageError(
          fmt::format("{}: the output would overwrite an input; give another name to -o", path.string()));
  }
  require_writable(path);
  return target;
}

void require_writable(const fs::path& path) {
  if (path.empty()) return;
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored))
    throw FileError(path, "", fmt::format("there is no folder '{}'; create it first", folder.string()));
  if (fs::is_directory(path, ignored)) throw FileError(path, "", "is a folder; name a file in it");
  if (access(folder.c_str(), W_OK) != 0)
    throw FileError(path, "",
                    fmt::format("cannot write to folder '{}' ({}); choose another or change its permissions",
                                folder.string(), std::strerror(errno)));
}

void write_text(const fs::path& path, std::string_view text) {
  fs::path beside = path;
  beside += fmt::format(".{}.part", getpid());
  std::error_code failure;
  {
    std::ofstream file(beside, std::ios::binary);
    file.write(text.data(), static_cast<std::streamsize>(text.size()));
    file.close();
    if (!file) failure = std::error_code(errno, std::generic_category());
  }
  if (!failure) fs::rename(beside, path, failure);
  if (failure) {
    std::error_code ignored;
    fs::remove(beside, ignored);
    throw FileError(path, "", fmt::format("cannot be written ({})", failure.message()));
  }
}

}  // namespace holdfast::cli
