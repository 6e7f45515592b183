// The calls mesh, diagnose, check, delaunay and untangle. The interpreter lock is released while they run.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "arrays.h"
#include "holdfast/check.h"
#include "holdfast/holdfast.h"
#include "holdfast/io.h"
#include "holdfast/names.h"
#include "holdfast/paste.h"
#include "holdfast/summary.h"
#include "holdfast/untangle.h"
#include "limits.h"
#include "named.h"
#include "register.h"
#include "repaired.h"
#include "reports.h"
#include "watch.h"

namespace holdfast::python {
namespace {

template <class Enum>
Enum named(const py::dict& options, const char* key) {
  return python::named<Enum>(value_of<std::string>(options, key), key);
}

// Calls a function of the user, which takes an array of points (m, 3) and returns m sizes, or m metrics of
// six numbers, or one for all.
py::array_t<double> asked_at(const py::object& function, std::span<const Point> at, std::size_t numbers,
                             const char* what) {
  const py::array_t<double> points({static_cast<py::ssize_t>(at.size()), py::ssize_t{3}}, at.front().data());
  const py::object given = function(points);
  if (given.is_none()) throw std::invalid_argument(std::string(what) + " gave None: has it a `return`?");
  // Of numpy's masked arrays, which would lose it.
  if (py::hasattr(given, "filled") && py::cast<bool>(py::bool_(given.attr("mask").attr("any")())))
    throw std::invalid_argument(std::string(what) + " gave an array with a masked entry, which has no value");
  const py::array_t<double, py::array::c_style | py::array::forcecast> answer(given);
  const auto size = static_cast<std::size_t>(answer.size());
  if (size != numbers && size != numbers * at.size())
    throw std::invalid_argument(std::string(what) + " gave an array of shape " +
                                std::string(py::str(answer.attr("shape"))) + " for points of shape (" +
                                std::to_string(at.size()) + ", 3)");
  const double* const nan =
      std::find_if(answer.data(), answer.data() + size, [](double x) { return std::isnan(x); });
  if (nan == answer.data() + size) return answer;
  const Point& p = at[static_cast<std::size_t>(nan - answer.data()) / numbers];
  throw std::invalid_argument(std::string(what) + " gave NaN at (" + std::to_string(p[0]) + ", " +
                              std::to_string(p[1]) + ", " + std::to_string(p[2]) + ")");
}

std::function<void(std::span<const Point>, std::span<double>)> sizes_asked_of(const py::object& function) {
  return [&function](std::span<const Point> points, std::span<double> sizes) {
    if (points.empty()) return;
    const py::gil_scoped_acquire lock;
    const py::array_t<double> answer = asked_at(function, points, 1, "size");
    if (answer.size() == 1)
      std::fill(sizes.begin(), sizes.end(), *answer.data());
    else
      std::copy_n(answer.data(), sizes.size(), sizes.begin());
  };
}

std::function<Metric(const Point&)> metric_asked_of(const py::object& function) {
  return [&function](const Point& p) {
    const py::gil_scoped_acquire lock;
    const py::array_t<double> answer = asked_at(function, {&p, 1}, 6, "metric");
    Metric metric;
    std::copy_n(answer.data(), 6, metric.begin());
    return metric;
  };
}

// `size_function` and `metric_function` hold the user's callables by reference: the callables outlive the
// call.
struct Fields {
  py::object size = py::none(), metric = py::none();
};

Sizes sizes_from(const py::dict& options, const Fields& fields) {
  Sizes sizes;
  take(options, "size", sizes.size);
  if (options.contains("gradation") && !options["gradation"].is_none())
    sizes.gradation = value_of<double>(options, "gradation");
  take(options, "growth", sizes.grow);
  take(options, "max_volume", sizes.max_volume);
  take(options, "max_ratio", sizes.max_ratio);
  take(options, "layers", sizes.layers);
  take(options, "point_sizes", sizes.vertex_sizes);
  if (!fields.size.is_none()) sizes.fields = sizes_asked_of(fields.size);
  if (!fields.metric.is_none()) sizes.metric = metric_asked_of(fields.metric);
  if (options.contains("size_field") && !options["size_field"].is_none()) {
    const auto field = py::cast<std::shared_ptr<SizeField>>(options["size_field"]);
    sizes.concurrent = fields.size.is_none() && fields.metric.is_none();
    if (field->metrics.empty())
      sizes.field = size_function(*field);
    else
      sizes.metric = metric_function(*field);
  }
  return sizes;
}

Options mesh_options(const py::dict& from, const Fields& fields) {
  Options options;
  take_limits(from, options);
  bool fill = false;
  take(from, "fill", fill);
  if (!fill) options.sizes = sizes_from(from, fields);
  options.effort = named<Effort>(from, "quality");
  options.keep = named<Keep>(from, "keep");
  options.order = named<LayingOrder>(from, "order");
  take(from, "box_margin", options.box_margin);
  take(from, "holes", options.holes);
  for (const auto& [x, y, z, id, size, volume] :
       py::cast<std::vector<std::tuple<double, double, double, int, double, double>>>(from["regions"]))
    options.regions.push_back({{x, y, z}, id, size, volume});
  take(from, "drop_outside", options.drop_outside);
  take(from, "flips", options.flips);
  take(from, "optimise", options.optimise);
  take(from, "add_points", options.add_points);
  take(from, "seed", options.seed);
  take(from, "threads", options.threads);
  return options;
}

// The ids in front of and behind each facet, and where there is no region.
py::tuple facet_regions(const std::vector<FacetRegions>& regions) {
  const auto count = static_cast<py::ssize_t>(regions.size());
  py::array_t<std::int32_t> ids({count, py::ssize_t{2}});
  py::array_t<bool> none({count, py::ssize_t{2}});
  auto id = ids.mutable_unchecked<2>();
  auto mask = none.mutable_unchecked<2>();
  for (py::ssize_t i = 0; i < count; ++i)
    for (py::ssize_t k = 0; k < 2; ++k) {
      const std::optional<int>& region = regions[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)];
      id(i, k) = region.value_or(0);
      mask(i, k) = !region.has_value();
    }
  return py::make_tuple(ids, none);
}

/// The arguments of a call of `mesh`. The object must not move, because sizes and progress refer to it.
struct MeshCall {
  MeshCall(const py::dict& options, const py::object& size, const py::object& metric,
           const py::object& progress)
      : fields{size, metric}, watch(progress), how(mesh_options(options, fields)) {
    how.progress = [this](const Progress& at) { return watch.go_on(name(at.stage), at.overall); };
  }
  MeshCall(const MeshCall&) = delete;
  MeshCall& operator=(const MeshCall&) = delete;
  ~MeshCall() = default;

