// Volume: a tetrahedral mesh that the library owns, with views of its arrays without a copy.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <memory>

#include "arrays.h"
#include "holdfast/second_order.h"
#include "holdfast/types.h"
#include "names.h"
#include "register.h"

namespace holdfast::python {
namespace {

std::shared_ptr<Volume> volume_of(const py::array& points, const py::object& tetrahedra,
                                  const py::object& regions, const py::object& triangles,
                                  const py::object& triangle_markers, const py::object& segments,
                                  const py::object& segment_markers, const py::object& point_markers,
                                  const py::object& input_points, const py::object& names) {
  auto volume = std::make_shared<Volume>();
  volume->vertices = rows_from<Point>(points, "points");
  volume->tetrahedra = rows_from<Tetrahedron>(tetrahedra, "tetrahedra");
  volume->regions = markers_from(regions, "regions");
  volume->facets = rows_from<Triangle>(triangles, "triangles");
  volume->facet_markers = markers_from(triangle_markers, "triangle markers");
  volume->segments = rows_from<Segment>(segments, "segments");
  volume->segment_markers = markers_from(segment_markers, "segment markers");
  volume->vertex_markers = markers_from(point_markers, "point markers");
  if (!input_points.is_none())
    for (const int i : markers_from(input_points, "input points")) volume->input_vertices.push_back(i);
  volume->names = names_from(names);
  return volume;
}

// A property whose array keeps the volume alive.
template <class See>
auto seen(See see) {
  return [see](py::object self) { return see(self.cast<const Volume&>(), self); };
}

}  // namespace

void register_volume(py::module_& module) {
  py::class_<Volume, std::shared_ptr<Volume>>(module, "Volume")
      .def(py::init(&volume_of), py::arg("points"), py::arg("tetrahedra"), py::arg("regions") = py::none(),
           py::arg("triangles") = py::none(), py::arg("triangle_markers") = py::none(),
           py::arg("segments") = py::none(), py::arg("segment_markers") = py::none(),
           py::arg("point_markers") = py::none(), py::arg("input_points") = py::none(),
           py::arg("names") = py::none())
      .def_property_readonly("names", [](const Volume& v) { return tuple_of(v.names); })
      .def_property_readonly("points", seen([](const Volume& v, py::handle self) {
                               return view_on(reinterpret_cast<const double*>(v.vertices.data()),
                                              v.vertices.size(), 3, self);
                             }))
      .def_property_readonly(
          "tetrahedra", seen([](const Volume& v, py::handle self) { return indices_on(v.tetrahedra, self); }))
      .def_property_readonly("regions", seen([](const Volume& v, py::handle self) {
                               return view_on(v.regions.data(), v.regions.size(), 0, self);
                             }))
      .def_property_readonly(
          "triangles", seen([](const Volume& v, py::handle self) { return indices_on(v.facets, self); }))
      .def_property_readonly("triangle_markers", seen([](const Volume& v, py::handle self) {
                               return view_on(v.facet_markers.data(), v.facet_markers.size(), 0, self);
                             }))
      .def_property_readonly(
          "segments", seen([](const Volume& v, py::handle self) { return indices_on(v.segments, self); }))
      .def_property_readonly("segment_markers", seen([](const Volume& v, py::handle self) {
                               return view_on(v.segment_markers.data(), v.segment_markers.size(), 0, self);
                             }))
      .def_property_readonly("point_markers", seen([](const Volume& v, py::handle self) {
                               return view_on(v.vertex_markers.data(), v.vertex_markers.size(), 0, self);
                             }))
      .def_property_readonly("input_points", seen([](const Volume& v, py::handle self) {
                               return view_on(v.input_vertices.data(), v.input_vertices.size(), 0, self);
                             }))
      .def_property_readonly("mid_points", seen([](const Volume& v, py::handle self) {
                               return view_on(reinterpret_cast<const double*>(v.mid_nodes.points.data()),
                                              v.mid_nodes.points.size(), 3, self);
                             }))
      .def_property_readonly("mid_tetrahedra", seen([](const Volume& v, py::handle self) {
                               return indices_on(v.mid_nodes.tetrahedra, self);
                             }))
      .def_property_readonly("mid_triangles", seen([](const Volume& v, py::handle self) {
                               return indices_on(v.mid_nodes.facets, self);
                             }))
      .def_property_readonly("mid_segments", seen([](const Volume& v, py::handle self) {
                               return view_on(reinterpret_cast<const int*>(v.mid_nodes.segments.data()),
                                              v.mid_nodes.segments.size(), 0, self);
                             }));
  module.def("with_mid_nodes", [](const Volume& volume, const py::array& points, const py::array& tetrahedra,
                                  const py::array& triangles, const py::object& segments) {
    auto copy = std::make_shared<Volume>(volume);
    MidNodes& mid = copy->mid_nodes;
    mid.points = rows_from<Point>(points, "points");
    const std::vector<Segment> pairs =
        rows_from<Segment>(tetrahedra, "tetrahedra");  // three for each tetrahedron
    for (std::size_t i = 0; i + 2 < pairs.size(); i += 3)
      mid.tetrahedra.push_back(
          {pairs[i][0], pairs[i][1], pairs[i + 1][0], pairs[i + 1][1], pairs[i + 2][0], pairs[i + 2][1]});
    mid.facets = rows_from<Triangle>(triangles, "triangles");
    for (const int node : markers_from(segments, "segments"))
      mid.segments.push_back(static_cast<Index>(node));
    return copy;
  });
  module.def("second_order", [](const Volume& volume, const py::object& points, const py::object& triangles,
                                double tolerance) {
    auto copy = std::make_shared<Volume>(volume);
    Surface smooth;
    const bool curved = !points.is_none();
    if (curved) {
      smooth.vertices = rows_from<Point>(py::cast<py::array>(points), "points");
      smooth.facets = rows_from<Triangle>(triangles, "triangles");
    }
    CurveReport report;
    {
      const py::gil_scoped_release unlocked;
      add_mid_nodes(*copy);
      CurveOptions options;
      options.tolerance = tolerance;
      if (curved) report = curve_mid_nodes(*copy, smooth.view(), options);
    }
    py::dict told;
    told["on_triangles"] = report.on_facets;
    told["moved"] = report.moved;
    told["beyond_tolerance"] = report.beyond;
    told["straightened"] = report.straightened;
    told["not_positive"] = report.not_positive;
    told["farthest"] = report.farthest;
    return py::make_tuple(copy, told);
  });
  module.def("not_positive_elements", [](const Volume& volume) {
    std::vector<Index> elements;
    {
      const py::gil_scoped_release unlocked;
      elements = not_positive_elements(volume);
    }
    return py::array_t<std::int64_t>(py::cast(elements));
  });
}

}  // namespace holdfast::python
