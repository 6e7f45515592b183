// Triangles in the plane. The interpreter lock is released while the call runs.
#include "holdfast/plane.h"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

#include "arrays.h"
#include "holdfast/plane_repair.h"
#include "limits.h"
#include "named.h"
#include "names.h"
#include "plane_report.h"
#include "register.h"
#include "text.h"
#include "watch.h"

namespace holdfast::python {
namespace {

struct PlaneRun {
  PlaneResult result;
  std::vector<Remark> remarks;
  bool stopped = false;
  std::size_t input_points = 0;  ///< with a repair: those that stay
  std::optional<PlaneRepairReport> repaired;
  std::string report;  ///< of a run that was pickled
};

using PlaneSeeds = std::vector<std::tuple<double, double, int, double>>;

template <typename Enum, typename To>
void take_named(const py::dict& options, const char* option, To& to) {
  if (!options.contains(option) || options[option].is_none()) return;
  to = named<Enum>(value_of<std::string>(options, option), option);
}

PlaneOptions options_from(const py::dict& options) {
  PlaneOptions how;
  take_limits(options, how);
  take_named<PlaneMethod>(options, "method", how.method);
  take_named<PlaneEars>(options, "ears", how.ears);
  take_named<LayingOrder>(options, "order", how.order);
  take(options, "partition_first", how.partition_first);
  take(options, "delaunay", how.delaunay);
  take(options, "hull", how.hull);
  take(options, "size", how.size);
  if (!options["angle"].is_none()) how.angle = value_of<double>(options, "angle");
  take(options, "keep_boundary", how.keep_boundary);
  take(options, "max_points", how.max_points);
  take(options, "seed", how.seed);
  take_named<PlaneStage>(options, "stop_after", how.stop_after);
  if (how.stop_after) take(options, "stop_after_swaps", how.stop_after_swaps);
  return how;
}

/// From (points, segments, point markers, segment markers, holes, regions), in two dimensions.
Plane plane_from(const py::tuple& given) {
  Plane plane;
  const auto points = py::array_t<double, py::array::c_style | py::array::forcecast>(given[0]);
  plane.points.resize(static_cast<std::size_t>(points.shape(0)));
  const auto at = points.unchecked<2>();
  for (py::ssize_t i = 0; i < at.shape(0); ++i)
    plane.points[static_cast<std::size_t>(i)] = {at(i, 0), at(i, 1)};
  plane.segments = rows_from<Segment>(given[1], "segments");
  plane.point_markers = markers_from(given[2], "point_markers");
  plane.segment_markers = markers_from(given[3], "segment_markers");
  plane.holes = py::cast<std::vector<PlanePoint>>(given[4]);
  for (const auto& [x, y, id, area] : py::cast<PlaneSeeds>(given[5]))
    plane.regions.push_back({{x, y}, id, area});
  return plane;
}

std::size_t points_of(const Plane& plane) { return plane.points.size(); }
std::size_t points_of(const PlanesInSpace& planes) {
  const bool is_plane = planes.points.empty() && planes.parts.size() == 1;
  return is_plane ? points_of(planes.parts[0].plane) : planes.points.size();
}

Plane& result_of(PlaneRepair& repair) { return repair.plane; }
PlanesInSpace& result_of(PlanesRepair& repair) { return repair.planes; }

/// Repairs what is given. Returns false if there is no result.
template <typename Planes>
bool repair_first(Planes& given, double weld, const PlaneOptions& how, const Watch& watch, PlaneRun& run) {
  RepairOptions options;
  static_cast<Limits&>(options) = how;
  options.weld = weld;
  options.progress = [&watch](double fraction) { return watch.go_on("repair", fraction); };
  auto repaired = repair(given, options);
  run.result.outcome = repaired.outcome;
  run.result.message = repaired.message;
  run.repaired = repaired.report;
  given = std::move(result_of(repaired));
  run.input_points = points_of(given) - repaired.report.new_points;
  return repaired.outcome == Outcome::done;
}

template <typename Make>
std::shared_ptr<PlaneRun> solve(const py::dict& options, const py::object& progress, Make&& planes) {
  PlaneOptions how = options_from(options);
  const Watch watch(progress);
  how.progress = [&watch](double fraction) { return watch.go_on("plane", fraction); };
  auto run = std::make_shared<PlaneRun>();
  run->stopped = how.stop_after.has_value();
  std::optional<double> weld;
  if (!options["repair"].is_none()) weld = value_of<double>(options, "repair");
  const py::gil_scoped_release unlocked;
  auto given = planes(watch, how);
  run->input_points = points_of(given);
  run->remarks = given.remarks;
  if (weld && !repair_first(given, *weld, how, watch, *run)) return run;
  run->result = triangulate(given, how);
  return run;
}

std::shared_ptr<PlaneRun> plane_arrays(const py::tuple& given, const py::dict& options,
                                       const py::object& progress) {
  Plane plane = plane_from(given);
  return solve(options, progress, [&](const Watch&, const PlaneOptions&) { return std::move(plane); });
}

/// From (points, segments, point markers, segment markers, holes) in three dimensions.
std::shared_ptr<PlaneRun> plane_in_space_arrays(const py::tuple& given, double tolerance,
                                                const py::dict& options, const py::object& progress) {
  const std::vector<Point> points = rows_from<Point>(given[0], "points");
  const std::vector<Segment> segments = rows_from<Segment>(given[1], "segments");
  const std::vector<int> point_markers = markers_from(given[2], "point_markers"),
                         segment_markers = markers_from(given[3], "segment_markers");
  const auto holes = py::cast<std::vector<Point>>(given[4]);
  return solve(options, progress, [&](const Watch&, const PlaneOptions&) {
    return plane_in_space(points, segments, holes, tolerance, point_markers, segment_markers);
  });
}

std::shared_ptr<PlaneRun> plane_file(const py::object& file, const std::string& format, double tolerance,
                                     const py::dict& options, const py::object& progress) {
  const std::filesystem::path path = path_from(file);
  const auto arc_step = value_of<double>(options, "arcs");
  return solve(options, progress, [&](const Watch& watch, const PlaneOptions& how) {
    ReadOptions reading;
    reading.arc_step = arc_step;
    static_cast<Limits&>(reading) = how;
    reading.format = format;
    reading.tolerance = tolerance;
    reading.progress = [&watch](double fraction) { return watch.go_on("read", fraction); };
    return read_planes(path, reading);
  });
}

std::vector<std::string> messages_of(const std::vector<Remark>& remarks) {
  std::vector<std::string> messages;
  for (const Remark& remark : remarks) messages.push_back(remark.message);
  return messages;
}

/// Writes the file and returns what it does not hold.
std::vector<std::string> save(const PlaneRun& run, const py::object& file, const std::string& format,
                              const py::dict& options, const py::object& progress) {
  const std::filesystem::path path = path_from(file);
  const Watch watch(progress);
  WriteOptions how;
  take_limits(options, how);
  how.format = format;
  take(options, "legacy_msh", how.legacy_msh);
  how.progress = [&watch](double fraction) { return watch.go_on("write", fraction); };
  PlaneMesh renamed;  // only with other names
  const bool has_names = !options["names"].is_none();
  if (has_names) {
    renamed = run.result.mesh;
    renamed.names = names_from(options["names"]);
  }
  const PlaneMesh& mesh = has_names ? renamed : run.result.mesh;
  const py::gil_scoped_release unlocked;
  write_plane(path, mesh, how);
  return messages_of(not_held(path, mesh, how));
}

std::string report_of(const PlaneRun& run) {
  if (!run.report.empty()) return run.report;
  return reports::text_of(reports::to_json(run.result, reports::Json::object(), run.stopped, run.repaired));
}

py::tuple pickled(const py::object& self) {
  const auto& run = self.cast<const PlaneRun&>();
  return py::make_tuple(self.attr("points"), self.attr("triangles"), self.attr("regions"),
                        self.attr("segments"), self.attr("point_markers"), self.attr("segment_markers"),
                        run.result.mesh.base, run.input_points, self.attr("remarks"), report_of(run),
                        self.attr("names"));
}

std::shared_ptr<PlaneRun> unpickled(const py::tuple& state) {
  auto run = std::make_shared<PlaneRun>();
  PlaneMesh& mesh = run->result.mesh;
  const auto points = py::array_t<double, py::array::c_style | py::array::forcecast>(state[0]);
  const auto at = points.unchecked<2>();
  for (py::ssize_t i = 0; i < at.shape(0); ++i) {
    if (at.shape(1) == 3)
      mesh.in_space.push_back({at(i, 0), at(i, 1), at(i, 2)});
    else
      mesh.points.push_back({at(i, 0), at(i, 1)});
  }
  mesh.triangles = rows_from<Triangle>(state[1], "triangles");
  mesh.regions = markers_from(state[2], "regions");
  mesh.segments = rows_from<Segment>(state[3], "segments");
  mesh.point_markers = markers_from(state[4], "point_markers");
  mesh.segment_markers = markers_from(state[5], "segment_markers");
  mesh.base = state[6].cast<int>();
  run->input_points = state[7].cast<std::size_t>();
  for (const auto& message : state[8].cast<std::vector<std::string>>())
    run->remarks.push_back({RemarkKind::left_out, 1, message});
  run->report = state[9].cast<std::string>();
  mesh.names = names_from(state[10]);
  return run;
}

template <typename See>
auto seen_in_plane(See see) {
  return [see](py::object self) { return see(self.cast<const PlaneRun&>().result.mesh, self); };
}

}  // namespace

void register_plane(py::module_& module) {
  py::class_<PlaneRun, std::shared_ptr<PlaneRun>>(module, "PlaneResult")
      .def_property_readonly("outcome", [](const PlaneRun& r) { return static_cast<int>(r.result.outcome); })
      .def_property_readonly("message", [](const PlaneRun& r) { return r.result.message; })
      .def_property_readonly("defects", [](const PlaneRun& r) { return defects_of(r.result.defects); })
      .def_property_readonly("n_input_points", [](const PlaneRun& r) { return r.input_points; })
      .def_property_readonly("points", seen_in_plane([](const PlaneMesh& m, py::handle self) {
                               return m.in_space.empty()
                                          ? view_on(reinterpret_cast<const double*>(m.points.data()),
                                                    m.points.size(), 2, self)
                                          : view_on(reinterpret_cast<const double*>(m.in_space.data()),
                                                    m.in_space.size(), 3, self);
                             }))
      .def_property_readonly("triangles", seen_in_plane([](const PlaneMesh& m, py::handle self) {
                               return indices_on(m.triangles, self);
                             }))
      .def_property_readonly("segments", seen_in_plane([](const PlaneMesh& m, py::handle self) {
                               return indices_on(m.segments, self);
                             }))
      .def_property_readonly("regions", seen_in_plane([](const PlaneMesh& m, py::handle self) {
                               return view_on(m.regions.data(), m.regions.size(), 0, self);
                             }))
      .def_property_readonly("point_markers", seen_in_plane([](const PlaneMesh& m, py::handle self) {
                               return view_on(m.point_markers.data(), m.point_markers.size(), 0, self);
                             }))
      .def_property_readonly("segment_markers", seen_in_plane([](const PlaneMesh& m, py::handle self) {
                               return view_on(m.segment_markers.data(), m.segment_markers.size(), 0, self);
                             }))
      .def_property_readonly("remarks", [](const PlaneRun& r) { return messages_of(r.remarks); })
      .def_property_readonly("names", [](const PlaneRun& r) { return tuple_of(r.result.mesh.names); })
      .def("report", &report_of)
      .def(py::pickle(&pickled, &unpickled))
      .def("save", &save);
  module.def("plane", &plane_arrays);
  module.def("plane_in_space", &plane_in_space_arrays);
  module.def("plane_file", &plane_file);
}

}  // namespace holdfast::python