  const Fields fields;
  const Watch watch;
  Options how;
};

std::shared_ptr<Result> mesh_arrays(const py::tuple& surface, const py::dict& options, const py::object& size,
                                    const py::object& metric, const py::object& progress) {
  Arrays arrays;
  const SurfaceArrays held = surface_from(surface);
  set(arrays, held);
  const MeshCall call(options, size, metric, progress);
  const py::gil_scoped_release unlocked;
  return std::make_shared<Result>(mesh(arrays.view(), call.how));
}

std::shared_ptr<Result> mesh_pasted(const std::shared_ptr<PasteResult>& pasted, const py::dict& options,
                                    const py::object& size, const py::object& metric,
                                    const py::object& progress) {
  const MeshCall call(options, size, metric, progress);
  const py::gil_scoped_release unlocked;
  return std::make_shared<Result>(mesh(*pasted, call.how));
}

/// If a repaired surface has no mesh in doubles: (repair, mesh) after sheets were joined, or the same two
/// with the limit that ended this. None if there is nothing to join.
py::object mesh_joined_arrays(const py::tuple& surface, const Repair& before, const Result& without,
                              const py::dict& options, const py::object& size, const py::object& metric,
                              const py::object& progress) {
  if (without.outcome != Outcome::not_representable) return py::none();
  Arrays arrays;
  const SurfaceArrays held = surface_from(surface);
  set(arrays, held);
  const MeshCall call(options, size, metric, progress);
  const auto repaired = std::make_shared<Repair>(before);
  const auto result = std::make_shared<Result>(without);
  repaired->options.progress = [&call](double fraction) { return call.watch.go_on("repair", fraction); };
  {
    const py::gil_scoped_release unlocked;
    static_cast<void>(mesh_joined(arrays.view(), call.how, repaired->options, repaired->result, *result));
  }
  repaired->options.progress = {};
  return py::make_tuple(repaired, result);
}

py::tuple diagnose_arrays(const py::tuple& surface, const py::dict& options, const py::object& progress) {
  Arrays arrays;
  const SurfaceArrays held = surface_from(surface);
  set(arrays, held);
  DiagnoseOptions how;
  take_limits(options, how);
  take(options, "most", how.most);
  take(options, "threads", how.threads);
  const Watch watch(progress);
  how.progress = [&watch](double fraction) { return watch.go_on("diagnose", fraction); };
  std::vector<Defect> defects;
  std::string summary;
  {
    const py::gil_scoped_release unlocked;
    defects = diagnose(arrays.view(), how);
    summary = reports::text_of(reports::to_json(summarise(arrays.view(), defects)));
  }
  return py::make_tuple(defects_of(defects), summary);
}

std::string check_arrays(const py::tuple& surface, const Volume& volume, const py::dict& options,
                         const py::object& progress) {
  Arrays arrays;
  const SurfaceArrays held = surface_from(surface);
  set(arrays, held);
  CheckOptions how;
  take_limits(options, how);
  take(options, "outside_dropped", how.outside_dropped);
  take(options, "box", how.box);
  const Watch watch(progress);
  how.progress = [&watch](double fraction) { return watch.go_on("check", fraction); };
  const py::gil_scoped_release unlocked;
  return reports::text_of(reports::to_json(check(arrays.view(), volume, how)));
}

py::array delaunay_points(const py::array& points, const py::dict& options, const py::object& progress) {
  Arrays arrays;
  arrays.set_vertices(view_of(points, 3, "points"));
  DelaunayOptions how;
  take_limits(options, how);
  take(options, "seed", how.seed);
  take(options, "threads", how.threads);
  const Watch watch(progress);
  how.progress = [&watch](double fraction) { return watch.go_on("delaunay", fraction); };
  std::vector<Tetrahedron> tetrahedra;
  {
    const py::gil_scoped_release unlocked;
    tetrahedra = delaunay(arrays.view().vertices, how);
  }
  return array_of(std::move(tetrahedra));
}

std::shared_ptr<UntangleResult> untangle_volume(const Volume& volume, const py::dict& options,
                                                const py::object& progress) {
  UntangleOptions how;
  take_limits(options, how);
  take(options, "fixed", how.fixed);
  take(options, "refill", how.refill);
  take(options, "improve", how.improve);
  take(options, "seed", how.seed);
  const Watch watch(progress);
  how.progress = [&watch](const UntangleProgress& at) { return watch.go_on(name(at.step), at.fraction); };
  const py::gil_scoped_release unlocked;
  return std::make_shared<UntangleResult>(untangle(volume, how));
}

}  // namespace

