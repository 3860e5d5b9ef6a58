#include "apps/sward_view/copy_bandwidth.h"

#include "apps/common/interrupt.h"
#include "gpu/barrier.h"
#include "gpu/buffer.h"
#include "gpu/frame_ring.h"
#include "gpu/timestamps.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace sward::view {
namespace {

constexpr std::uint64_t mostBytes = std::uint64_t(1) << 30;
constexpr std::uint64_t mostBytesOfCpu = std::uint64_t(64) << 20;
constexpr std::uint64_t grain = 1u << 16; ///< [bytes]
constexpr std::uint32_t warmUp = 3;       ///< copies

} // namespace

double CopyBandwidth::gigabytesPerSecond() const
{
    return times.median > 0.0 ? 2.0 * static_cast<double>(bytes) / (times.median * 1e6) : 0.0;
}

CopyBandwidth measureCopies(const gpu::DeviceContext& context, std::uint32_t copies)
{
    CopyBandwidth result;
    result.device = context.name;
    result.driver = context.driver;
    const std::uint64_t most = context.isCpu() ? mostBytesOfCpu : mostBytes;
    result.bytes =
        std::min({most, context.deviceLocalBytes() / 8, context.maxBufferBytes}) / grain * grain;
    const gpu::Buffer from(
        context, {.name = "copied",
                  .bytes = result.bytes,
                  .usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT});
    const gpu::Buffer to(
        context,
        {.name = "copy", .bytes = result.bytes, .usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT});
    gpu::FrameRing ring(context, 1);
    gpu::Timestamps timestamps(context, {.slots = 1});
    for (std::uint32_t i = 0; i < warmUp + copies; ++i) {
        apps::throwIfInterrupted("copying");
        const gpu::FrameRing::Frame frame = ring.begin();
        timestamps.beginFrame(frame.commands, 0);
        gpu::anythingToTransfer(frame.commands);
        if (i == 0)
            vkCmdFillBuffer(frame.commands, from.get(), 0, VK_WHOLE_SIZE, 0x5a5a5a5au);
        gpu::anythingToTransfer(frame.commands);
        {
            const gpu::TimedScope scope(timestamps, context, frame.commands, "copy");
            const VkBufferCopy region{0, 0, result.bytes};
            vkCmdCopyBuffer(frame.commands, from.get(), to.get(), 1, &region);
        }
        ring.submit(frame);
        ring.finish();
        if (i + 1 == warmUp) {
            timestamps.collect();
            timestamps.clearHistory();
        }
    }
    timestamps.collect();
    result.times = timestamps.statistics("copy");
    return result;
}

std::string copyText(const CopyBandwidth& copies)
{
    const nlohmann::ordered_json json{
        {"device", copies.device},
        {"driver", copies.driver},
        {"bytes", copies.bytes},
        {"copy_ms",
         {{"min", copies.times.min}, {"median", copies.times.median}, {"p99", copies.times.p99}}},
        {"gb_per_s", copies.gigabytesPerSecond()}};
    return json.dump() + "\n";
}

} // namespace sward::view
