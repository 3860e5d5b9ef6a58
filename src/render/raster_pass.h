#pragma once

#include "gpu/buffer.h"
#include "gpu/compute_pipeline.h"
#include "gpu/context.h"
#include "gpu/image.h"
#include "gpu/image_set.h"
#include "gpu/sampler.h"
#include "gpu/shader_library.h"
#include "render/attachments.h"
#include "render/field_buffers.h"
#include "render/target_settings.h"
#include "shaders/shared/passes.h"

#include <vulkan/vulkan.h>

#include <map>

namespace sward::render {

/// Why blades cannot be rasterised by compute shaders on a device into targets of a format; null if
/// they can.
const char* obstacleToRaster(const gpu::DeviceContext& context, VkFormat colorFormat);

/// Draws blades by compute shaders: those that are seen into a visibility buffer that begins with
/// the depth of what the graphics pipeline has drawn, then the picture from both.
class RasterPass {
public:
    /// `obstacleToRaster()` has none.
    RasterPass(const gpu::DeviceContext& context, const gpu::ShaderLibrary& shaders,
               const TargetSettings& target);

    /// To be called when the attachments are new.
    void resize(const Attachments& attachments);

    /// Makes the pipelines of a frame unless they are there.
    void prepare(const gpu::ShaderLibrary& shaders, bool paintsWind);

    /// What each of the following reads.
    struct Input {
        const FieldBuffers* field = nullptr;
        VkDeviceAddress frame = 0;  ///< shared::Frame
        VkDeviceAddress judged = 0; ///< by whose camera the visible blades were listed
    };

    /// Begins the visibility with what the graphics pipeline has drawn; colour and depth are in
    /// ImageUse::sampled.
    void recordBegin(VkCommandBuffer commands, const Input& input) const;

    /// Rasterises the visible blades that a round of the update has listed, but for large ones.
    /// Between barriers from compute shaders to the same.
    void recordBlades(VkCommandBuffer commands, const Input& input, std::uint32_t round) const;

    /// Rasterises the large ones of all rounds.
    void recordLarge(VkCommandBuffer commands, const Input& input) const;

    /// Shades the picture and filters it; it is then in ImageUse::transferSource. `paintsWind` was
    /// prepared.
    void recordResolve(VkCommandBuffer commands, const Input& input, bool paintsWind) const;

    /// Copies the picture to a target in ImageUse::transferTarget.
    void copyTo(VkCommandBuffer commands, VkImage target) const;

    VkDeviceAddress visibility() const { return visibility_.address(); }
    VkDeviceSize bytes() const { return bytes_; }

private:
    shared::RasterPush pushFor(const Input& input) const;

    const gpu::DeviceContext* context_;
    TargetSettings target_;
    gpu::ImageSetLayout imageLayout_;
    gpu::Sampler sampler_;
    gpu::ComputePipeline begin_;
    gpu::ComputePipeline blades_;
    gpu::ComputePipeline large_;
    std::map<bool, gpu::ComputePipeline> resolve_; ///< by whether it paints the wind
    gpu::ComputePipeline soften_;                  ///< with several samples

    VkExtent2D size_{};
    VkDeviceSize bytes_ = 0;
    gpu::Buffer visibility_;
    gpu::Buffer largeParts_;
    gpu::Buffer largeCount_;
    gpu::Image shaded_; ///< with several samples: linear, not yet filtered
    gpu::Image picture_;
    gpu::ImageSet images_;
    gpu::ImageSet filmImages_;
};

} // namespace sward::render
