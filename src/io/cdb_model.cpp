#include "io/cdb_model.h"

#include <algorithm>
#include <limits>

namespace holdfast::io {
namespace {

/// Numbers with the positions of what they belong to, in ascending order.
using Sorted = std::vector<std::pair<std::int64_t, std::size_t>>;

template <typename Things, typename Number>
Sorted sorted_by_number(const Things& things, Number&& number) {
  Sorted sorted;
  for (std::size_t i = 0; i < things.size(); ++i) sorted.emplace_back(number(things[i]), i);
  std::sort(sorted.begin(), sorted.end());
  return sorted;
}

/// The positions of the members of a component, each once: ranges may be long and overlap.
std::vector<std::size_t> members_of(const CdbComponent& component, const Sorted& sorted) {
  std::vector<std::pair<std::int64_t, std::int64_t>> ranges;
  for (const std::int64_t member : component.members) {
    if (member == std::numeric_limits<std::int64_t>::min()) continue;  // which has no opposite
    if (member < 0 && !ranges.empty())
      ranges.back().second = -member;
    else
      ranges.emplace_back(member, member);
  }
  std::sort(ranges.begin(), ranges.end());
  std::vector<std::size_t> members;
  auto next = sorted.begin();
  for (const auto& [first, last] : ranges) {
    next = std::lower_bound(next, sorted.end(), first,
                            [](const auto& entry, std::int64_t n) { return entry.first < n; });
    for (; next != sorted.end() && next->first <= last; ++next) members.push_back(next->second);
  }
  return members;
}

using Key = std::pair<CdbShape, int>;  // shape and material

Key key_of(const CdbElement& element) { return {element.shape, element.material}; }

}  // namespace

std::vector<int> ids_of_elements(const CdbModel& model, CdbIds& ids, std::size_t& overlaps) {
  const Sorted sorted =
      sorted_by_number(model.elements, [](const CdbElement& element) { return element.number; });
  std::map<Key, std::size_t> sizes;
  for (const CdbElement& element : model.elements)
    if (element.shape != CdbShape::other) ++sizes[key_of(element)];
  std::map<Key, std::string> names;
  std::vector<std::pair<std::string, std::vector<std::size_t>>> others;
  for (const CdbComponent& component : model.components) {
    if (component.of_nodes) continue;
    std::vector<std::size_t> members = members_of(component, sorted);
    std::erase_if(members, [&](std::size_t e) { return model.elements[e].shape == CdbShape::other; });
    if (members.empty()) continue;
    const Key key = key_of(model.elements[members[0]]);
    const bool is_whole = members.size() == sizes[key] &&
                          std::all_of(members.begin(), members.end(),
                                      [&](std::size_t e) { return key_of(model.elements[e]) == key; });
    if (!is_whole || !names.emplace(key, component.name).second)
      others.emplace_back(component.name, std::move(members));
  }
  const auto of = [&](CdbShape shape) -> NamedIds& { return ids[static_cast<std::size_t>(shape)]; };
  for (const auto& [key, size] : sizes) of(key.first).set(key.second, names.contains(key) ? names[key] : "");
  std::vector<int> result;
  for (const CdbElement& element : model.elements)
    result.push_back(element.shape == CdbShape::other ? 0 : of(element.shape).resolve(element.material));
  std::stable_sort(others.begin(), others.end(),
                   [](const auto& a, const auto& b) { return a.second.size() > b.second.size(); });
  std::vector<bool> has_component(model.elements.size(), false);
  for (const auto& [name, members] : others)
    for (const std::size_t e : members) {
      overlaps += has_component[e] ? 1 : 0;
      has_component[e] = true;
      result[e] = of(model.elements[e].shape).id_of(name);
    }
  return result;
}

std::vector<std::vector<Index>> vertices_of_components(const CdbModel& model) {
  const Sorted sorted = sorted_by_number(model.node_numbers, [](std::int64_t number) { return number; });
  std::vector<std::vector<Index>> result;
  for (const CdbComponent& component : model.components) {
    std::vector<Index>& vertices = result.emplace_back();
    if (!component.of_nodes) continue;
    for (const std::size_t v : members_of(component, sorted)) vertices.push_back(static_cast<Index>(v));
  }
  return result;
}

}  // namespace holdfast::io
