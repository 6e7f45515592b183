// Ids of elements in files that have groups of entities: where an entity is in no group, its own tag.
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "io/mesh_data.h"

namespace holdfast::io {

/// The ids that elements get while a file is read, by dimension, and whose they are.
class EntityIds {
 public:
  using Ids = std::array<int, 4>;  ///< by dimension

  /// The elements that the mesh has since the last time have these ids, of their group or of their entity.
  void note(const MeshData& mesh, bool are_of_group, const Ids& ids);

  /// Gives entities whose tag is a group's id the first free number, from 1, and takes away names of groups
  /// without elements where an entity has the number.
  void part(MeshData& mesh) const;

 private:
  struct Kind {
    std::size_t elements = 0;  ///< so far
    int last_group = 0;
    std::set<int> groups;
    std::vector<std::array<std::size_t, 2>> runs;  ///< of elements without a group, ascending
  };
  static void part(const Kind& kind, Tags& tags, std::map<int, std::string>& names, std::string_view what,
                   std::vector<Remark>& remarks);

  std::array<Kind, 4> kinds_;
};

}  // namespace holdfast::io
