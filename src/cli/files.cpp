#include "files.h"

#include <fmt/core.h>

#include <algorithm>

namespace holdfast::cli {
namespace {

namespace fs = std::filesystem;

/// Appends `part` to `whole`. Vertices at one place are one vertex wherever they come from, so nothing is to
/// be joined here.
void append(Surface& whole, const Surface& part) {
  const std::size_t before = whole.vertices.size();
  const auto shifted = [&](Index vertex) { return static_cast<Index>(before + vertex); };
  whole.vertices.insert(whole.vertices.end(), part.vertices.begin(), part.vertices.end());
  for (const Triangle& f : part.facets) whole.facets.push_back({shifted(f[0]), shifted(f[1]), shifted(f[2])});
  for (const Segment& s : part.segments) whole.segments.push_back({shifted(s[0]), shifted(s[1])});
  whole.regions.insert(whole.regions.end(), part.regions.begin(), part.regions.end());
  whole.holes.insert(whole.holes.end(), part.holes.begin(), part.holes.end());
  whole.remarks.insert(whole.remarks.end(), part.remarks.begin(), part.remarks.end());
}

/// Appends the markers of `part`, or `otherwise` for each of its `count` entities when it has none.
void append_markers(std::vector<int>& whole, const std::vector<int>& part, std::size_t count, int otherwise) {
  if (part.empty())
    whole.insert(whole.end(), count, otherwise);
  else
    whole.insert(whole.end(), part.begin(), part.end());
}

}  // namespace

void tell(const std::vector<Remark>& remarks, const fs::path& file) {
  const std::string name = file.empty() ? "" : file.string() + ": ";
  for (const Remark& remark : remarks) fmt::print(stderr, "holdfast: {}{}\n", name, remark.message);
}

Surface read_surfaces(const std::vector<fs::path>& paths, const ReadOptions& options, bool of_volumes) {
  const auto read = [&](const fs::path& path) {
    return of_volumes ? surface_of(read_volume(path, options)) : read_surface(path, options);
  };

  std::vector<Surface> parts;
  parts.reserve(paths.size());
  for (const fs::path& path : paths) {
    parts.push_back(read(path));
    for (Remark& remark : parts.back().remarks) remark.message = path.string() + ": " + remark.message;
  }
  if (parts.size() == 1) return std::move(parts.front());
  const bool vertices_marked =
      std::any_of(parts.begin(), parts.end(), [](const Surface& s) { return !s.vertex_markers.empty(); });
  const bool facets_marked =
      std::any_of(parts.begin(), parts.end(), [](const Surface& s) { return !s.facet_markers.empty(); });
  const bool segments_marked =
      std::any_of(parts.begin(), parts.end(), [](const Surface& s) { return !s.segment_markers.empty(); });

  Surface whole;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    append(whole, parts[i]);
    if (vertices_marked)
      append_markers(whole.vertex_markers, parts[i].vertex_markers, parts[i].vertices.size(), 0);
    append_markers(whole.facet_markers, parts[i].facet_markers, parts[i].facets.size(),
                   facets_marked ? 0 : static_cast<int>(i) + 1);
    if (segments_marked)
      append_markers(whole.segment_markers, parts[i].segment_markers, parts[i].segments.size(), 0);
  }
  return whole;
}

}  // namespace holdfast::cli
