#include "test_shaders.h"

namespace sward::embedded {
std::span<const EmbeddedFile> gpuTestShaders();
} // namespace sward::embedded

namespace sward::test {

const gpu::ShaderLibrary& testShaders()
{
    static const gpu::ShaderLibrary library(embedded::gpuTestShaders());
    return library;
}

} // namespace sward::test
