#pragma once

/// Names of the shader modules in the library's ShaderLibrary: see shaders/modules.def.
namespace sward::render::shader {

#define SHADER_MODULE(name, source, definitions) inline constexpr const char* name = #name;
#include "shaders/modules.def"
#undef SHADER_MODULE

} // namespace sward::render::shader
