#include "render/resolve/shading_cache.h"

#include <cstdint>

namespace sward::render {
namespace {

constexpr VkDeviceSize wordsOfSurface = 12;

gpu::Buffer bufferOf(const gpu::DeviceContext& context, const char* name, VkDeviceSize words)
{
    return {context,
            {.name = name,
             .bytes = words * sizeof(std::uint32_t),
             .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT}};
}

} // namespace

ShadingCache::ShadingCache(const gpu::DeviceContext& context)
    : places_(bufferOf(context, "raster/places of surfaces", shared::cachePlaceCount))
    , surfaces_(bufferOf(context, "raster/surfaces", wordsOfSurface * shared::maxCachedBlades))
{
}

void ShadingCache::describe(shared::RasterPush& push) const
{
    push.cachePlaces = places_.address();
    push.cachedSurfaces = surfaces_.address();
}

} // namespace sward::render
