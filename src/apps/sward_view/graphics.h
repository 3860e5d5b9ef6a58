#pragma once

#include "gpu/instance.h"

#include <string>
#include <vector>

namespace sward::view {

/// A connection to Vulkan as the command line asks for it. Throws Error{unsupported} if validation
/// is asked for and its layer is not installed.
gpu::Instance createInstance(bool validation, std::vector<std::string> extensions = {});

/// Throws Error{runtime} with all messages if the validation layer had something to say.
void failOnValidationMessages(const gpu::Instance& instance);

} // namespace sward::view
