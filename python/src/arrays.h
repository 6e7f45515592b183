// Conversion of numpy arrays: inputs are read in place where possible, results are given without a copy.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <memory>
#include <utility>
#include <vector>

#include "holdfast/arrays.h"
#include "holdfast/types.h"

namespace holdfast::python {

namespace py = pybind11;

/// An array of one or two dimensions, in native byte order, with a type that `Scalar` has. `columns` is 0 for
/// one dimension. Throws TypeError and ValueError that name `what`.
[[nodiscard]] ArrayView view_of(const py::array& array, std::size_t columns, const char* what);

/// The arrays of a surface; all except the vertices may be None.
struct SurfaceArrays {
  py::array vertices;
  py::object facets, segments, vertex_markers, facet_markers, segment_markers, names;
};
/// The arrays of a tuple of these seven.
[[nodiscard]] inline SurfaceArrays surface_from(const py::tuple& arrays) {
  return {py::cast<py::array>(arrays[0]), arrays[1], arrays[2], arrays[3], arrays[4], arrays[5], arrays[6]};
}
/// Fills `arrays`, which refers to memory of `from`. Needs the interpreter lock.
void set(Arrays& arrays, const SurfaceArrays& from);

/// The numbers of an array as rows of the library; errors call the array `what`.
template <class Row>
[[nodiscard]] std::vector<Row> rows_from(const py::object& object, const char* what);
[[nodiscard]] std::vector<int> markers_from(const py::object& object, const char* what);

/// A read-only array of `rows` rows of `columns` numbers, or of one dimension if `columns` is 0, in memory
/// that `owner` keeps alive.
template <class Number>
[[nodiscard]] py::array view_on(const Number* data, std::size_t rows, std::size_t columns, py::handle owner) {
  std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(rows)};
  if (columns != 0) shape.push_back(static_cast<py::ssize_t>(columns));
  py::array_t<Number> array(shape, data, owner);
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

/// Indices are at most 2^28, so they have the same bits as signed numbers.
template <class Row>
[[nodiscard]] py::array indices_on(const std::vector<Row>& rows, py::handle owner) {
  return view_on(reinterpret_cast<const std::int32_t*>(rows.data()), rows.size(), std::tuple_size_v<Row>,
                 owner);
}

/// A read-only array that owns the rows.
template <class Row>
[[nodiscard]] py::array array_of(std::vector<Row> rows) {
  auto held = std::make_unique<std::vector<Row>>(std::move(rows));
  const std::vector<Row>& there = *held;
  const py::capsule owner(held.release(), [](void* p) { delete static_cast<std::vector<Row>*>(p); });
  return indices_on(there, owner);
}

/// In the form that _defects of errors.py takes.
[[nodiscard]] py::list defects_of(const std::vector<Defect>& defects);

}  // namespace holdfast::python
