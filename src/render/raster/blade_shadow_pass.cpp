#include "render/raster/blade_shadow_pass.h"

#include "core/expect.h"
#include "render/frame/shader_names.h"
#include "render/resident/placed_field.h"
#include "shaders/shared/constants.h"

namespace sward::render {
namespace {

constexpr glm::uvec2 mapSize(shared::bladeShadowTexels);
constexpr VkDeviceSize mapBytes = VkDeviceSize(mapSize.x) * mapSize.y * sizeof(std::uint64_t);

} // namespace

static_assert(shared::maxPatchBlades % shared::bladeShadowThreads == 0);
// The shader that reads the map knows no padding of columns.
static_assert(shared::bladeShadowTexels % 4 == 0);

BladeShadowPass::BladeShadowPass(const gpu::DeviceContext& context, std::uint32_t maxViews)
    : context_(&context)
    , frameLayout_(context, "blade shadow/frame")
    , maps_(maxViews)
{
}

BladeShadowPass::Variant BladeShadowPass::variantOf(const PlacedField& field)
{
    return {.isPaged = field.blades().isPaged(), .looks = field.field().looks};
}

VkDeviceAddress BladeShadowPass::expectMap(std::uint32_t view)
{
    gpu::Buffer& map = maps_[view];
    if (map.get() == VK_NULL_HANDLE)
        map = gpu::Buffer(*context_, {.name = "view/blade shadow",
                                      .bytes = mapBytes,
                                      .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
                                               VK_BUFFER_USAGE_TRANSFER_DST_BIT});
    return map.address();
}

void BladeShadowPass::prepare(const gpu::ShaderLibrary& shaders, const Variant& variant)
{
    if (pipelines_.contains(variant))
        return;
    pipelines_.emplace(
        variant, gpu::ComputePipeline(
                     *context_, shaders,
                     {.name = "blade shadow",
                      .shader = shader::rasterShadow,
                      .pushConstantBytes = sizeof(shared::BladeShadowPush),
                      .setLayouts = {frameLayout_.get()},
                      .constants = {
                          {.id = shared::idSamplesPerPixel, .value = 1u},
                          {.id = shared::idIsPaged, .value = variant.isPaged},
                          {.id = shared::idMayFold, .value = 0u},
                          {.id = shared::idOnlyShape, .value = variant.looks.onlyShape},
                          {.id = shared::idMayHaveOrgans, .value = variant.looks.mayHaveOrgans}}}));
}

void BladeShadowPass::clear(const gpu::Recording& commands, std::uint32_t view) const
{
    commands.vk->CmdFillBuffer(commands, maps_[view].get(), 0, VK_WHOLE_SIZE, 0);
}

void BladeShadowPass::record(const gpu::Recording& commands, std::uint32_t view,
                             const Variant& variant, const VisibleBlades& found,
                             const FramePlace& frame) const
{
    const auto made = pipelines_.find(variant);
    expect(made != pipelines_.end(), "the shadow of blades has been prepared for the field");
    const gpu::ComputePipeline& pipeline = made->second;
    pipeline.bind(commands);
    frame.bind(commands, pipeline.layout(), 0);
    pipeline.push(commands, shared::BladeShadowPush{.visiblePatches = found.visiblePatches(),
                                                    .levels = found.levels().address(),
                                                    .visibility = maps_[view].address(),
                                                    .size = mapSize,
                                                    .firstBlade = 0,
                                                    .reserved = 0});
    commands.vk->CmdDispatch(commands, shared::bladeShadowGroups, 1, 1);
}

VkDeviceSize BladeShadowPass::bytesFor(std::size_t patches)
{
    // A queue, the visible patches, and counts.
    constexpr VkDeviceSize counts = 4096;
    return mapBytes + patches * (sizeof(std::uint32_t) + sizeof(shared::VisiblePatch)) + counts;
}

VkDeviceSize BladeShadowPass::bytes() const
{
    VkDeviceSize sum = 0;
    for (const gpu::Buffer& map : maps_)
        sum += map.bytes();
    return sum;
}

} // namespace sward::render
