#include "arrays.h"

#include <pybind11/stl.h>

#include <string>

#include "holdfast/names.h"
#include "names.h"

namespace holdfast::python {
namespace {

std::string text_of(py::handle object) { return py::str(object); }

Scalar scalar_of_dtype(const py::dtype& dtype, const char* what) {
  const char kind = dtype.kind();
  const auto size = dtype.itemsize();
  if (kind == 'f' && size == 4) return Scalar::float32;
  if (kind == 'f' && size == 8) return Scalar::float64;
  if (kind == 'i' && size == 4) return Scalar::int32;
  if (kind == 'u' && size == 4) return Scalar::uint32;
  if (kind == 'i' && size == 8) return Scalar::int64;
  if (kind == 'u' && size == 8) return Scalar::uint64;
  throw py::type_error(std::string(what) + " must be numbers of 32 or 64 bits, not " + text_of(dtype));
}

[[noreturn]] void refuse_shape(const py::array& array, std::size_t columns, const char* what) {
  const std::string wanted = columns == 0 ? "(n,)" : "(n, " + std::to_string(columns) + ")";
  throw py::value_error(std::string(what) + " must have the shape " + wanted + ", not " +
                        text_of(array.attr("shape")));
}

// Sets a view of the memory of the array, if there is an array.
template <class Set>
void set_if_given(const py::object& object, std::size_t columns, const char* what, Set&& set) {
  if (!object.is_none()) set(view_of(py::cast<py::array>(object), columns, what));
}

template <class Row>
std::vector<Row> copy(std::span<const Row> rows) {
  return {rows.begin(), rows.end()};
}

}  // namespace

ArrayView view_of(const py::array& array, std::size_t columns, const char* what) {
  const auto dimensions = static_cast<py::ssize_t>(columns == 0 ? 1 : 2);
  if (array.ndim() != dimensions) refuse_shape(array, columns, what);
  if (columns != 0 && array.shape(1) != static_cast<py::ssize_t>(columns)) refuse_shape(array, columns, what);
  return {array.data(), static_cast<std::size_t>(array.shape(0)), scalar_of_dtype(array.dtype(), what),
          array.strides(0), columns == 0 ? 0 : array.strides(1)};
}

void set(Arrays& arrays, const SurfaceArrays& from) {
  arrays.set_vertices(view_of(from.vertices, 3, "points"));
  set_if_given(from.facets, 3, "triangles", [&](const ArrayView& a) { arrays.set_facets(a); });
  set_if_given(from.segments, 2, "segments", [&](const ArrayView& a) { arrays.set_segments(a); });
  set_if_given(from.vertex_markers, 0, "point markers",
               [&](const ArrayView& a) { arrays.set_vertex_markers(a); });
  set_if_given(from.facet_markers, 0, "triangle markers",
               [&](const ArrayView& a) { arrays.set_facet_markers(a); });
  set_if_given(from.segment_markers, 0, "segment markers",
               [&](const ArrayView& a) { arrays.set_segment_markers(a); });
  if (!from.names.is_none()) arrays.set_names(names_from(from.names));
}

template <>
std::vector<Point> rows_from<Point>(const py::object& object, const char* what) {
  if (object.is_none()) return {};
  Arrays arrays;
  arrays.set_vertices(view_of(py::cast<py::array>(object), 3, what));
  return copy(arrays.view().vertices);
}

template <>
std::vector<Triangle> rows_from<Triangle>(const py::object& object, const char* what) {
  if (object.is_none()) return {};
  Arrays arrays;
  arrays.set_facets(view_of(py::cast<py::array>(object), 3, what));
  return copy(arrays.view().facets);
}

template <>
std::vector<Segment> rows_from<Segment>(const py::object& object, const char* what) {
  if (object.is_none()) return {};
  Arrays arrays;
  arrays.set_segments(view_of(py::cast<py::array>(object), 2, what));
  return copy(arrays.view().segments);
}

// The library has no view of rows of four, so these are pairs of columns.
template <>
std::vector<Tetrahedron> rows_from<Tetrahedron>(const py::object& object, const char* what) {
  if (object.is_none()) return {};
  const ArrayView all = view_of(py::cast<py::array>(object), 4, what);
  std::vector<Tetrahedron> rows(all.rows);
  for (const std::size_t first : {std::size_t{0}, std::size_t{2}}) {
    ArrayView half = all;
    half.data = static_cast<const char*>(all.data) + static_cast<std::ptrdiff_t>(first) * all.column_stride;
    Arrays arrays;
    arrays.set_segments(half);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      rows[i][first] = arrays.view().segments[i][0];
      rows[i][first + 1] = arrays.view().segments[i][1];
    }
  }
  return rows;
}

std::vector<int> markers_from(const py::object& object, const char* what) {
  if (object.is_none()) return {};
  Arrays arrays;
  arrays.set_vertex_markers(view_of(py::cast<py::array>(object), 0, what));
  return copy(arrays.view().vertex_markers);
}

py::list defects_of(const std::vector<Defect>& defects) {
  py::list list;
  for (const Defect& d : defects) {
    py::list where;
    for (const Point& p : d.where) where.append(py::make_tuple(p[0], p[1], p[2]));
    list.append(py::make_tuple(name(d.kind), py::tuple(py::cast(d.vertices)), py::tuple(py::cast(d.facets)),
                               py::tuple(py::cast(d.segments)), py::tuple(where), d.message));
  }
  return list;
}

}  // namespace holdfast::python
