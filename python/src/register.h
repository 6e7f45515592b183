// Parts of the extension module.
#pragma once

#include <pybind11/pybind11.h>

namespace holdfast::python {

namespace py = pybind11;

void register_volume(py::module_& module);
void register_files(py::module_& module);
void register_calls(py::module_& module);
void register_paste(py::module_& module);
void register_repair(py::module_& module);
void register_plane(py::module_& module);
void register_polygons(py::module_& module);

}  // namespace holdfast::python
