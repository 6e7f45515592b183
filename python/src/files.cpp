// Files: surfaces, volumes and size fields, as the program reads and writes them.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <filesystem>
#include <memory>
#include <string>

#include "arrays.h"
#include "holdfast/io.h"
#include "holdfast/statistics.h"
#include "limits.h"
#include "names.h"
#include "register.h"
#include "reports.h"
#include "text.h"
#include "watch.h"

namespace holdfast::python {
namespace {

ReadOptions reading(const py::dict& options, const Watch& watch, const std::string& format) {
  ReadOptions to;
  take_limits(options, to);
  take(options, "tolerance", to.tolerance);
  to.format = format;
  to.progress = [&watch](double fraction) { return watch.go_on("read", fraction); };
  return to;
}

WriteOptions writing(const py::dict& from) {
  WriteOptions to;
  to.format = from["format"].cast<std::string>();
  to.threads = from["threads"].cast<unsigned>();
  to.compress = from["compress"].cast<bool>();
  to.legacy_msh = from["legacy_msh"].cast<bool>();
  to.binary = from["binary"].cast<bool>();
  to.one_file = from["one_file"].cast<bool>();
  to.gzip = from["gzip"].cast<bool>();
  to.shells = from["shells"].cast<bool>();
  return to;
}

py::list regions_of(const Surface& surface) {
  py::list regions;
  for (const auto& seed : surface.regions)
    regions.append(py::make_tuple(seed.where[0], seed.where[1], seed.where[2], seed.id, seed.size));
  return regions;
}

py::list messages_of(const std::vector<Remark>& remarks) {
  py::list messages;
  for (const Remark& remark : remarks) messages.append(message_of(remark.message));
  return messages;
}

py::list holes_of(const Surface& surface) {
  py::list holes;
  for (const Point& p : surface.holes) holes.append(py::make_tuple(p[0], p[1], p[2]));
  return holes;
}

void register_surface(py::module_& module) {
  const auto seen = [](auto see) {
    return [see](py::object self) { return see(self.cast<const Surface&>(), self); };
  };
  py::class_<Surface, std::shared_ptr<Surface>>(module, "SurfaceData")
      .def_property_readonly("points", seen([](const Surface& s, py::handle self) {
                               return view_on(reinterpret_cast<const double*>(s.vertices.data()),
                                              s.vertices.size(), 3, self);
                             }))
      .def_property_readonly(
          "triangles", seen([](const Surface& s, py::handle self) { return indices_on(s.facets, self); }))
      .def_property_readonly(
          "segments", seen([](const Surface& s, py::handle self) { return indices_on(s.segments, self); }))
      .def_property_readonly("triangle_markers", seen([](const Surface& s, py::handle self) {
                               return view_on(s.facet_markers.data(), s.facet_markers.size(), 0, self);
                             }))
      .def_property_readonly("segment_markers", seen([](const Surface& s, py::handle self) {
                               return view_on(s.segment_markers.data(), s.segment_markers.size(), 0, self);
                             }))
      .def_property_readonly("point_markers", seen([](const Surface& s, py::handle self) {
                               return view_on(s.vertex_markers.data(), s.vertex_markers.size(), 0, self);
                             }))
      .def_property_readonly("regions", &regions_of)
      .def_property_readonly("holes", &holes_of)
      .def_property_readonly("names", [](const Surface& s) { return tuple_of(s.names); })
      .def_property_readonly("remarks", [](const Surface& s) { return messages_of(s.remarks); });
}

}  // namespace

void register_files(py::module_& module) {
  register_surface(module);
  py::class_<SizeField, std::shared_ptr<SizeField>>(module, "SizeField")
      .def(py::init([](const py::array& points, const py::object& tetrahedra, std::vector<double> sizes,
                       std::vector<Metric> metrics) {
             return std::make_shared<SizeField>(SizeField{rows_from<Point>(points, "points"),
                                                          rows_from<Tetrahedron>(tetrahedra, "tetrahedra"),
                                                          std::move(sizes), std::move(metrics)});
           }),
           py::arg("points"), py::arg("tetrahedra"), py::arg("sizes"), py::arg("metrics"))
      .def_property_readonly("has_mesh", [](const SizeField& field) { return !field.vertices.empty(); })
      .def_property_readonly("has_metrics", [](const SizeField& field) { return !field.metrics.empty(); })
      .def_property_readonly("sizes", [](const SizeField& field) { return field.sizes; });

  module.def("read_surface", [](const py::object& file, const std::string& format, const py::dict& options,
                                const py::object& progress) {
    const std::filesystem::path path = path_from(file);
    const Watch watch(progress);
    const ReadOptions how = reading(options, watch, format);
    const py::gil_scoped_release unlocked;
    return std::make_shared<Surface>(read_surface(path, how));
  });
  module.def("read_volume", [](const py::object& file, const std::string& format, const py::dict& options,
                               const py::object& progress) {
    const std::filesystem::path path = path_from(file);
    const Watch watch(progress);
    const ReadOptions how = reading(options, watch, format);
    std::vector<Remark> remarks;
    std::shared_ptr<Volume> volume;
    {
      const py::gil_scoped_release unlocked;
      volume = std::make_shared<Volume>(read_volume(path, how, &remarks));
    }
    return py::make_tuple(volume, messages_of(remarks));
  });
  module.def("read_size_field", [](const py::object& file, const py::dict& options) {
    const std::filesystem::path path = path_from(file);
    const Watch watch(py::none{});
    const ReadOptions how = reading(options, watch, {});
    const py::gil_scoped_release unlocked;
    return std::make_shared<SizeField>(read_size_field(path, how));
  });
  module.def("write_volume", [](const py::object& file, const Volume& volume, const py::dict& how_to_write,
                                const py::dict& options, const py::object& progress) {
    const std::filesystem::path path = path_from(file);
    const Watch watch(progress);
    WriteOptions how = writing(how_to_write);
    take_limits(options, how);
    how.progress = [&watch](double fraction) { return watch.go_on("write", fraction); };
    std::vector<Remark> remarks;
    {
      const py::gil_scoped_release unlocked;
      write_volume(path, volume, how);
      remarks = not_held(path, volume, how);
    }
    return messages_of(remarks);
  });
  module.def("join",
             [](const std::vector<std::shared_ptr<Surface>>& parts, const std::vector<std::string>& names) {
               std::vector<Surface> all;
               for (const auto& part : parts) all.push_back(*part);
               return std::make_shared<Surface>(join(all, names));
             });
  module.def("surface_of", [](const Volume& volume) {
    const py::gil_scoped_release unlocked;
    return std::make_shared<Surface>(surface_of(volume));
  });
  module.def("volume_formats", &volume_formats);
  module.def("readable_volume_formats", &readable_volume_formats);
  module.def("volume_format_of", [](const py::object& file, const std::string& format) {
    return volume_format_of(path_from(file), format);
  });
  module.def("volume_info", [](const Volume& volume) {
    const py::gil_scoped_release unlocked;
    return reports::text_of(reports::to_json(statistics(volume)));
  });
  module.def("surface_info", [](const Surface& surface) {
    const py::gil_scoped_release unlocked;
    return reports::text_of(reports::to_json(statistics(surface)));
  });
}

}  // namespace holdfast::python
