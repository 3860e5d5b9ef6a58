#include "python/option_table.h"

#include "apps/common/help_text.h"
#include "apps/sward/options/bake_options.h"
#include "apps/sward/options/growth_options.h"
#include "apps/sward_view/scene/frame_options.h"
#include "core/error.h"
#include "python/python_module.h"

#include <CLI/CLI.hpp>

#include <algorithm>

namespace sward::python {
namespace {

namespace py = pybind11;

// Each option that --help lists: what its keyword, its docstring and its type in Python come from.
py::list tableOf(const CLI::App& app)
{
    py::list table;
    for (const CLI::Option* option : app.get_options()) {
        if (option->get_lnames().empty() || option->get_group().empty())
            continue;
        py::dict row;
        row["option"] = "--" + option->get_lnames().front();
        row["value"] = apps::valueName(*option);
        row["group"] = option->get_group();
        row["text"] = apps::describe(*option);
        row["numbers"] = option->get_type_size_max() > 1 || option->get_expected_max() == 2 ? 2
                         : option->get_items_expected_max() == 0                            ? 0
                                                                                            : 1;
        row["repeats"] = option->get_expected_max() >= CLI::detail::expected_max_vector_size;
        table.append(row);
    }
    return table;
}

} // namespace

void parseOptions(CLI::App& app, std::vector<std::string> arguments)
{
    // CLI11 takes the last one first.
    std::reverse(arguments.begin(), arguments.end());
    try {
        app.parse(std::move(arguments));
    } catch (const CLI::ParseError& error) {
        fail(ErrorKind::usage, "{}", error.what());
    }
}

void addOptions(py::module_& module)
{
    module.def("bake_options", [] {
        CLI::App app;
        apps::BakeOptions options;
        options.add(app);
        return tableOf(app);
    });
    module.def("render_options", [] {
        CLI::App app;
        view::FrameOptions options;
        options.addShared(app);
        options.addMeasured(app);
        return tableOf(app);
    });
    module.def("growth_options", [] {
        CLI::App app;
        apps::GrowthOptions options;
        options.add(app);
        return tableOf(app);
    });
}

} // namespace sward::python
