#pragma once

#include "gpu/compute_pipeline.h"
#include "gpu/context.h"
#include "gpu/image.h"
#include "gpu/image_set.h"
#include "gpu/sampler.h"
#include "gpu/shader_library.h"
#include "gpu/uniform_sets.h"
#include "render/frame_place.h"
#include "render/target_settings.h"
#include "render/tile_classification.h"
#include "shaders/shared/passes.h"

#include <vulkan/vulkan.h>

#include <map>
#include <optional>
#include <vector>

namespace sward::render {

/// Makes the picture of what a visibility shows.
class ResolvePass {
public:
    /// `slots`: frames in flight.
    ResolvePass(const gpu::DeviceContext& context, const gpu::ShaderLibrary& shaders,
                const TargetSettings& target, std::uint32_t slots);

    /// Has pictures of this size; the device is done with the former ones. `lit`, which outlives
    /// them, is OpaqueRasterPass::lit(): with several samples the picture is shaded in it.
    void resize(VkExtent2D size, const gpu::Image& lit);

    /// Makes ready for a frame.
    void prepare(const gpu::ShaderLibrary& shaders, Shading shading);

    void describe(shared::RasterPush& push) const; ///< where its shaders find tiles

    /// Empties the lists of tiles; between barriers from anything to fills, and from those to
    /// dispatches.
    void recordBegin(VkCommandBuffer commands) const;

    /// Sorts the picture's tiles by what they show if the target asks for that; between barriers
    /// from compute shaders and to dispatches.
    void recordTiles(VkCommandBuffer commands, const shared::RasterPush& push) const;

    /// Chooses where the picture of this slot goes: to a target in ImageUse::storage, of which
    /// `stored` is FieldRenderer::Target::stored, or, if that is null, to a picture of the pass's
    /// own, which copyTo() copies. The device is done with the slot's frame before.
    void aim(std::uint32_t slot, VkImageView stored);

    /// Shades and filters the picture of the slot aimed last; empties the visibility.
    void record(VkCommandBuffer commands, const shared::RasterPush& push, const FramePlace& frame,
                std::uint32_t slot) const;

    /// Copies the pass's own picture to a target in ImageUse::transferTarget.
    void copyTo(VkCommandBuffer commands, VkImage target) const;

    /// Null where tiles are shaded as they lie.
    const TileClassification* sorted() const { return target_.sortsTiles ? &*tiles_ : nullptr; }
    VkDeviceSize bytes() const;
    VkDeviceSize bytesToCopy() const; ///< that targets take which are not stored into

private:
    /// For the tiles of one list, or for all of them if it is shared::tileLists.
    struct Part {
        std::uint32_t list;
        gpu::ComputePipeline pipeline;
    };

    gpu::ComputePipeline pipeline(const gpu::ShaderLibrary& shaders, const char* name,
                                  const char* shader,
                                  std::vector<gpu::SpecializationConstant> constants) const;
    void recordSoft(VkCommandBuffer commands, const shared::RasterPush& push,
                    const gpu::ImageSet& film) const;

    const gpu::DeviceContext* context_;
    TargetSettings target_;
    gpu::ImageSetLayout imageLayout_;
    gpu::UniformSetLayout frameLayout_;
    gpu::Sampler sampler_;
    std::map<Shading, std::vector<Part>> parts_;
    Shading shading_{};                       ///< of the frame prepared last
    gpu::ComputePipeline reconstruct_;        ///< with several samples
    std::optional<TileClassification> tiles_; ///< sorted ones, and with several samples soft ones

    VkExtent2D size_{};
    /// What a slot's shaders see.
    struct Images {
        gpu::ImageSet resolved;
        gpu::ImageSet film; ///< with several samples
    };
    gpu::Image picture_;    ///< made for the first target that is not stored into
    bool isCopied_ = false; ///< whether the picture of the slot aimed last is
    std::vector<Images> images_;
};

} // namespace sward::render
