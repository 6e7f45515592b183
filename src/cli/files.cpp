#include "files.h"

#include <fmt/core.h>

#include <algorithm>
#include <unordered_map>

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
void append(Surface& whole, const Surface& part, std::unordered_map<Point, Index, PointHash>& known,
            bool vertices_marked) {
  std::vector<Index> index(part.vertices.size());
  const std::size_t before = whole.vertices.size();
  for (std::size_t i = 0; i < index.size(); ++i) {
    const auto found = known.find(part.vertices[i]);
    if (found != known.end()) {
      index[i] = found->second;
    } else {
      index[i] = static_cast<Index>(whole.vertices.size());
      whole.vertices.push_back(part.vertices[i]);
      if (vertices_marked)
        whole.vertex_markers.push_back(part.vertex_markers.empty() ? 0 : part.vertex_markers[i]);
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

Surface read_surfaces(const std::vector<fs::path>& paths, std::string_view format, bool of_volumes) {
  const auto read = [&](const fs::path& path) {
    return of_volumes ? surface_of(read_volume(path, format)) : read_surface(path, format);
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
  std::unordered_map<Point, Index, PointHash> known;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    append(whole, parts[i], known, vertices_marked);
    append_markers(whole.facet_markers, parts[i].facet_markers, parts[i].facets.size(),
                   facets_marked ? 0 : static_cast<int>(i) + 1);
    if (segments_marked)
      append_markers(whole.segment_markers, parts[i].segment_markers, parts[i].segments.size(), 0);
  }
  return whole;
}

}  // namespace holdfast::cli
