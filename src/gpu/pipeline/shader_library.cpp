#include "gpu/pipeline/shader_library.h"

#include "core/error.h"
#include "core/expect.h"
#include "gpu/context/check.h"
#include "gpu/context/debug.h"
#include "gpu/pipeline/exact_arithmetic.h"
#include "gpu/pipeline/shared_objects.h"

#include <functional>
#include <string>
#include <vector>

namespace sward::gpu {
namespace {

// First word of every module (SPIR-V specification, 2.3).
constexpr std::uint32_t spirvMagic = 0x07230203;

} // namespace

std::span<const std::uint32_t> ShaderLibrary::code(std::string_view name) const
{
    const std::string fileName = std::string(name) + ".spv";
    std::string known;
    for (const EmbeddedFile& file : files_) {
        if (file.name != fileName) {
            known += ' ' + std::string(file.name);
            continue;
        }
        expect(reinterpret_cast<std::uintptr_t>(file.bytes.data()) % alignof(std::uint32_t) == 0,
               "embedded modules are aligned to words");
        const std::span words(reinterpret_cast<const std::uint32_t*>(file.bytes.data()),
                              file.bytes.size() / sizeof(std::uint32_t));
        if (words.empty() || words[0] != spirvMagic)
            fail(ErrorKind::runtime, "the shader '{}' is not a SPIR-V module", fileName);
        return words;
    }
    fail(ErrorKind::runtime, "there is no shader '{}'; there are{}", fileName, known);
}

void ShaderLibrary::addTo(ObjectKey& key, std::string_view name) const
{
    const auto bytes = std::as_bytes(code(name));
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    key.add(text.size()).add(std::hash<std::string_view>{}(text));
}

ShaderModule ShaderLibrary::module(const DeviceContext& context, std::string_view name,
                                   bool isExact) const
{
    std::span<const std::uint32_t> words = code(name);
    const std::vector<std::uint32_t> exact =
        isExact ? withoutContraction(words) : std::vector<std::uint32_t>();
    if (isExact)
        words = exact;
    VkShaderModuleCreateInfo create{};
    create.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
    create.codeSize = words.size_bytes();
    create.pCode = words.data();
    VkShaderModule module = VK_NULL_HANDLE;
    check(context.vk.CreateShaderModule(context.device, &create, context.allocation, &module),
          "vkCreateShaderModule");
    setName(context, module, std::string(name));
    return {context, module};
}

} // namespace sward::gpu
