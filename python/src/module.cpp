// The extension holdfast._core: the library's calls on numpy arrays. Users import the modules in
// holdfast/*.py.
#include <pybind11/pybind11.h>

#include <chrono>

#include "holdfast/holdfast.h"
#include "holdfast/io.h"
#include "register.h"
#include "text.h"

namespace holdfast::python {
namespace {

py::object error_class(const char* name) { return py::module_::import("holdfast.errors").attr(name); }

void raise(const py::object& error) { PyErr_SetObject(py::type::handle_of(error).ptr(), error.ptr()); }

void translate(std::exception_ptr thrown) {
  if (!thrown) return;
  try {
    std::rethrow_exception(thrown);
  } catch (const FileError& error) {
    raise(error_class("FileError")(message_of(error.what()), file_name_of(error.path()), error.where(),
                                   error.error_number()));
  } catch (const Interrupted& interrupted) {
    raise(py::module_::import("holdfast.errors")
              .attr("_interrupted")(static_cast<int>(interrupted.outcome()), interrupted.what()));
  } catch (const std::invalid_argument&) {
    throw;
  } catch (const std::length_error&) {
    throw;
  } catch (const std::logic_error& error) {
    raise(error_class("InternalError")(error.what()));
  }
}

}  // namespace
}  // namespace holdfast::python

PYBIND11_MODULE(_core, module) {
  namespace py = pybind11;
  using namespace holdfast::python;
  py::register_local_exception_translator(translate);
  module.attr("__version__") = holdfast::version();
  py::class_<holdfast::CancelToken>(
      module, "CancelToken",
      "Stops calls from another thread: give it as `cancel=`, then call `cancel()`.\n\n"
      "A token may be given to many calls; once cancelled it stays so.")
      .def(py::init<>())
      .def("cancel", &holdfast::CancelToken::cancel, "Stops the calls that have this token. From any thread.")
      .def_property_readonly("cancelled", &holdfast::CancelToken::cancelled, "Whether `cancel` was called.");
  module.def(
      "now", [] { return std::chrono::steady_clock::now().time_since_epoch().count(); },
      "What limits call `started`: the time limit of all calls that share it runs from here.");
  register_volume(module);
  register_files(module);
  register_calls(module);
  register_paste(module);
  register_repair(module);
  register_plane(module);
  register_polygons(module);
}
