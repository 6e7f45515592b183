// Names of files, which are bytes, and text of files that may be no UTF-8.
#pragma once

#include <pybind11/pybind11.h>

#include <filesystem>
#include <string>

namespace holdfast::python {

namespace py = pybind11;

/// What `open` of Python takes for the name of a file. Throws as it does.
[[nodiscard]] inline std::filesystem::path path_from(const py::object& given) {
  PyObject* bytes = nullptr;
  if (PyUnicode_FSConverter(given.ptr(), &bytes) == 0) throw py::error_already_set();
  return std::string(py::reinterpret_steal<py::bytes>(bytes));
}

/// The name of a file as Python has it.
[[nodiscard]] inline py::object file_name_of(const std::filesystem::path& path) {
  const std::string& name = path.native();
  return py::reinterpret_steal<py::object>(
      PyUnicode_DecodeFSDefaultAndSize(name.data(), static_cast<py::ssize_t>(name.size())));
}

/// For people: what is no UTF-8 is replaced.
[[nodiscard]] inline py::object message_of(const std::string& text) {
  return py::reinterpret_steal<py::object>(
      PyUnicode_DecodeUTF8(text.data(), static_cast<py::ssize_t>(text.size()), "replace"));
}

}  // namespace holdfast::python
