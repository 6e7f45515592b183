// Ids of elements in files with groups of entities: an element without a group has the tag of its entity.
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

/// The ids that elements get while a file is read, by dimension, and whether they are ids of groups or of
/// entities.
class EntityIds {
 public:
  using Ids = std::array<int, 4>;  ///< by dimension

  /// Records the ids of the elements that were added to the mesh since the last call: ids of their group or
  /// of their entity.
  void note(const MeshData& mesh, bool are_of_group, const Ids& ids);

  /// Gives each entity whose tag is also a group's id the first free number, from 1, and removes names of
  /// groups without elements if an entity has the number.
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
