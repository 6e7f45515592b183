// Pasting of parts, and meshing of the result.
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
#include "holdfast/io.h"
#include "holdfast/names.h"
#include "holdfast/seeds.h"
#include "limits.h"
#include "named.h"
#include "register.h"
#include "reports.h"
#include "state.h"
#include "watch.h"

namespace holdfast::python {
namespace {

using Seeds = std::vector<std::tuple<double, double, double, int, double>>;

/// Makes a surface of the library from (arrays, regions, holes); copies them.
Surface part_from(const py::tuple& part) {
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

std::vector<Surface> surfaces_from(const py::list& parts) {
  std::vector<Surface> surfaces;
  for (const py::handle part : parts) surfaces.push_back(part_from(py::cast<py::tuple>(part)));
  return surfaces;
}

PasteOptions paste_options(const py::dict& options, const Watch& watch) {
  PasteOptions how;
  take_limits(options, how);
  take(options, "cut", how.cut);
  take(options, "judge", how.judge);
  take(options, "tolerance", how.tolerance);
  how.overlap = named<Overlap>(value_of<std::string>(options, "overlap"), "overlap");
  take(options, "threads", how.threads);
  how.progress = [&watch](double fraction) { return watch.go_on("paste", fraction); };
  return how;
}

std::shared_ptr<Surface> join_parts(const py::list& parts, const std::vector<std::string>& names) {
  return std::make_shared<Surface>(join(surfaces_from(parts), names));
}

std::shared_ptr<PasteResult> paste_parts(const py::list& parts, const std::vector<std::string>& names,
                                         const py::dict& options, const py::object& progress) {
  const std::vector<Surface> surfaces = surfaces_from(parts);
  const Watch watch(progress);
  PasteOptions how = paste_options(options, watch);
  const py::gil_scoped_release unlocked;
  if (surfaces.size() == 1) {
    how.labels = names;
    return std::make_shared<PasteResult>(paste_components(surfaces[0], how));
  }
  return std::make_shared<PasteResult>(paste(surfaces, how, names));
}

std::shared_ptr<PastedVolumes> paste_meshes(const std::vector<std::shared_ptr<Volume>>& parts,
                                            const std::vector<std::string>& names, const py::dict& options,
                                            const py::object& progress) {
  std::vector<Volume> volumes;
  for (const auto& part : parts) volumes.push_back(*part);
  const Watch watch(progress);
  const PasteOptions how = paste_options(options, watch);
  const py::gil_scoped_release unlocked;
  return std::make_shared<PastedVolumes>(paste(volumes, how, names));
}

std::shared_ptr<Surface> surface_with_seeds(const PasteResult& pasted, const py::dict& options,
                                            const py::object& progress) {
  const Watch watch(progress);
  Options how;
  take_limits(options, how);
  take(options, "threads", how.threads);
  how.progress = [&watch](const Progress& at) { return watch.go_on(name(at.stage), at.overall); };
  const py::gil_scoped_release unlocked;
  return std::make_shared<Surface>(with_seeds(pasted, how));
}

void register_volumes(py::module_& module) {
  py::class_<PastedVolumes, std::shared_ptr<PastedVolumes>>(module, "PastedVolumes")
      .def_property_readonly("outcome", [](const PastedVolumes& r) { return static_cast<int>(r.outcome); })
      .def_property_readonly("message", [](const PastedVolumes& r) { return r.message; })
      .def_property_readonly("defects", [](const PastedVolumes&) { return py::list(); })
      .def_property_readonly(
          "volume",
          [](const std::shared_ptr<PastedVolumes>& r) { return std::shared_ptr<Volume>(r, &r->volume); })
      .def_property_readonly("boundary",
                             [](const std::shared_ptr<PastedVolumes>& r) {
                               return std::shared_ptr<PasteResult>(r, &r->boundary);
                             })
      .def_property_readonly("origin",
                             [](const py::object& self) {
                               const auto& origin = self.cast<const PastedVolumes&>().origin;
                               return view_on(origin.data(), origin.size(), 0, self);
                             })
      .def("report",
           [](const PastedVolumes& r) {
             return reports::text_of(reports::to_json(r, reports::Json::object()));
           })
      .def(pickled<PastedVolumes>());
  module.def("paste_volumes", &paste_meshes);
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
      .def(
          "report",
          [](const PasteResult& r) { return reports::text_of(reports::to_json(r, reports::Json::object())); })
      .def_property_readonly("shared_facets", [](const PasteResult& r) { return r.shared_facets; })
      .def("parts", [](const PasteResult& r) { return reports::text_of(reports::parts_of(r)); })
      .def(pickled<PasteResult>());
  module.def("paste", &paste_parts);
  module.def("join_parts", &join_parts);
  module.def("with_seeds", &surface_with_seeds);
  register_volumes(module);
}

}  // namespace holdfast::python
