#pragma once

#include "gpu/context/context.h"
#include "gpu/memory/buffer.h"
#include "shaders/shared/passes.h"

#include <vulkan/vulkan.h>

namespace sward::render {

/// Shading data of large blades, for all pixels that show them. Of one field; views are drawn one
/// after another, and share the cache.
class ShadingCache {
public:
    explicit ShadingCache(const gpu::DeviceContext& context);

    void describe(shared::RasterPush& push) const; ///< addresses
    VkDeviceSize bytes() const { return places_.bytes() + surfaces_.bytes(); }

private:
    gpu::Buffer places_;   ///< see RasterPush::cachePlaces
    gpu::Buffer surfaces_; ///< see RasterPush::cachedSurfaces
};

} // namespace sward::render
