#include "apps/sward/bake_run.h"
#include "apps/sward/options/bake_options.h"
#include "apps/sward/options/effective_settings.h"
#include "core/files/mapped_file.h"
#include "python/field.h"
#include "python/inputs.h"
#include "python/option_table.h"
#include "python/python_module.h"
#include "python/work.h"

#include <CLI/CLI.hpp>
#include <pybind11/stl.h>

#include <memory>
#include <utility>
#include <vector>

namespace sward::python {
namespace {

namespace py = pybind11;
using Arguments = std::vector<std::string>;

// The request of these options; images and meadows are read.
apps::BakeRequest requestOf(const Arguments& arguments, const Inputs& inputs, bool printsConfig)
{
    CLI::App app;
    apps::BakeOptions options;
    options.add(app);
    options.needsOutput = false;
    options.given = inputs.given();
    parseOptions(app, arguments);
    options.printConfig = printsConfig;
    return options.request();
}

std::shared_ptr<Field> bake(const Arguments& arguments, const Inputs& inputs,
                            const py::object& callback)
{
    forgetReadFiles();
    Diagnostics diagnostics;
    std::shared_ptr<Field> field;
    work(callback, [&](Progress& progress) {
        apps::BakeRequest request = requestOf(arguments, inputs, false);
        field::Field kept;
        const bake::Report report = apps::runBake(request, {.kept = &kept}, diagnostics, progress);
        if (request.output.empty()) {
            field = std::make_shared<Field>(std::move(kept), request.inputs.front(),
                                            bake::toJson(report));
            return;
        }
        field = std::make_shared<Field>(std::filesystem::path(request.output));
        field->report = bake::toJson(report);
    });
    issueWarnings(diagnostics);
    return field;
}

std::string estimate(Arguments arguments, const Inputs& inputs, const py::object& callback)
{
    forgetReadFiles();
    Diagnostics diagnostics;
    std::string text;
    work(callback, [&](Progress& progress) {
        apps::BakeRequest request = requestOf(arguments, inputs, false);
        request.dryRun = true;
        text = bake::toJson(apps::runBake(request, {}, diagnostics, progress));
    });
    issueWarnings(diagnostics);
    return text;
}

std::string settings(const Arguments& arguments, const Inputs& inputs)
{
    return apps::effectiveSettings(requestOf(arguments, inputs, true));
}

} // namespace

void addBake(py::module_& module)
{
    py::class_<Inputs>(module, "Inputs")
        .def(py::init())
        .def("set_mesh", &Inputs::setMesh)
        .def("set_heights", &Inputs::setHeights)
        .def("add_mask", &Inputs::addMask)
        .def("set_strokes", &Inputs::setStrokes)
        .def("set_meadow", &Inputs::setMeadow);
    module.def("bake", bake);
    module.def("estimate", estimate);
    module.def("settings", settings);
}

} // namespace sward::python
