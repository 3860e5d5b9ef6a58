#pragma once

#include "gpu/context/context.h"
#include "gpu/pipeline/compute_pipeline.h"
#include "gpu/pipeline/shader_library.h"
#include "gpu/pipeline/uniform_sets.h"
#include "gpu/recording/recording.h"
#include "render/field/baked_blades.h"
#include "render/field/visible_blades.h"
#include "render/frame/frame_place.h"
#include "shaders/shared/passes.h"

#include <vulkan/vulkan.h>

#include <compare>
#include <cstdint>
#include <map>

namespace sward::render {

/// Moves the blades of the visible patches, culls them, and lists the blades to be drawn. May also
/// only move, or only cull and list.
class UpdateCullPass {
public:
    explicit UpdateCullPass(const gpu::DeviceContext& context);

    /// Maximum patches per work-group, see shared::updateGroups().
    static std::uint32_t patchesOfGroup(const gpu::DeviceContext& context);

    /// Work done for a visible patch.
    enum class Role : std::uint32_t {
        moveAndCull = 0,
        move = 1, ///< at the highest rate that any view needs, once per frame; lists nothing
        cull = 2, ///< of blades that have already been moved
    };

    /// Specialisation of the shader.
    struct Variant {
        std::uint32_t windCounts = 0; ///< shared::Wind::counts; 0 if nothing is moved
        bool hasColliders = false;    ///< false if nothing is moved
        Role role = Role::moveAndCull;
        bool keepsBefore = false; ///< stores the states before the move
        bool keepsEtas = false;   ///< stores collision state; always with colliders
        bool testsSmall = false;  ///< occlusion test also for blades that are not large
        std::uint32_t features =
            shared::featureAll; ///< superset of each frame's, see shared::featuresOf()
        auto operator<=>(const Variant&) const = default;
    };

    /// Makes the pipeline of a variant unless it exists.
    void prepare(const gpu::ShaderLibrary& shaders, Variant variant);

    enum class Scope {
        visible, ///< the visible patches of the last walk; cull and count
        all,     ///< every patch; move only
    };

    /// Visibility history of blades.
    struct History {
        VkDeviceAddress address =
            0;                   ///< see shared::RasterPush::history; 0: all are listed in front
        std::uint32_t frame = 0; ///< frame number; see shared::forgetsHistory()
    };

    /// Inputs and outputs besides blades and lists.
    struct Input {
        FramePlace frame{}; ///< its camera culls the blades
        std::uint32_t round = 0;
        VkDeviceAddress views = 0;   ///< contiguous frames for which Role::move moves blades …
        std::uint32_t viewCount = 0; ///< … and their number
        VkDeviceAddress before = 0;  ///< where the variant stores former states
        History history{};
        std::uint32_t maxGroups = shared::maxGroups; ///< limit of work-groups for Scope::all
    };

    /// With colliders on a CPU these are two dispatches: patches near none take the code without
    /// colliders. Needs a barrier from the clearing of counts, or from the walk, before; and one to
    /// the draw after. `variant` must be prepared.
    void record(const gpu::Recording& commands, const BakedBlades& blades,
                const VisibleBlades& found, Variant variant, Scope scope, const Input& input) const;

private:
    struct Pipeline {
        Variant variant;
        std::uint32_t takes = shared::takesAll;
        auto operator<=>(const Pipeline&) const = default;
    };

    void prepareOne(const gpu::ShaderLibrary& shaders, Pipeline wanted);
    void bind(const gpu::Recording& commands, Pipeline wanted, const BakedBlades& blades,
              const VisibleBlades& found, Scope scope, const Input& input) const;
    bool splits(Variant variant) const; ///< into patches far from and near to colliders

    const gpu::DeviceContext* context_;
    gpu::UniformSetLayout frameLayout_;
    std::map<Pipeline, gpu::ComputePipeline> pipelines_;
};

} // namespace sward::render
