#pragma once

#include "gpu/pipeline/shader_library.h"

namespace sward::test {

/// The shaders of tests/gpu/device/shaders.
const gpu::ShaderLibrary& testShaders();

} // namespace sward::test
