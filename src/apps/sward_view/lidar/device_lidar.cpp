#include "apps/sward_view/lidar/device_lidar.h"

#include "core/embedded.h"
#include "gpu/memory/upload.h"
#include "gpu/pipeline/shader_library.h"
#include "gpu/recording/barrier.h"
#include "gpu/recording/frame_ring.h"
#include "gpu/recording/timestamps.h"
#include "render/frame/shader_names.h"

#include <algorithm>
#include <future>
#include <numeric>
#include <span>
#include <string>

namespace sward::embedded {
std::span<const EmbeddedFile> shaders();
} // namespace sward::embedded

namespace sward::view {
namespace {

// Rays and beams of a batch. A GPU needs many threads; a CPU is to answer signals.
constexpr std::uint32_t raysOfBatch = 1u << 22;
constexpr std::uint32_t raysOfCpuBatch = 1u << 16;
constexpr std::uint32_t maxBeamsOfBatch = 1u << 20;

// Beams whose returns make one part.
constexpr std::uint32_t beamsOfPart = 4096;

constexpr VkBufferUsageFlags readByShaders =
    VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;

/// A buffer that holds these elements.
template <typename T>
gpu::Buffer filled(const gpu::DeviceContext& context, gpu::Uploader& upload, const char* name,
                   const std::vector<T>& elements)
{
    gpu::Buffer buffer(
        context, {.name = name, .bytes = elements.size() * sizeof(T), .usage = readByShaders});
    upload.toBuffer(buffer, std::span<const T>(elements));
    return buffer;
}

/// Calls work(first, end) for parts of [0, count) on several threads.
template <typename Work>
void shareOut(std::size_t count, unsigned threads, const Work& work)
{
    const std::size_t share = std::max<std::size_t>(1, (count + threads - 1) / threads);
    std::vector<std::future<void>> tasks;
    for (std::size_t first = share; first < count; first += share)
        tasks.push_back(std::async(std::launch::async,
                                   [&, first] { work(first, std::min(count, first + share)); }));
    work(0, std::min(count, share));
    for (std::future<void>& task : tasks)
        task.get();
}

double sumOfTimes(const gpu::Timestamps& timestamps)
{
    double sum = 0.0;
    for (const std::string& name : timestamps.names()) {
        const std::vector<double> times = timestamps.history(name);
        sum = std::accumulate(times.begin(), times.end(), sum);
    }
    return sum;
}

} // namespace

DeviceLidar::DeviceLidar(const gpu::DeviceContext& context, const lidar::RayTree& tree,
                         glm::dvec3 origin, const lidar::LidarSettings& settings, unsigned threads)
    : context_(context)
    , origin_(origin)
    , seed_(settings.seed)
    , threads_(threads)
{
    lidar::requireSettings(settings);
    sensor_ = lidar::sensorOf(settings);
    const std::uint32_t rays = context.isCpu() ? raysOfCpuBatch : raysOfBatch;
    beamsAtOnce_ = std::clamp(rays / sensor_.rays, 1u, maxBeamsOfBatch);

    gpu::Uploader upload(context);
    nodes_ = filled(context, upload, "lidar/nodes", tree.nodes);
    quads_ = filled(context, upload, "lidar/quads", tree.quads);
    places_ = filled(context, upload, "lidar/places", lidar::spiralOf(sensor_.rays));
    reflectances_ = filled(context, upload, "lidar/reflectances", lidar::reflectancesOf(settings));
    upload.finish();

    const auto make = [&](const char* name, std::uint64_t bytes, VkBufferUsageFlags usage,
                          gpu::MemoryUse memory) {
        return gpu::Buffer(context, {.name = name,
                                     .bytes = bytes,
                                     .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | usage,
                                     .memory = memory});
    };
    const std::uint64_t count = beamsAtOnce_;
    const std::uint64_t returns = count * std::min(sensor_.rays, sensor_.maxReturns);
    beams_ = make("lidar/beams", count * sizeof(shared::LidarBeam),
                  VK_BUFFER_USAGE_TRANSFER_DST_BIT, gpu::MemoryUse::device);
    ends_ = make("lidar/ends", count * sensor_.rays * sizeof(shared::LidarEnd), 0,
                 gpu::MemoryUse::device);
    totals_ = make("lidar/totals", sizeof(shared::LidarTotals),
                   VK_BUFFER_USAGE_TRANSFER_DST_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                   gpu::MemoryUse::device);
    for (Batch& batch : batches_) {
        batch.sent = make("lidar/sent", count * sizeof(shared::LidarBeam),
                          VK_BUFFER_USAGE_TRANSFER_SRC_BIT, gpu::MemoryUse::upload);
        batch.echoes =
            make("lidar/echoes", returns * sizeof(shared::LidarEcho), 0, gpu::MemoryUse::readback);
        batch.runs = make("lidar/runs", count * sizeof(std::uint32_t), 0, gpu::MemoryUse::readback);
        batch.totals = make("lidar/totals read", sizeof(shared::LidarTotals),
                            VK_BUFFER_USAGE_TRANSFER_DST_BIT, gpu::MemoryUse::readback);
        batch.beams.resize(count);
    }
    const gpu::ShaderLibrary shaders(embedded::shaders());
    cast_ = gpu::ComputePipeline(context, shaders,
                                 {.name = "lidar/cast",
                                  .shader = render::shader::castRays,
                                  .pushConstantBytes = sizeof(shared::LidarPush)});
    gather_ = gpu::ComputePipeline(context, shaders,
                                   {.name = "lidar/gather",
                                    .shader = render::shader::gatherReturns,
                                    .pushConstantBytes = sizeof(shared::LidarPush)});
}

void DeviceLidar::fill(Batch& batch, const lidar::Beams& beams) const
{
    const std::span<shared::LidarBeam> sent = batch.sent.mappedAs<shared::LidarBeam>();
    shareOut(batch.count, threads_, [&](std::size_t first, std::size_t end) {
        for (std::size_t i = first; i < end; ++i) {
            batch.beams[i] = beams.beam(batch.first + i);
            sent[i] = lidar::castBeam(batch.beams[i], batch.first + i, origin_, seed_);
        }
    });
}

shared::LidarPush DeviceLidar::pushOf(const Batch& batch) const
{
    shared::LidarPush push = {};
    push.tree.nodes.address = nodes_.address();
    push.tree.quads.address = quads_.address();
    push.beams = beams_.address();
    push.places = places_.address();
    push.reflectances = reflectances_.address();
    push.ends.address = ends_.address();
    push.echoes = batch.echoes.address();
    push.runs = batch.runs.address();
    push.totals = totals_.address();
    push.sensor = sensor_;
    push.beamCount = batch.count;
    return push;
}

lidar::ReturnParts DeviceLidar::returnsOf(const Batch& batch) const
{
    const auto runs = batch.runs.mappedAs<const std::uint32_t>();
    const auto echoes = batch.echoes.mappedAs<const shared::LidarEcho>();
    lidar::ReturnParts parts((batch.count + beamsOfPart - 1) / beamsOfPart);
    shareOut(parts.size(), threads_, [&](std::size_t first, std::size_t end) {
        for (std::size_t part = first; part < end; ++part) {
            const auto begin = static_cast<std::uint32_t>(part) * beamsOfPart;
            const std::uint32_t stop = std::min(batch.count, begin + beamsOfPart);
            std::vector<lidar::LidarReturn>& made = parts[part];
            for (std::uint32_t i = begin; i < stop; ++i) {
                const std::uint32_t count = runs[i] >> shared::lidarRunShift;
                for (std::uint32_t k = 0; k < count; ++k)
                    made.push_back(lidar::returnOf(echoes[(runs[i] & shared::lidarRunFirst) + k],
                                                   batch.beams[i], batch.first + i, k, count));
            }
        }
    });
    return parts;
}

DeviceLidar::Scan DeviceLidar::scan(const lidar::Beams& beams, const lidar::ReturnSink& sink,
                                    Progress& progress)
{
    Scan scan;
    const auto take = [&](Batch& batch) {
        if (batch.count == 0)
            return;
        const shared::LidarTotals totals =
            batch.totals.mappedAs<const shared::LidarTotals>().front();
        scan.counts.beams += batch.count;
        scan.counts.returns += totals.returns;
        scan.counts.groundRays += totals.groundRays;
        scan.counts.freeRays += totals.freeRays;
        if (sink)
            sink(returnsOf(batch));
        progress.advance(batch.count);
        batch.count = 0;
    };
    for (Batch& batch : batches_)
        batch.count = 0;
    gpu::FrameRing ring(context_, static_cast<std::uint32_t>(batches_.size()));
    const std::uint64_t batchCount = (beams.count + beamsAtOnce_ - 1) / beamsAtOnce_;
    gpu::Timestamps timestamps(context_, {.slots = ring.slots(),
                                          .scopes = 2,
                                          .historyFrames = static_cast<std::uint32_t>(
                                              std::clamp<std::uint64_t>(batchCount, 1, 1u << 20))});
    std::uint32_t next = 0; // the batch that is the older one
    for (std::uint64_t first = 0; first < beams.count; first += beamsAtOnce_) {
        const gpu::FrameRing::Frame frame = ring.begin();
        Batch& batch = batches_[frame.slot];
        next = (frame.slot + 1) % ring.slots();
        take(batch);
        batch.first = first;
        batch.count =
            static_cast<std::uint32_t>(std::min<std::uint64_t>(beamsAtOnce_, beams.count - first));
        fill(batch, beams);

        const gpu::Recording commands(context_, frame.commands);
        timestamps.beginFrame(frame.commands, frame.slot);
        gpu::anythingToTransfer(commands);
        const VkBufferCopy all{0, 0, batch.count * sizeof(shared::LidarBeam)};
        commands.vk->CmdCopyBuffer(commands, batch.sent.get(), beams_.get(), 1, &all);
        commands.vk->CmdFillBuffer(commands, totals_.get(), 0, VK_WHOLE_SIZE, 0);
        gpu::transferToCompute(commands);
        const shared::LidarPush push = pushOf(batch);
        const auto run = [&](const char* name, const gpu::ComputePipeline& pipeline,
                             std::uint64_t threads) {
            const gpu::TimedScope scope(timestamps, context_, frame.commands, name);
            pipeline.bind(commands);
            pipeline.push(commands, push);
            const VkExtent2D grid =
                gpu::groupGrid(context_, gpu::groupsFor(threads, shared::lidarThreads));
            commands.vk->CmdDispatch(commands, grid.width, grid.height, 1);
        };
        run("cast", cast_, std::uint64_t(batch.count) * sensor_.rays);
        gpu::computeToCompute(commands);
        run("gather", gather_, batch.count);
        gpu::computeToTransfer(commands);
        const VkBufferCopy totals{0, 0, sizeof(shared::LidarTotals)};
        commands.vk->CmdCopyBuffer(commands, totals_.get(), batch.totals.get(), 1, &totals);
        gpu::anythingToHost(commands);
        ring.submit(frame);
    }
    ring.finish();
    for (std::uint32_t i = 0; i < ring.slots(); ++i)
        take(batches_[(next + i) % ring.slots()]);
    timestamps.collect();
    scan.milliseconds = sumOfTimes(timestamps);
    scan.counts.rays = scan.counts.beams * sensor_.rays;
    return scan;
}

} // namespace sward::view
