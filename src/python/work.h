#pragma once

#include "core/diagnostics.h"
#include "core/progress.h"

#include <pybind11/pybind11.h>

#include <functional>
#include <string>

namespace sward::python {

/// Carries out `task` in a thread of its own, without the interpreter's lock. The calling thread
/// meanwhile calls `callback(fraction, text)` for each step of progress, unless it is None, and
/// looks for signals. A signal whose handler raises (Ctrl-C: KeyboardInterrupt), or an exception of
/// the callback, cancels the task, and is raised when it has ended. Throws what `task` throws.
/// Touch no Python object in `task`.
void work(const pybind11::object& callback, const std::function<void(Progress&)>& task);

/// A text of Python; what is no UTF-8, as in names of files, becomes what os.fsdecode() makes of
/// it.
pybind11::object textOf(const std::string& text);

/// Issues each warning as a sward.Warning. Throws if the user's filters make an exception of it.
void issueWarnings(const Diagnostics& diagnostics);

} // namespace sward::python
