// Polygons of arrays as triangles.
#include "holdfast/polygons.h"

#include <cstdint>
#include <stdexcept>
#include <vector>

#include "arrays.h"
#include "register.h"

namespace holdfast::python {
namespace {

using Numbers = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>;

template <class Number>
std::vector<Number> numbers_from(const Numbers& array, const char* what) {
  const auto values = array.unchecked<1>();
  std::vector<Number> numbers;
  numbers.reserve(static_cast<std::size_t>(values.shape(0)));
  for (py::ssize_t i = 0; i < values.shape(0); ++i) {
    const std::int64_t value = values(i);
    if (value < 0 || value > static_cast<std::int64_t>(UINT32_MAX))
      throw std::invalid_argument(std::string(what) +
                                  " of polygons are out of range: " + std::to_string(value));
    numbers.push_back(static_cast<Number>(value));
  }
  return numbers;
}

/// Triangles, and the polygon of each.
py::tuple triangles_of_polygons(const py::object& points, const Numbers& offsets, const Numbers& corners) {
  CutPolygons cut = cut_polygons(rows_from<Point>(points, "points"), numbers_from<Index>(corners, "corners"),
                                 numbers_from<std::size_t>(offsets, "offsets"));
  py::array_t<std::int64_t> polygons(static_cast<py::ssize_t>(cut.polygons.size()));
  std::copy(cut.polygons.begin(), cut.polygons.end(), polygons.mutable_data());
  return py::make_tuple(array_of(std::move(cut.triangles)), polygons);
}

}  // namespace

void register_polygons(py::module_& module) { module.def("triangles_of_polygons", &triangles_of_polygons); }

}  // namespace holdfast::python
