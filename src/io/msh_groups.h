// The physical groups of a .msh file. An element of Holdfast has one group: the first of several counts, and
// the others are reported.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "io/mesh_data.h"
#include "io/msh_numbers.h"
#include "io/msh_types.h"

namespace holdfast::io {

class MshGroups {
 public:
  using Entity = std::pair<std::size_t, std::int64_t>;  ///< dimension and tag

  /// Records that an entity of version 3 or 4 is in this group.
  void note(const Entity& entity, int group) {
    if (!first_.try_emplace(entity, group).second) further_.insert({entity.first, group});
  }
  /// The group of an entity, or 0 if it is in none.
  [[nodiscard]] int of(const Entity& entity) const {
    const auto found = first_.find(entity);
    return found == first_.end() ? 0 : found->second;
  }

  /// Before version 3, Gmsh writes an element of several groups once for each group, in succession. Whether
  /// the element whose nodes follow is the previous one in a further group; if so, its nodes are read.
  bool is_one_before(MshNumbers& in, std::int64_t type, int group, int entity) {
    const Element before = std::exchange(last_, {type, group, entity, in.text().position()});
    if (type != before.type || entity != before.entity || group == before.group) return false;
    const std::optional<MshKind> kind = kind_of(type);
    if (!kind) return false;
    const std::vector<std::int64_t> now = nodes_at(in, last_.nodes, kind->nodes);
    const std::size_t end = in.text().position();
    const bool is_same = now == nodes_at(in, before.nodes, kind->nodes);
    in.text().seek(is_same ? end : last_.nodes);
    if (is_same) further_.insert({kind->dimension, group});
    return is_same;
  }

  void tell(MeshData& mesh) const {
    mesh.leave_out(further_.size(), "physical groups of entities that are in one before",
                   "physical group of entities that are in one before");
  }

 private:
  [[nodiscard]] static std::vector<std::int64_t> nodes_at(MshNumbers& in, std::size_t position,
                                                          std::size_t count) {
    in.text().seek(position);
    std::vector<std::int64_t> nodes(count);
    for (std::int64_t& node : nodes) node = in.integer("a node tag");
    return nodes;
  }

  struct Element {
    std::int64_t type = 0;  // of none
    int group = 0, entity = 0;
    std::size_t nodes = 0;  // their position
  };

  std::map<Entity, int> first_;
  std::set<std::pair<std::size_t, int>> further_;  // by dimension
  Element last_;
};

}  // namespace holdfast::io
