// Joins several surfaces: indices are shifted, and markers with different names stay distinct.
#include <algorithm>
#include <limits>
#include <set>

#include "holdfast/io.h"
#include "io/mesh_data.h"
#include "io/part_names.h"

namespace holdfast {
namespace {

using NamesOfIds = std::map<int, std::string>;

std::string name_of(const NamesOfIds& names, int id) {
  const auto found = names.find(id);
  return found == names.end() ? std::string() : found->second;
}

/// Gives the markers of one kind of entity numbers that mean the same in all parts.
class MarkersInTurn {
 public:
  /// Ids used by any part are never given to something else.
  void reserve(const std::vector<int>& markers) { used_.insert(markers.begin(), markers.end()); }

  [[nodiscard]] int next_free() {
    int id = used_.empty() ? 0 : std::max(0, *used_.rbegin());
    if (id == std::numeric_limits<int>::max())  // use the first gap instead
      for (id = 0; used_.contains(id + 1);) ++id;
    used_.insert(id + 1);
    return id + 1;
  }

  /// The number of a part's marker `id` with this name: `id` itself, unless an earlier part has another name
  /// for it.
  int number(int id, const std::string& name, std::vector<Remark>& remarks) {
    if (id == 0 && name.empty()) return 0;
    const auto [there, fresh] = meaning_.try_emplace(id, name);
    if (fresh || there->second == name) return id;
    const int number = next_free();
    meaning_[number] = name;
    remarks.push_back({RemarkKind::renumbered, 1,
                       "marker " + std::to_string(id) + (name.empty() ? "" : " (" + name + ")") + " is " +
                           std::to_string(number) + ", since an earlier file has another " +
                           std::to_string(id)});
    return number;
  }

  void name(int id, const std::string& name) { meaning_[id] = name; }

  [[nodiscard]] NamesOfIds take_names() {
    std::erase_if(meaning_, [](const auto& entry) { return entry.second.empty(); });
    return std::move(meaning_);
  }

 private:
  std::set<int> used_;
  NamesOfIds meaning_;
};

/// Appends the markers of a part's `count` entities, renumbered for the whole.
void append(std::vector<int>& whole, const std::vector<int>& part, std::size_t count, const NamesOfIds& names,
            MarkersInTurn& numbers, std::vector<Remark>& remarks) {
  std::map<int, int> number_of;
  const auto number = [&](int id) {
    const auto [there, fresh] = number_of.try_emplace(id, 0);
    if (fresh) there->second = numbers.number(id, name_of(names, id), remarks);
    return there->second;
  };
  for (std::size_t i = 0; i < count; ++i) whole.push_back(number(io::tag_of(part, i)));
}

void append_geometry(Surface& whole, const Surface& part) {
  const std::size_t before = whole.vertices.size();
  const auto shifted = [&](Index vertex) { return static_cast<Index>(before + vertex); };
  whole.vertices.insert(whole.vertices.end(), part.vertices.begin(), part.vertices.end());
  for (const Triangle& f : part.facets) whole.facets.push_back({shifted(f[0]), shifted(f[1]), shifted(f[2])});
  for (const Segment& s : part.segments) whole.segments.push_back({shifted(s[0]), shifted(s[1])});
  whole.regions.insert(whole.regions.end(), part.regions.begin(), part.regions.end());
  whole.holes.insert(whole.holes.end(), part.holes.begin(), part.holes.end());
  whole.remarks.insert(whole.remarks.end(), part.remarks.begin(), part.remarks.end());
}

}  // namespace

Surface join(std::span<const Surface> parts, std::span<const std::string> names) {
  const auto any = [&](auto has) { return std::any_of(parts.begin(), parts.end(), has); };
  const bool vertices_marked = any([](const Surface& s) { return !s.vertex_markers.empty(); });
  const bool segments_marked = any([](const Surface& s) { return !s.segment_markers.empty(); });
  MarkersInTurn facets, segments, vertices;
  for (const Surface& part : parts) {
    facets.reserve(part.facet_markers);
    segments.reserve(part.segment_markers);
    vertices.reserve(part.vertex_markers);
  }
  const auto names_of = [&](NamesOfIds Names::*kind) {
    std::vector<NamesOfIds> of_parts;
    for (const Surface& part : parts) of_parts.push_back(part.names.*kind);
    return io::names_apart(std::move(of_parts), names);
  };
  const std::vector<NamesOfIds> of_facets = names_of(&Names::facets),
                                of_segments = names_of(&Names::segments),
                                of_vertices = names_of(&Names::vertices);
  Surface whole;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const Surface& part = parts[i];
    append_geometry(whole, part);
    if (part.facet_markers.empty() && !part.facets.empty()) {
      const int marker = facets.next_free();
      whole.facet_markers.insert(whole.facet_markers.end(), part.facets.size(), marker);
      facets.name(marker, i < names.size() ? names[i] : name_of(part.names.facets, 0));
    } else {
      append(whole.facet_markers, part.facet_markers, part.facets.size(), of_facets[i], facets,
             whole.remarks);
    }
    if (segments_marked)
      append(whole.segment_markers, part.segment_markers, part.segments.size(), of_segments[i], segments,
             whole.remarks);
    if (vertices_marked)
      append(whole.vertex_markers, part.vertex_markers, part.vertices.size(), of_vertices[i], vertices,
             whole.remarks);
    whole.names.regions.insert(part.names.regions.begin(), part.names.regions.end());
  }
  whole.names.facets = facets.take_names();
  whole.names.segments = segments.take_names();
  whole.names.vertices = vertices.take_names();
  return whole;
}

}  // namespace holdfast
