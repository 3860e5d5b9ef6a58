#include "apps/sward_view/graphics.h"

#include "core/error.h"

#include <utility>

namespace sward::view {

gpu::Instance createInstance(bool validation, std::vector<std::string> extensions)
{
    gpu::Instance instance({.application = "sward-view",
                            .validation = validation,
                            .extensions = std::move(extensions)});
    if (validation && !instance.isValidating())
        fail(ErrorKind::unsupported,
             "--validation: the Vulkan validation layer is not installed; Debian's package is "
             "vulkan-validationlayers");
    return instance;
}

void failOnValidationMessages(const gpu::Instance& instance)
{
    const std::size_t count = instance.validationLog().count();
    if (count > 0)
        fail(ErrorKind::runtime, "{} validation message{}:\n{}", count, count == 1 ? "" : "s",
             instance.validationLog().text());
}

} // namespace sward::view
