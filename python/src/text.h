// Names of files, which are bytes, and text of files that may not be UTF-8.
#pragma once

#include <pybind11/pybind11.h>

#include <filesystem>
#include <string>

namespace holdfast::python {

namespace py = pybind11;

/// Any file name that Python's `open` accepts. Throws the same errors as `open`.
[[nodiscard]] inline std::filesystem::path path_from(const py::object& given) {
  PyObject* bytes = nullptr;
  if (PyUnicode_FSConverter(given.ptr(), &bytes) == 0) throw py::error_already_set();
  return std::string(py::reinterpret_steal<py::bytes>(bytes));
}

/// The name of a file as Python writes it.
[[nodiscard]] inline py::object file_name_of(const std::filesystem::path& path) {
  const std::string& name = path.native();
  return py::reinterpret_steal<py::object>(
      PyUnicode_DecodeFSDefaultAndSize(name.data(), static_cast<py::ssize_t>(name.size())));
}

/// For human readers: bytes that are not UTF-8 are replaced.
[[nodiscard]] inline py::object message_of(const std::string& text) {
  return py::reinterpret_steal<py::object>(
      PyUnicode_DecodeUTF8(text.data(), static_cast<py::ssize_t>(text.size()), "replace"));
}

}  // namespace holdfast::python
