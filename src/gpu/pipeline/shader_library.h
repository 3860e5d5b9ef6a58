#pragma once

#include "core/embedded.h"
#include "gpu/context/context.h"
#include "gpu/context/handle.h"

#include <vulkan/vulkan.h>

#include <cstdint>
#include <span>
#include <string_view>

namespace sward::gpu {

using ShaderModule = Owned<VkShaderModule, &DeviceFunctions::DestroyShaderModule>;

class ObjectKey;

/// SPIR-V modules by name: "groundVertex" refers to the file "groundVertex.spv".
class ShaderLibrary {
public:
    /// `files` must outlive the library.
    explicit ShaderLibrary(std::span<const EmbeddedFile> files)
        : files_(files)
    {
    }

    /// The words of a module. Throws Error{runtime} that lists the known names if there is none of
    /// that name, or if it is not SPIR-V.
    std::span<const std::uint32_t> code(std::string_view name) const;

    /// Adds a hash of a module's words. Throws as code() does.
    void addTo(ObjectKey& key, std::string_view name) const;

    /// `isExact`: see withoutContraction().
    ShaderModule module(const DeviceContext& context, std::string_view name,
                        bool isExact = false) const;

private:
    std::span<const EmbeddedFile> files_;
};

} // namespace sward::gpu
