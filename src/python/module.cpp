#include "apps/common/version.h"
#include "core/log.h"
#include "python/python_module.h"

PYBIND11_MODULE(_native, module)
{
    using namespace sward;
    // Results are returned, and warnings are Python's: no line on stderr but of what has neither.
    log::setLevel(log::Level::warning);
    module.attr("version") = apps::versionText("sward").substr(sizeof("sward"));
    python::addErrors(module);
    python::addOptions(module);
    python::addField(module);
    python::addBake(module);
    python::addSession(module);
    python::addRenderer(module);
}
