// Names in Python: dictionaries for triangles, regions, segments and points, in this order.
#pragma once

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <map>
#include <string>

#include "holdfast/types.h"

namespace holdfast::python {

[[nodiscard]] inline pybind11::tuple tuple_of(const Names& names) {
  return pybind11::make_tuple(names.facets, names.regions, names.segments, names.vertices);
}

[[nodiscard]] inline Names names_from(const pybind11::handle& object) {
  if (object.is_none()) return {};
  using Table = std::map<int, std::string>;
  const auto tuple = pybind11::cast<pybind11::tuple>(object);
  return {tuple[0].cast<Table>(), tuple[1].cast<Table>(), tuple[2].cast<Table>(), tuple[3].cast<Table>()};
}

}  // namespace holdfast::python
