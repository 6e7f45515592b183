// Options of calls out of keyword arguments.
#pragma once

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "holdfast/limits.h"

namespace holdfast::python {

namespace py = pybind11;

/// Sets `to` where the dictionary has a value that is not None.
template <class Value>
void take(const py::dict& options, const char* name, Value& to) {
  if (options.contains(name) && !options[name].is_none()) to = py::cast<Value>(options[name]);
}

inline void take_limits(const py::dict& options, Limits& limits) {
  take(options, "time_limit", limits.time_limit);
  take(options, "memory_limit", limits.memory_limit);
  CancelToken token;
  if (options.contains("cancel") && !options["cancel"].is_none()) {
    take(options, "cancel", token);
    limits.cancel = token;
  }
}

}  // namespace holdfast::python
