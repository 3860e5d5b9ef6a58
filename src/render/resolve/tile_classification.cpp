#include "render/resolve/tile_classification.h"

#include "render/frame/shader_names.h"
#include "shaders/shared/constants.h"

#include <algorithm>
#include <array>

namespace sward::render {

TileClassification::TileClassification(const gpu::DeviceContext& context,
                                       const gpu::ShaderLibrary& shaders, std::uint32_t samples,
                                       bool sorts)
    : context_(&context)
{
    if (sorts)
        sort_ = gpu::ComputePipeline(
            context, shaders,
            {.name = "raster/tiles",
             .shader = shader::sortTiles,
             .pushConstantBytes = sizeof(shared::RasterPush),
             .constants = {{.id = shared::idSamplesPerPixel, .value = samples}}});
}

void TileClassification::resize(VkExtent2D size)
{
    const std::uint32_t words = shared::firstOfTiles(shared::tileLists, size.width, size.height);
    lists_ = gpu::Buffer(*context_, {.name = "raster/tiles",
                                     .bytes = words * sizeof(std::uint32_t),
                                     .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
                                              VK_BUFFER_USAGE_TRANSFER_DST_BIT |
                                              VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT});
    groups_ = static_cast<std::uint32_t>(
        gpu::groupsFor(shared::tilesAlong(size.width, shared::lightTile) *
                           shared::tilesAlong(size.height, shared::lightTile),
                       shared::sortThreads));
}

void TileClassification::clear(const gpu::Recording& commands) const
{
    std::array<shared::WalkLevel, shared::tileLists> none{};
    std::ranges::fill(none, shared::WalkLevel{.groups = {0, 0, 1}, .count = 0});
    commands.vk->CmdUpdateBuffer(commands, lists_.get(), 0, sizeof none, none.data());
}

void TileClassification::record(const gpu::Recording& commands,
                                const shared::RasterPush& push) const
{
    sort_.bind(commands);
    sort_.push(commands, push);
    commands.vk->CmdDispatch(commands, groups_, 1, 1);
}

void TileClassification::dispatch(const gpu::Recording& commands, std::uint32_t list) const
{
    commands.vk->CmdDispatchIndirect(commands, lists_.get(), list * sizeof(shared::WalkLevel));
}

} // namespace sward::render