void register_calls(py::module_& module) {
  py::class_<Result, std::shared_ptr<Result>>(module, "MeshResult")
      .def_property_readonly("outcome", [](const Result& r) { return static_cast<int>(r.outcome); })
      .def_property_readonly("message", [](const Result& r) { return r.message; })
      .def_property_readonly("defects", [](const Result& r) { return defects_of(r.defects); })
      .def_property_readonly("warnings",
                             [](const Result& r) {
                               py::list messages;
                               for (const Warning& w : r.warnings) messages.append(w.message);
                               return messages;
                             })
      .def_property_readonly("n_input_points", [](const Result& r) { return r.report.input.vertices; })
      .def_property_readonly(
          "volume", [](const std::shared_ptr<Result>& r) { return std::shared_ptr<Volume>(r, &r->volume); })
      .def("triangle_regions", [](const Result& r) { return facet_regions(r.facet_regions); })
      .def("report",
           [](const Result& r) { return reports::text_of(reports::to_json(r, reports::Json::object())); });
  py::class_<UntangleResult, std::shared_ptr<UntangleResult>>(module, "UntangleResult")
      .def_property_readonly("outcome", [](const UntangleResult& r) { return static_cast<int>(r.outcome); })
      .def_property_readonly("message", [](const UntangleResult& r) { return r.message; })
      .def_property_readonly("defects", [](const UntangleResult& r) { return defects_of(r.defects); })
      .def_property_readonly(
          "volume",
          [](const std::shared_ptr<UntangleResult>& r) { return std::shared_ptr<Volume>(r, &r->volume); })
      .def("report", [](const UntangleResult& r) {
        return reports::text_of(reports::to_json(r, reports::Json::object()));
      });

  module.def("mesh", &mesh_arrays);
  module.def("mesh_pasted", &mesh_pasted);
  module.def("mesh_joined", &mesh_joined_arrays);
  module.def("diagnose", &diagnose_arrays);
  module.def("check", &check_arrays);
  module.def("delaunay", &delaunay_points);
  module.def("untangle", &untangle_volume);
  module.def("neighbours", [](const Volume& volume) {
    std::vector<Neighbours> found;
    {
      const py::gil_scoped_release unlocked;
      found = neighbours(volume.tetrahedra);
    }
    return array_of(std::move(found));
  });
}

}  // namespace holdfast::python
