#pragma once

#include "core/progress.h"
#include "gpu/context/context.h"
#include "gpu/memory/buffer.h"
#include "gpu/pipeline/compute_pipeline.h"
#include "lidar/lidar.h"
#include "lidar/ray_tree.h"
#include "shaders/shared/lidar/casting.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace sward::view {

/// A range sensor whose rays a device casts, by compute shaders.
class DeviceLidar {
public:
    /// Uploads the tree, and waits. `origin`: the field's. `threads` ≥ 1 prepare beams and take
    /// returns. Throws Error{usage} for settings out of range, and as gpu::Buffer does if the
    /// device's memory is too small.
    DeviceLidar(const gpu::DeviceContext& context, const lidar::RayTree& tree, glm::dvec3 origin,
                const lidar::LidarSettings& settings, unsigned threads);

    struct Scan {
        lidar::LidarCounts counts;
        double milliseconds = 0.0; ///< of the device, for rays and returns; 0: it has no clock
    };

    /// Casts all beams and hands their returns, in the order of beams and of range, to `sink`,
    /// piece by piece, unless it is empty. Advances `progress`, whose stage the caller has begun,
    /// by a step for each beam. Throws Error{usage} for a direction that is not unit,
    /// Error{interrupted} if it is cancelled, and as gpu::FrameRing does.
    Scan scan(const lidar::Beams& beams, const lidar::ReturnSink& sink, Progress& progress);

    /// Bytes of the tree on the device.
    VkDeviceSize treeBytes() const { return nodes_.bytes() + quads_.bytes(); }

private:
    // A batch of beams of which the device has, or has had, the work.
    struct Batch {
        gpu::Buffer sent;   ///< beams, from the CPU
        gpu::Buffer echoes; ///< for the CPU
        gpu::Buffer runs;   ///< likewise
        gpu::Buffer totals; ///< likewise
        std::vector<lidar::Beam> beams;
        std::uint64_t first = 0;
        std::uint32_t count = 0; ///< 0: nothing is in flight
    };

    void fill(Batch& batch, const lidar::Beams& beams) const;
    shared::LidarPush pushOf(const Batch& batch) const;
    lidar::ReturnParts returnsOf(const Batch& batch) const;

    const gpu::DeviceContext& context_;
    glm::dvec3 origin_;
    std::uint64_t seed_;
    unsigned threads_;
    shared::LidarSensor sensor_;
    std::uint32_t beamsAtOnce_;
    gpu::Buffer nodes_, quads_, places_, reflectances_;
    gpu::Buffer beams_, ends_, totals_; ///< of the batch at work
    std::array<Batch, 2> batches_;
    gpu::ComputePipeline cast_, gather_;
};

} // namespace sward::view
