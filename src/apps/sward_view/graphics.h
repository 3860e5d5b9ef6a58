#pragma once

#include "gpu/device/instance.h"

#include <string>
#include <vector>

namespace sward::view {

/// Creates a Vulkan instance. Throws Error{unsupported} if `validation` is set and its layer is not
/// installed.
gpu::Instance createInstance(bool validation, std::vector<std::string> extensions = {});

/// Throws Error{runtime} with all messages of the validation layer, if there are any.
void failOnValidationMessages(const gpu::Instance& instance);

} // namespace sward::view
