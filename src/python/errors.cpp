#include "core/error_name.h"
#include "python/python_module.h"
#include "python/work.h"

#include <exception>
#include <filesystem>
#include <string>

namespace sward::python {
namespace {

namespace py = pybind11;

// Raises sward.Error.
void raise(ErrorKind kind, const std::string& message)
{
    const py::object type = py::module_::import("sward._errors").attr("Error");
    const py::object error = type(textOf(message), nameOf(kind), static_cast<int>(kind));
    PyErr_SetObject(type.ptr(), error.ptr());
}

} // namespace

void addErrors(py::module_& /*module*/)
{
    py::register_exception_translator([](std::exception_ptr pointer) {
        try {
            if (pointer)
                std::rethrow_exception(pointer);
        } catch (const Error& error) {
            raise(error.kind(), error.what());
        } catch (const std::filesystem::filesystem_error& error) {
            raise(ErrorKind::io, error.path1().string() + ": " + error.code().message());
        }
    });
}

} // namespace sward::python
