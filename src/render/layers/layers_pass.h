#pragma once

#include "gpu/context/context.h"
#include "gpu/memory/buffer.h"
#include "gpu/pipeline/compute_pipeline.h"
#include "gpu/pipeline/image_set.h"
#include "gpu/pipeline/shader_library.h"
#include "gpu/pipeline/uniform_sets.h"
#include "gpu/recording/recording.h"
#include "render/frame/frame_place.h"
#include "render/layers/frame_layers.h"
#include "render/layers/layer_regions.h"
#include "render/preview/ground_buffers.h"
#include "render/resolve/target_settings.h"
#include "shaders/shared/layers/layers_table.h"

#include <vulkan/vulkan.h>

#include <array>
#include <cstdint>
#include <map>
#include <vector>

namespace sward::render {

/// Writes the layers of frames from their visibility, for the CPU to read.
class LayersPass {
public:
    /// `ground` must outlive it. `slots`: number of frames in flight.
    LayersPass(const gpu::DeviceContext& context, const GroundBuffers& ground,
               const TargetSettings& target, std::uint32_t slots);

    /// Makes the pipeline for a frame.
    void prepare(const gpu::ShaderLibrary& shaders, Shading shading);

    /// A frame of which layers are wanted.
    struct Input {
        LayerMask wanted = 0;
        shared::RasterPush push = {};   ///< with the visibility and the picture's size
        FramePlace frame{};             ///< of the picture
        VkDeviceAddress motion = 0;     ///< shared::Motion since the frame before
        float elapsed = 0.0f;           ///< [s] since the frame before
        VkBuffer into = VK_NULL_HANDLE; ///< of the caller, for the words; null: one of the slot
    };

    /// Allocates what layers of this size need, and waits for the device if that is more than
    /// before. The slot's former frame must have completed.
    void fit(std::uint32_t slot, const Input& input);

    /// Writes the layers, for which fit() has been called. Needs barriers from compute shaders
    /// before and to them after; the slot's words are then for the CPU, after the frame's fence.
    void record(const gpu::Recording& commands, std::uint32_t slot, const Input& input);

    /// A copy of the layers of the slot's frame, which has completed; without ids, and without
    /// words if they are in a buffer of the caller. Nothing wanted: none were recorded.
    LayerWords wordsOf(std::uint32_t slot) const;

    /// The frame before a next one has no places, so that it gets no forward flow.
    void forgetPlaces() { hasPlaces_ = false; }

    VkDeviceSize bytes() const; ///< device memory

private:
    struct Slot {
        gpu::Buffer table; ///< shared::RasterPush, then shared::LayersTable
        gpu::Buffer words; ///< for the CPU
        LayerMask written = 0;
        bool isOwn = true; ///< `words` holds them
        glm::uvec2 size{0};
    };

    gpu::ComputePipeline pipelineFor(const gpu::ShaderLibrary& shaders,
                                     const Shading& shading) const;
    shared::LayersTable tableOf(const Input& input, const LayerRegions& regions) const;

    const gpu::DeviceContext* context_;
    const GroundBuffers* ground_;
    TargetSettings target_;
    gpu::ImageSetLayout imageLayout_;
    gpu::UniformSetLayout frameLayout_;
    std::map<Shading, gpu::ComputePipeline> pipelines_;
    Shading shading_{};                 ///< of the prepared frame
    std::vector<gpu::ImageSet> images_; ///< shared::imagesTogether in each
    gpu::Buffer written_;               ///< regions, by LayerWord
    std::array<gpu::Buffer, 2> places_; ///< of this frame and of the one before, by turns
    std::uint32_t turn_ = 0;            ///< of places_, for the next frame
    bool hasPlaces_ = false;            ///< the other one has those of the frame before …
    glm::uvec2 placesSize_{0};          ///< … of this size
    std::vector<Slot> slots_;
};

} // namespace sward::render
