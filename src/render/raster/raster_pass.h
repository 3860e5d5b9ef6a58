#pragma once

#include "gpu/context/context.h"
#include "gpu/pipeline/compute_pipeline.h"
#include "gpu/pipeline/shader_library.h"
#include "gpu/pipeline/uniform_sets.h"
#include "gpu/recording/recording.h"
#include "render/field/field_looks.h"
#include "render/field/visible_blades.h"
#include "render/frame/frame_place.h"
#include "render/raster/large_blade_list.h"
#include "shaders/shared/passes.h"

#include <vulkan/vulkan.h>

#include <compare>
#include <cstdint>
#include <map>
#include <span>
#include <utility>

namespace sward::render {

/// Rasterises blades by compute shaders into a visibility buffer that holds the opaque scene: those
/// of one instance of a field, in an early and a late pass, or those of several instances.
class RasterPass {
public:
    explicit RasterPass(const gpu::DeviceContext& context);

    /// Specialisation of the shaders.
    struct Variant {
        std::uint32_t samples = 1;
        bool isPaged = false;        ///< some blades may not be in memory
        bool groupsDrawLarge = true; ///< work-groups draw large blades; else a thread per blade
        FieldLooks looks{};
        auto operator<=>(const Variant&) const = default;
    };

    /// The shaders.
    enum class Stage {
        blades,     ///< draws small blades, and lists large ones
        lateBlades, ///< tests blades outside of the visibility history, and lists them
        large,
        lateLarge, ///< culls hidden segments
        cut,       ///< blades that reach through the near plane
        depths,    ///< finest levels of the depth pyramid, from the visibility
        allDepths, ///< all levels
        largeOfInstances,
        cutOfInstances,
    };

    /// One instance of a field in a view.
    struct Instance {
        FramePlace frame{}; ///< of the picture
        const VisibleBlades* list = nullptr;
        Variant variant{};
        shared::RasterPush push = {};
    };

    /// A view of at least one instance. What it refers to must outlive the recording.
    struct View {
        std::span<const Instance> instances{};
        Variant variant{};                             ///< of the only instance, if there is one
        const LargeBladeList* large = nullptr;         ///< of all instances
        const shared::HostViewPush* several = nullptr; ///< null: there is one instance
        glm::uvec2 size{0};                            ///< [pixels]
    };

    /// Makes the pipelines of a view of such instances; `hasTwoPasses`: an early and a late one, of
    /// a view of one instance.
    void prepare(const gpu::ShaderLibrary& shaders, std::span<const Variant> instances,
                 bool hasTwoPasses);

    /// Makes the pipeline that fills Levels::all for views of a variant.
    void prepareAllDepths(const gpu::ShaderLibrary& shaders, const Variant& variant);

    /// Early: blades drawn without occlusion test. Late: blades tested against the depth pyramid.
    enum class Phase { early, late };

    /// Rasterises the blades that a round of the update has listed, except large ones. Needs
    /// barriers from and to compute shaders.
    void recordBlades(const gpu::Recording& commands, const View& view, std::uint32_t round,
                      Phase phase) const;

    /// Rasterises the listed large blades. The early pass draws the quarters in the visibility
    /// history. The late pass tests the remaining segments against the depth pyramid and draws the
    /// visible ones. Barriers as above.
    void recordLarge(const gpu::Recording& commands, const View& view, Phase phase) const;

    /// Pyramid levels to fill; all of them once a frame.
    enum class Levels { finest, all };

    /// Fills levels of the view's depth pyramid from the current visibility. Blades listed later
    /// are drawn in the late pass. Barriers as above.
    void recordDepths(const gpu::Recording& commands, const View& view, Levels levels) const;

private:
    const gpu::ComputePipeline& made(Stage stage, const Variant& variant) const;
    void make(const gpu::ShaderLibrary& shaders, Stage stage, const Variant& variant);

    const gpu::DeviceContext* context_;
    gpu::UniformSetLayout frameLayout_;
    std::map<std::pair<Stage, Variant>, gpu::ComputePipeline> pipelines_;
};

/// Bytes of a shared::VisibilityArray for a picture of `size` pixels.
VkDeviceSize visibilityBytes(glm::uvec2 size, std::uint32_t samples);

} // namespace sward::render
