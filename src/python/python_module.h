#pragma once

#include <pybind11/pybind11.h>

namespace sward::python {

// Each adds its part to the native module `sward._native`. The Python files in src/python/sward
// make the public module of it: they check arguments, and hold docstrings and types.

void addErrors(pybind11::module_& module);   ///< Error becomes sward.Error
void addOptions(pybind11::module_& module);  ///< tables of the programs' options
void addBake(pybind11::module_& module);     ///< Inputs, bake(), estimate(), settings()
void addField(pybind11::module_& module);    ///< Field, read(), compare(), views
void addSession(pybind11::module_& module);  ///< Session
void addRenderer(pybind11::module_& module); ///< Renderer

} // namespace sward::python
