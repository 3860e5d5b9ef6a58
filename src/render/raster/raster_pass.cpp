#include "render/raster/raster_pass.h"

#include "core/expect.h"
#include "gpu/memory/image_use.h"
#include "gpu/recording/barrier.h"

namespace sward::render {
namespace {

/// Descriptor set of the frame.
constexpr std::uint32_t frameSet = 0;

bool isBgr(VkFormat format)
{
    return format == VK_FORMAT_B8G8R8A8_SRGB;
}

/// Bytes of a shared::VisibilityArray.
VkDeviceSize visibilityBytes(VkExtent2D size, std::uint32_t samples)
{
    return VkDeviceSize(size.width) * shared::rowsOfColumn(size.height) * samples *
           sizeof(std::uint64_t);
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

RasterPass::RasterPass(const gpu::DeviceContext& context, const gpu::ShaderLibrary& shaders,
                       const TargetSettings& target, std::uint32_t bladeCount)
    : context_(&context)
    , target_(target)
    , frameLayout_(context, "raster/frame")
    , largeList_(context, {.large = target.groupsDrawLarge,
                           .shownBlades = target.groupsDrawLarge ? bladeCount : 0})
{
    expect(obstacleToRaster(context, target.colorFormat) == nullptr, "the device can rasterise");
    const auto pipeline = [&](const char* name, const char* shader, std::uint32_t largeTo,
                              bool fillsAll = false) {
        return gpu::ComputePipeline(context, shaders,
                                    {.name = name,
                                     .shader = shader,
                                     .pushConstantBytes = sizeof(shared::RasterPush),
                                     .setLayouts = {frameLayout_.get()},
                                     .constants = {{.id = 1, .value = target.samples},
                                                   {.id = 2, .value = fillsAll},
                                                   {.id = 3, .value = target.mayBePaged},
                                                   {.id = 4, .value = largeTo},
                                                   {.id = 11, .value = target.mayFold},
                                                   {.id = 14, .value = target.onlyShape},
                                                   {.id = 17, .value = target.mayHaveOrgans}}});
    };
    const std::uint32_t untold = shared::largeToNone;
    const std::uint32_t largeTo =
        target.groupsDrawLarge ? shared::largeToGroups : shared::largeToNone;
    blades_ = pipeline("raster/blades", "raster_blades.comp", largeTo);
    cut_ = pipeline("raster/cut blades", "raster_cut.comp", untold);
    depths_ = pipeline("raster/depths", "seen_depths.comp", untold);
    allDepths_ = pipeline("raster/all depths", "seen_depths.comp", untold, true);
    if (target.groupsDrawLarge) {
        large_ = pipeline("raster/large blades", "raster_large.comp", untold);
        lateBlades_ = pipeline("raster/late blades", "list_late.comp", untold);
        shadingCache_.emplace(context, target);
        lateLarge_ = pipeline("raster/late large blades", "raster_late.comp", untold);
    }
}

void RasterPass::prepare(const gpu::ShaderLibrary& shaders, Shading shading)
{
    expect(!shading.hasShadingCache || shadingCache_, "work-groups draw large blades");
    if (shading.hasShadingCache)
        shadingCache_->prepare(shaders, shading);
}

void RasterPass::resize(VkExtent2D size)
{
    size_ = size;
    isEmpty_ = false;
    visibility_ = gpu::Buffer(*context_, {.name = "frame/visibility",
                                          .bytes = visibilityBytes(size_, target_.samples),
                                          .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
                                                   VK_BUFFER_USAGE_TRANSFER_DST_BIT});
}

void RasterPass::expectBlades(std::uint32_t blades, OutgrownBuffers& outgrown)
{
    if (!largeList_.hasRoomFor(blades))
        outgrown.push_back({largeList_.growShown(*context_, blades), VK_NULL_HANDLE});
}

shared::RasterPush RasterPass::pushFor(const Input& input) const
{
    shared::RasterPush push{.frame = input.frame.address,
                            .cullView = input.cullView.address,
                            .visibility = visibility_.address(),
                            .rounds = input.field->list().rounds().address(),
                            .large = 0,
                            .largeCount = 0,
                            .cut = 0,
                            .nonEmptyPatches = input.field->baked().nonEmptyPatches(),
                            .firstNonEmptyPatches = input.field->baked().firstNonEmptyPatches(),
                            .seen = input.findsHidden ? largeList_.shown().quarters : 0,
                            .surfacePlaces = 0,
                            .surfaces = 0,
                            .tiles = 0,
                            .size = {size_.width, size_.height},
                            .isBgr = isBgr(target_.colorFormat) ? 1u : 0u,
                            .round = 0,
                            .firstBlade = input.firstBlade,
                            .instance = 0};
    largeList_.describe(push);
    if (shadingCache_)
        shadingCache_->describe(push);
    return push;
}

VkDeviceSize RasterPass::bytes() const
{
    return visibility_.bytes() + largeList_.bytes() + (shadingCache_ ? shadingCache_->bytes() : 0);
}

void RasterPass::recordBegin(const gpu::Recording& commands)
{
    if (!isEmpty_)
        commands.vk->CmdFillBuffer(commands, visibility_.get(), 0, VK_WHOLE_SIZE, 0);
    isEmpty_ = true;
    largeList_.clear(commands);
    largeList_.beginShown(commands);
}

void RasterPass::recordBlades(const gpu::Recording& commands, const Input& input,
                              std::uint32_t round, Phase phase) const
{
    shared::RasterPush push = pushFor(input);
    push.round = phase == Phase::late ? input.field->list().roundCount() + round : round;
    const gpu::ComputePipeline& pipeline = phase == Phase::late ? lateBlades_ : blades_;
    pipeline.bind(commands);
    input.frame.bind(commands, pipeline.layout(), frameSet);
    pipeline.push(commands, push);
    commands.vk->CmdDispatchIndirect(commands, input.field->list().rounds().get(),
                                     push.round * sizeof(shared::WalkLevel));
}

void RasterPass::recordLarge(const gpu::Recording& commands, const Input& input, Phase phase) const
{
    const shared::RasterPush push = pushFor(input);
    const auto bind = [&](const gpu::ComputePipeline& pipeline) {
        pipeline.bind(commands);
        input.frame.bind(commands, pipeline.layout(), frameSet);
        pipeline.push(commands, push);
    };
    if (target_.groupsDrawLarge && phase == Phase::late) {
        bind(lateLarge_);
        largeList_.dispatchLate(commands);
    } else if (target_.groupsDrawLarge) {
        bind(large_);
        largeList_.dispatch(commands);
        // Blades in the visibility history are likely visible. Dispatches as many work-groups as
        // listed blades; they store into the shading cache.
        if (input.findsHidden)
            shadingCache_->record(commands, push, input.frame, input.field->list().rounds().get());
    }
    bind(cut_);
    largeList_.dispatchCut(commands);
}

void RasterPass::recordDepths(const gpu::Recording& commands, const Input& input,
                              Levels levels) const
{
    const auto groups = [](std::uint32_t pixels) {
        return static_cast<std::uint32_t>(
            gpu::groupsFor(shared::pyramidCells(pixels, 0), shared::pyramidThreads));
    };
    const gpu::ComputePipeline& pipeline = levels == Levels::all ? allDepths_ : depths_;
    pipeline.bind(commands);
    pipeline.push(commands, pushFor(input));
    commands.vk->CmdDispatch(commands, groups(size_.width), groups(size_.height), 1);
}

} // namespace sward::render
