// What an archive file of Ansys MAPDL has: nodes, elements and components.
#pragma once

#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "io/cdb_elements.h"
#include "io/labels.h"
#include "io/numbered.h"

namespace holdfast::io {

struct CdbElement {
  std::int64_t number;
  CdbType type;
  CdbShape shape;
  std::uint8_t count;  ///< of nodes
  int material;
  std::size_t first;  ///< in `nodes_of_elements`
  std::size_t place;
};

struct CdbComponent {
  std::string name;
  bool of_nodes;
  std::vector<std::int64_t> members;  ///< a negative number ends a range that the one before it begins
};

struct CdbModel {
  Numbered nodes;
  std::vector<std::int64_t> node_numbers;
  std::vector<CdbElement> elements;
  std::vector<std::int64_t> nodes_of_elements;  ///< 0: a missing node on an edge
  std::vector<CdbComponent> components;
};

/// The ids of elements by their shapes.
using CdbIds = std::array<NamedIds, 3>;

/// The region or marker of each element: its material, or a component. A component of all elements of a
/// material names this; any other has an id of its own, and if several overlap, the smaller one counts.
/// `overlaps` counts memberships in larger ones.
[[nodiscard]] std::vector<int> ids_of_elements(const CdbModel& model, CdbIds& ids, std::size_t& overlaps);

/// The vertices of each component of nodes; none for components of elements.
[[nodiscard]] std::vector<std::vector<Index>> vertices_of_components(const CdbModel& model);

}  // namespace holdfast::io
