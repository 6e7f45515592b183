// Reads options of calls from keyword arguments.
#pragma once

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <chrono>
#include <string>
#include <type_traits>

#include "holdfast/limits.h"

namespace holdfast::python {

namespace py = pybind11;

/// The value of an option; errors about its type or range give the option's name.
template <class Value>
Value value_of(const py::dict& options, const char* name) {
  const py::object given = options[name];
  try {
    return py::cast<Value>(given);
  } catch (const py::cast_error&) {
    const std::string what = std::string(name) + "=" + std::string(py::repr(given));
    if (std::is_arithmetic_v<Value> && PyNumber_Check(given.ptr()) != 0)
      throw py::value_error(what + " is out of range");
    throw py::type_error(what + " is of a wrong type");
  }
}

/// Sets `to` if the dictionary has a value other than None.
template <class Value>
void take(const py::dict& options, const char* name, Value& to) {
  if (options.contains(name) && !options[name].is_none()) to = value_of<Value>(options, name);
}

inline void take_limits(const py::dict& options, Limits& limits) {
  take(options, "time_limit", limits.time_limit);
  take(options, "memory_limit", limits.memory_limit);
  using Clock = std::chrono::steady_clock;
  if (options.contains("started"))
    limits.started = Clock::time_point(Clock::duration(value_of<Clock::duration::rep>(options, "started")));
  CancelToken token;
  if (options.contains("cancel") && !options["cancel"].is_none()) {
    take(options, "cancel", token);
    limits.cancel = token;
  }
}

}  // namespace holdfast::python
