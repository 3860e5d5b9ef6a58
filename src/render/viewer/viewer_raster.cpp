#include "render/viewer/viewer_raster.h"

#include "core/expect.h"

#include <functional>

namespace sward::render {
namespace {

bool isBgr(VkFormat format)
{
    return format == VK_FORMAT_B8G8R8A8_SRGB;
}

} // namespace

const char* obstacleToRaster(const gpu::DeviceContext& context, VkFormat colorFormat)
{
    if (!context.features.bufferInt64Atomics)
        return "the device has no 64-bit atomics on buffers (shaderBufferInt64Atomics)";
    if (colorFormat != VK_FORMAT_R8G8B8A8_SRGB && !isBgr(colorFormat))
        return "the target is neither R8G8B8A8_SRGB nor B8G8R8A8_SRGB";
    return nullptr;
}

ViewerRaster::ViewerRaster(const gpu::DeviceContext& context, const TargetSettings& target,
                           std::uint32_t bladeCount)
    : context_(&context)
    , target_(target)
    , pass_(context)
    , shadingPass_(context)
    , large_(context, target.groupsDrawLarge)
{
    expect(obstacleToRaster(context, target.colorFormat) == nullptr, "the device can rasterise");
    if (!target.groupsDrawLarge)
        return;
    if (bladeCount > 0)
        history_ = VisibilityHistory(context, bladeCount);
    shadingCache_.emplace(context);
}

RasterPass::Variant ViewerRaster::variant() const
{
    return {.samples = target_.samples,
            .isPaged = target_.mayBePaged,
            .groupsDrawLarge = target_.groupsDrawLarge,
            .looks = target_.looks};
}

RasterPass::Instance ViewerRaster::instanceOf(const Input& input) const
{
    return {.frame = input.frame,
            .list = &input.field->list(),
            .variant = variant(),
            .push = pushFor(input)};
}

RasterPass::View ViewerRaster::viewOf(const RasterPass::Instance& instance) const
{
    return {.instances = {&instance, 1}, .variant = variant(), .large = &large_, .size = size_};
}

void ViewerRaster::prepare(const gpu::ShaderLibrary& shaders, Shading shading)
{
    expect(!shading.hasShadingCache || shadingCache_, "work-groups draw large blades");
    const RasterPass::Variant wanted = variant();
    pass_.prepare(shaders, {&wanted, 1}, target_.groupsDrawLarge);
    pass_.prepareAllDepths(shaders, wanted);
    cachePipeline_ = nullptr;
    if (shading.hasShadingCache)
        cachePipeline_ = &shadingPass_.prepare(
            shaders, {.samples = target_.samples, .shading = shading, .looks = target_.looks});
}

void ViewerRaster::resize(VkExtent2D size)
{
    size_ = {size.width, size.height};
    isEmpty_ = false;
    visibility_ = gpu::Buffer(*context_, {.name = "frame/visibility",
                                          .bytes = visibilityBytes(size_, target_.samples),
                                          .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
                                                   VK_BUFFER_USAGE_TRANSFER_DST_BIT});
}

void ViewerRaster::expectBlades(std::uint32_t blades, OutgrownBuffers& outgrown)
{
    if (!history_.hasRoomFor(blades))
        outgrown.push_back({history_.grow(*context_, blades), VK_NULL_HANDLE});
}

shared::RasterPush ViewerRaster::pushFor(const Input& input) const
{
    shared::RasterPush push = {};
    push.frame = input.frame.address;
    push.cullView = input.cullView.address;
    push.visibility = visibility_.address();
    push.rounds = input.field->list().rounds().address();
    push.nonEmptyPatches = input.field->baked().nonEmptyPatches();
    push.firstNonEmptyPatches = input.field->baked().firstNonEmptyPatches();
    push.history = input.hasTwoPasses ? history_.address() : 0;
    push.size = size_;
    push.isBgr = isBgr(target_.colorFormat) ? 1u : 0u;
    push.firstBlade = input.firstBlade;
    large_.describe(push);
    if (shadingCache_)
        shadingCache_->describe(push);
    return push;
}

VkDeviceSize ViewerRaster::bytes() const
{
    return visibility_.bytes() + large_.bytes() + history_.bytes() +
           (shadingCache_ ? shadingCache_->bytes() : 0);
}

void ViewerRaster::recordBegin(const gpu::Recording& commands)
{
    if (!isEmpty_)
        commands.vk->CmdFillBuffer(commands, visibility_.get(), 0, VK_WHOLE_SIZE, 0);
    isEmpty_ = true;
    large_.clear(commands);
    history_.begin(commands);
}

void ViewerRaster::recordDepths(const gpu::Recording& commands, const Input& input) const
{
    const RasterPass::Instance instance = instanceOf(input);
    pass_.recordDepths(commands, viewOf(instance), RasterPass::Levels::all);
}

void ViewerRaster::recordRounds(const gpu::Recording& commands, const Input& input,
                                const MovingBlades& blades, std::uint32_t rounds,
                                gpu::Timestamps* timestamps) const
{
    const RasterPass::Instance instance = instanceOf(input);
    const RasterPass::View view = viewOf(instance);
    UpdateCullPass::History history;
    if (input.hasTwoPasses)
        history = {.address = history_.address(), .frame = history_.frame()};
    const auto list = [&](std::uint32_t round) {
        blades.moveAndList(commands, input.cullView, round, history, timestamps);
    };
    RasterRounds{.context = *context_,
                 .pass = pass_,
                 .view = view,
                 .hasTwoPasses = input.hasTwoPasses,
                 .shadingCache = input.hasTwoPasses ? cachePipeline_ : nullptr,
                 .rounds = rounds,
                 .list = std::ref(list)} // a reference allocates nothing while recording
        .record(commands, timestamps);
}

} // namespace sward::render
