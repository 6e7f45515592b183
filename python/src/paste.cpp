// Pasting of parts, and meshes of what came out.
#include "holdfast/paste.h"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <memory>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

#include "arrays.h"
#include "holdfast/names.h"
#include "limits.h"
#include "named.h"
#include "register.h"
#include "reports.h"
#include "watch.h"

namespace holdfast::python {
namespace {

using Seeds = std::vector<std::tuple<double, double, double, int, double>>;

/// (arrays, regions, holes) as a surface of the library, which copies them.
Surface surface_from(const py::tuple& part) {
  const auto arrays = py::cast<py::tuple>(part[0]);
  Arrays views;
  const SurfaceArrays held{
      py::cast<py::array>(arrays[0]), arrays[1], arrays[2], arrays[3], arrays[4], arrays[5], arrays[6]};
  set(views, held);
  const Complex complex = views.view();
  Surface surface;
  surface.vertices.assign(complex.vertices.begin(), complex.vertices.end());
  surface.facets.assign(complex.facets.begin(), complex.facets.end());
  surface.segments.assign(complex.segments.begin(), complex.segments.end());
  surface.facet_markers.assign(complex.facet_markers.begin(), complex.facet_markers.end());
  surface.segment_markers.assign(complex.segment_markers.begin(), complex.segment_markers.end());
  surface.vertex_markers.assign(complex.vertex_markers.begin(), complex.vertex_markers.end());
  if (complex.names != nullptr) surface.names = *complex.names;
  for (const auto& [x, y, z, id, size] : py::cast<Seeds>(part[1]))
    surface.regions.push_back({{x, y, z}, id, size});
  surface.holes = py::cast<std::vector<Point>>(part[2]);
  return surface;
}

std::shared_ptr<PasteResult> paste_parts(const py::list& parts, const std::vector<std::string>& names,
                                         const py::dict& options, const py::object& progress) {
  std::vector<Surface> surfaces;
  for (const py::handle part : parts) surfaces.push_back(surface_from(py::cast<py::tuple>(part)));
  PasteOptions how;
  take_limits(options, how);
  take(options, "tolerance", how.tolerance);
  how.overlap = named<Overlap>(value_of<std::string>(options, "overlap"), "overlap");
  take(options, "threads", how.threads);
  const Watch watch(progress);
  how.progress = [&watch](double fraction) { return watch.go_on("paste", fraction); };
  const py::gil_scoped_release unlocked;
  if (surfaces.size() == 1) {
    how.labels = names;
    return std::make_shared<PasteResult>(paste_components(surfaces[0], how));
  }
  return std::make_shared<PasteResult>(paste(surfaces, how, names));
}

}  // namespace

void register_paste(py::module_& module) {
  const auto surface = [](const std::shared_ptr<PasteResult>& r) {
    return std::shared_ptr<Surface>(r, static_cast<Surface*>(&r->surface));
  };
  py::class_<PasteResult, std::shared_ptr<PasteResult>>(module, "PasteResult")
      .def_property_readonly("outcome", [](const PasteResult& r) { return static_cast<int>(r.outcome); })
      .def_property_readonly("message", [](const PasteResult& r) { return r.message; })
      .def_property_readonly("defects", [](const PasteResult&) { return py::list(); })
      .def_property_readonly("surface", surface)
      .def_property_readonly(
          "parents",
          [](const PasteResult& r) {
            py::list lists;
            for (std::size_t f = 0; f < r.parents.size(); ++f) {
              const auto parents = r.parents[f];
              lists.append(py::tuple(py::cast(std::vector<Index>(parents.begin(), parents.end()))));
            }
            return lists;
          })
      .def_property_readonly("moved",
                             [](const PasteResult& r) {
                               py::dict moved;
                               for (const auto& [vertex, distance] : r.moved)
                                 moved[py::int_(vertex)] = distance;
                               return moved;
                             })
      .def_property_readonly("marker_sets", [](const PasteResult& r) { return r.marker_sets; })
      .def_property_readonly("regions",
                             [](const PasteResult& r) {
                               std::vector<int> ids;
                               for (const PastedPart& part : r.parts) ids.push_back(part.id);
                               return ids;
                             })
      .def_property_readonly("apart",
                             [](const PasteResult& r) {
                               py::list list;
                               for (const PartApart& apart : r.apart)
                                 list.append(py::make_tuple(apart.part, apart.nearest, apart.distance));
                               return list;
                             })
      .def_property_readonly("max_displacement", [](const PasteResult& r) { return r.max_displacement; })
      .def("report", [](const PasteResult& r) {
        return reports::text_of(
            reports::to_json(static_cast<const RepairResult&>(r), reports::Json::object()));
      });
  module.def("paste", &paste_parts);
}

}  // namespace holdfast::python
