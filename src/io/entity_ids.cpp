// Ids of elements in files that have groups of entities.
#include "io/entity_ids.h"

#include <utility>

namespace holdfast::io {

void EntityIds::note(const MeshData& mesh, bool are_of_group, const Ids& ids) {
  const std::array now{std::size_t{0}, mesh.segments.size(), mesh.facets.size(), mesh.tetrahedra.size()};
  for (std::size_t d = 1; d < now.size(); ++d) {
    Kind& kind = kinds_[d];
    const std::size_t before = std::exchange(kind.elements, now[d]);
    if (before == now[d]) continue;
    if (are_of_group) {
      if (kind.groups.empty() || kind.last_group != ids[d]) kind.groups.insert(ids[d]);
      kind.last_group = ids[d];
    } else if (!kind.runs.empty() && kind.runs.back()[1] == before) {
      kind.runs.back()[1] = now[d];
    } else {
      kind.runs.push_back({before, now[d]});
    }
  }
}

void EntityIds::part(MeshData& mesh) const {
  part(kinds_[1], mesh.segment_markers, mesh.names.segments, "segments", mesh.remarks);
  part(kinds_[2], mesh.facet_markers, mesh.names.facets, "triangles", mesh.remarks);
  part(kinds_[3], mesh.regions, mesh.names.regions, "tetrahedra", mesh.remarks);
}

void EntityIds::part(const Kind& kind, Tags& tags, std::map<int, std::string>& names, std::string_view what,
                     std::vector<Remark>& remarks) {
  std::set<int> own;
  for (const auto& [first, last] : kind.runs)
    for (std::size_t i = first; i < last; ++i)
      if (own.empty() || i == first || tags.of(i) != tags.of(i - 1)) own.insert(tags.of(i));
  std::set<int> used = kind.groups;
  used.insert(own.begin(), own.end());
  for (const auto& [id, name] : names) used.insert(id);
  std::map<int, int> number;
  for (const int id : own) {
    if (!kind.groups.contains(id)) {
      if (names.erase(id) > 0)
        remarks.push_back({RemarkKind::left_out, 1,
                           "the name of the group " + std::to_string(id) + ", which has no " +
                               std::string(what) + ", is left out"});
      continue;
    }
    int fresh = 1;
    while (used.contains(fresh)) ++fresh;
    used.insert(fresh);
    number[id] = fresh;
    remarks.push_back({RemarkKind::renumbered, 1,
                       "the " + std::string(what) + " of the entity " + std::to_string(id) +
                           ", which is in no group, get the id " + std::to_string(fresh) +
                           ", since a group is " + std::to_string(id)});
  }
  if (number.empty()) return;
  for (const auto& [first, last] : kind.runs)
    for (std::size_t i = first; i < last; ++i)
      if (const auto found = number.find(tags.of(i)); found != number.end()) tags.set(i, found->second);
}

}  // namespace holdfast::io
