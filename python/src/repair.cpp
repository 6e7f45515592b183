// The calls related to repair. The interpreter lock is released while they run.
#include "holdfast/repair.h"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <memory>
#include <string>
#include <vector>

#include "arrays.h"
#include "holdfast/check_repair.h"
#include "limits.h"
#include "register.h"
#include "repair_check.h"
#include "repaired.h"
#include "reports.h"
#include "state.h"
#include "watch.h"

namespace holdfast::python {
namespace {

std::shared_ptr<Repair> repair_arrays(const py::tuple& surface, const py::dict& options,
                                      const py::object& progress) {
  Arrays arrays;
  const SurfaceArrays held = surface_from(surface);
  set(arrays, held);
  auto repaired = std::make_shared<Repair>();
  RepairOptions& how = repaired->options;
  take_limits(options, how);
  take(options, "weld", how.weld);
  take(options, "join", how.join);
  std::size_t sides = 0;
  take(options, "fill_holes", sides);
  if (sides > 0) how.fill_holes = sides;
  take(options, "union", how.unite);
  take(options, "threads", how.threads);
  const Watch watch(progress);
  how.progress = [&watch](double fraction) { return watch.go_on("repair", fraction); };
  {
    const py::gil_scoped_release unlocked;
    repaired->result = repair(arrays.view(), how);
  }
  how.progress = {};
  return repaired;
}

std::string check_repair_arrays(const py::tuple& surface, const Repair& repaired, const py::dict& options,
                                const py::object& progress) {
  Arrays arrays;
  const SurfaceArrays held = surface_from(surface);
  set(arrays, held);
  RepairCheckOptions how;
  take_limits(options, how);
  const Watch watch(progress);
  how.progress = [&watch](double fraction) { return watch.go_on("check", fraction); };
  const py::gil_scoped_release unlocked;
  const RepairClaims claims = claims_of(repaired.result, repaired.options);
  return reports::text_of(
      reports::to_json(check_repaired(arrays.view(), repaired.result.surface.view(), claims, how)));
}

std::string report_of(const Repair& repaired) {
  const RepairOptions& options = repaired.options;
  reports::Json asked{
      {"weld", options.weld},
      {"join", options.join},
      {"fill_holes", options.fill_holes ? reports::Json(*options.fill_holes) : reports::Json(nullptr)},
      {"union", options.unite},
      {"threads", options.threads}};
  return reports::text_of(reports::to_json(repaired.result, std::move(asked)));
}

/// The start of each facet's list, and all lists concatenated.
py::tuple parents_of(const RepairResult& result) {
  const std::vector<std::size_t>& first = result.parents.first;
  py::array_t<std::int64_t> begins(static_cast<py::ssize_t>(first.size()));
  std::copy(first.begin(), first.end(), begins.mutable_data());
  py::array_t<std::int64_t> all(static_cast<py::ssize_t>(result.parents.all.size()));
  std::copy(result.parents.all.begin(), result.parents.all.end(), all.mutable_data());
  return py::make_tuple(begins, all);
}

}  // namespace

void register_repair(py::module_& module) {
  py::class_<Repair, std::shared_ptr<Repair>>(module, "RepairResult")
      .def_property_readonly("outcome", [](const Repair& r) { return static_cast<int>(r.result.outcome); })
      .def_property_readonly("message", [](const Repair& r) { return r.result.message; })
      .def_property_readonly("defects", [](const Repair&) { return py::list(); })
      .def_property_readonly(
          "surface",
          [](const std::shared_ptr<Repair>& r) { return std::shared_ptr<Surface>(r, &r->result.surface); })
      .def_property_readonly("parents", [](const Repair& r) { return parents_of(r.result); })
      .def_property_readonly("max_displacement", [](const Repair& r) { return r.result.max_displacement; })
      .def("report", &report_of)
      .def(pickled<Repair>());
  module.def("repair", &repair_arrays);
  module.def("check_repair", &check_repair_arrays);
}

}  // namespace holdfast::python
