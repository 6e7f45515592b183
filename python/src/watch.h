// Calls from a running call into Python, on the thread that made it: signals such as Ctrl-C, and progress.
#pragma once

#include <pybind11/pybind11.h>

#include <utility>

namespace holdfast::python {

namespace py = pybind11;

class Watch {
 public:
  /// `progress` is None or a callable of (stage, fraction); it cancels by returning False.
  explicit Watch(py::object progress) : progress_(std::move(progress)) {}

  /// Called without the interpreter lock. Throws Python's exceptions as py::error_already_set.
  [[nodiscard]] bool go_on(const char* stage, double fraction) const {
    const py::gil_scoped_acquire lock;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (progress_.is_none()) return true;
    const py::object answer = progress_(stage, fraction);
    return !answer.is(py::bool_(false));
  }

 private:
  py::object progress_;
};

}  // namespace holdfast::python
