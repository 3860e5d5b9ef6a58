#include "apps/sward_view/headless/copy_bandwidth.h"

#include "apps/common/interrupt.h"
#include "core/embedded.h"
#include "core/error.h"
#include "core/json/json_text.h"
#include "gpu/memory/buffer.h"
#include "gpu/memory/readback.h"
#include "gpu/pipeline/compute_pipeline.h"
#include "gpu/pipeline/shader_library.h"
#include "gpu/recording/barrier.h"
#include "gpu/recording/frame_ring.h"
#include "gpu/recording/timestamps.h"
#include "render/frame/shader_names.h"
#include "shaders/shared/passes.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstddef>
#include <span>

namespace sward::embedded {
std::span<const EmbeddedFile> shaders();
} // namespace sward::embedded

namespace sward::view {
namespace {

constexpr std::uint64_t maxBytes = std::uint64_t(1) << 30;
constexpr std::uint64_t maxBytesOfCpu = std::uint64_t(64) << 20;
constexpr std::uint64_t grain = 1u << 16; ///< [bytes]
constexpr std::uint32_t warmUp = 3;       ///< copies
constexpr std::uint32_t filling = 0x5a5a5a5au;

nlohmann::ordered_json timesOf(const gpu::Statistics& times)
{
    return {{"min", times.min}, {"median", times.median}, {"p99", times.p99}};
}

/// Throws Error{runtime} unless the end of the copy equals the source.
void checkCopied(const gpu::DeviceContext& context, const gpu::Buffer& copy)
{
    const auto end = gpu::readBuffer(context, copy, copy.bytes() - grain, grain);
    const auto expected = static_cast<std::byte>(filling & 0xffu);
    if (std::ranges::any_of(end, [&](std::byte found) { return found != expected; }))
        fail(ErrorKind::runtime,
             "{}: {} bytes that a compute shader copied differ from the original", context.name,
             copy.bytes());
}

} // namespace

double CopyBandwidth::gigabytesPerSecond() const
{
    const double median = times().median;
    return median > 0.0 ? 2.0 * static_cast<double>(bytes) / (median * 1e6) : 0.0;
}

CopyBandwidth measureCopies(const gpu::DeviceContext& context, std::uint32_t copies)
{
    CopyBandwidth result;
    result.device = context.name;
    result.driver = context.driver;
    const std::uint64_t most = context.isCpu() ? maxBytesOfCpu : maxBytes;
    result.bytes =
        std::min({most, context.deviceLocalBytes() / 8, context.maxBufferBytes}) / grain * grain;
    const auto make = [&](const char* name) {
        return gpu::Buffer(context, {.name = name,
                                     .bytes = result.bytes,
                                     .usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
                                              VK_BUFFER_USAGE_TRANSFER_DST_BIT |
                                              VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
                                              VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT});
    };
    const gpu::Buffer from = make("copied");
    const gpu::Buffer to = make("copy");
    const gpu::ComputePipeline copy(context, gpu::ShaderLibrary(embedded::shaders()),
                                    {.name = "copy",
                                     .shader = render::shader::copy,
                                     .pushConstantBytes = sizeof(shared::CopyPush)});
    const auto byCommand = [&](VkCommandBuffer commands) {
        const VkBufferCopy region{0, 0, result.bytes};
        vkCmdCopyBuffer(commands, from.get(), to.get(), 1, &region);
    };
    const auto byShader = [&](VkCommandBuffer commands) {
        const auto count = static_cast<std::uint32_t>(result.bytes / sizeof(glm::uvec4));
        copy.bind(commands);
        copy.push(commands,
                  shared::CopyPush{
                      .from = from.address(), .to = to.address(), .count = count, .reserved = 0});
        const std::uint64_t groups = gpu::groupsFor(count, shared::copyThreads);
        vkCmdDispatch(
            commands,
            static_cast<std::uint32_t>(std::min<std::uint64_t>(groups, shared::maxGroups)), 1, 1);
    };

    gpu::FrameRing ring(context, 1);
    gpu::Timestamps timestamps(context, {.slots = 1, .historyFrames = copies});
    for (std::uint32_t i = 0; i < warmUp + copies; ++i) {
        apps::throwIfInterrupted("copying");
        const gpu::FrameRing::Frame frame = ring.begin();
        timestamps.beginFrame(frame.commands, 0);
        gpu::anythingToTransfer(frame.commands);
        if (i == 0)
            vkCmdFillBuffer(frame.commands, from.get(), 0, VK_WHOLE_SIZE, filling);
        const auto timed = [&](const char* name, const auto& record) {
            gpu::memoryBarrier(frame.commands, gpu::anyAccess, gpu::anyAccess);
            const gpu::TimedScope scope(timestamps, context, frame.commands, name);
            record(frame.commands);
        };
        // Run only one method in the first round, to check its copy separately.
        if (i > 0)
            timed("command", byCommand);
        timed("shader", byShader);
        ring.submit(frame);
        ring.finish();
        if (i == 0)
            checkCopied(context, to);
        if (i + 1 == warmUp) {
            timestamps.collect();
            timestamps.clearHistory();
        }
    }
    timestamps.collect();
    result.byCommand = timestamps.statistics("command");
    result.byShader = timestamps.statistics("shader");
    return result;
}

std::string copyText(const CopyBandwidth& copies)
{
    const nlohmann::ordered_json json{{"device", copies.device},
                                      {"driver", copies.driver},
                                      {"bytes", copies.bytes},
                                      {"by", copies.isShaderFaster() ? "shader" : "command"},
                                      {"copy_ms", timesOf(copies.times())},
                                      {"command_ms", timesOf(copies.byCommand)},
                                      {"shader_ms", timesOf(copies.byShader)},
                                      {"gb_per_s", copies.gigabytesPerSecond()}};
    return jsonText(json) + "\n";
}

} // namespace sward::view
