#pragma once

#include "gpu/context/context.h"
#include "gpu/memory/image.h"
#include "gpu/pipeline/compute_pipeline.h"
#include "gpu/pipeline/image_set.h"
#include "gpu/pipeline/sampler.h"
#include "gpu/pipeline/shader_library.h"
#include "gpu/pipeline/uniform_sets.h"
#include "gpu/recording/recording.h"
#include "render/frame/frame_place.h"
#include "render/resolve/target_settings.h"
#include "render/resolve/tile_classification.h"
#include "shaders/shared/passes.h"

#include <vulkan/vulkan.h>

#include <map>
#include <optional>
#include <vector>

namespace sward::render {

/// Shades and filters the picture of a visibility buffer.
class ResolvePass {
public:
    /// `slots`: number of frames in flight.
    ResolvePass(const gpu::DeviceContext& context, const gpu::ShaderLibrary& shaders,
                const TargetSettings& target, std::uint32_t slots);

    /// Resizes the pictures; the device must be done with the former ones. `lit` must outlive them;
    /// it is OpaqueRasterPass::lit(). With several samples the picture is shaded into it.
    void resize(VkExtent2D size, const gpu::Image& lit);

    /// Makes the pipelines for a frame.
    void prepare(const gpu::ShaderLibrary& shaders, Shading shading);

    void describe(shared::RasterPush& push) const; ///< addresses of tiles

    /// Clears the lists of tiles. Needs barriers from all accesses to fills before, and from fills
    /// to dispatches after.
    void recordBegin(const gpu::Recording& commands) const;

    /// Classifies the picture's tiles if the target sorts tiles. Needs barriers from compute
    /// shaders before and to dispatches after.
    void recordTiles(const gpu::Recording& commands, const shared::RasterPush& push) const;

    /// Sets the destination of the slot's picture: a target in ImageUse::storage with the view
    /// `stored` (FieldRenderer::Target::stored), or, if null, the pass's own picture, which
    /// copyTo() copies. The slot's former frame must have completed.
    void aim(std::uint32_t slot, VkImageView stored);

    /// Shades and filters the picture of the slot aimed last; clears the visibility.
    void record(const gpu::Recording& commands, const shared::RasterPush& push,
                const FramePlace& frame, std::uint32_t slot) const;

    /// Copies the pass's own picture to a target in ImageUse::transferTarget.
    void copyTo(const gpu::Recording& commands, VkImage target) const;

    /// Null if tiles are not sorted.
    const TileClassification* sorted() const { return target_.sortsTiles ? &*tiles_ : nullptr; }
    VkDeviceSize bytes() const;
    VkDeviceSize bytesToCopy() const; ///< for targets without storage view

private:
    /// The pipeline for one list's tiles, or for all tiles if it is shared::tileLists.
    struct Part {
        std::uint32_t list;
        gpu::ComputePipeline pipeline;
    };

    gpu::ComputePipeline pipeline(const gpu::ShaderLibrary& shaders, const char* name,
                                  const char* shader,
                                  std::vector<gpu::SpecializationConstant> constants) const;
    void recordSoft(const gpu::Recording& commands, const shared::RasterPush& push,
                    const gpu::ImageSet& film) const;

    const gpu::DeviceContext* context_;
    TargetSettings target_;
    gpu::ImageSetLayout imageLayout_;
    gpu::UniformSetLayout frameLayout_;
    gpu::Sampler sampler_;
    std::map<Shading, std::vector<Part>> parts_;
    Shading shading_{};                       ///< of the prepared frame
    gpu::ComputePipeline reconstruct_;        ///< with several samples
    std::optional<TileClassification> tiles_; ///< sorted tiles; with several samples, soft tiles

    VkExtent2D size_{};
    /// A slot's descriptor sets.
    struct Images {
        gpu::ImageSet resolved;
        gpu::ImageSet film; ///< with several samples
    };
    gpu::Image picture_;    ///< made for the first target without storage view
    bool isCopied_ = false; ///< whether the slot aimed last uses picture_
    std::vector<Images> images_;
};

} // namespace sward::render
