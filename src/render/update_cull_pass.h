#pragma once

#include "gpu/compute_pipeline.h"
#include "gpu/context.h"
#include "gpu/recording.h"
#include "gpu/shader_library.h"
#include "gpu/uniform_sets.h"
#include "render/baked_blades.h"
#include "render/frame_place.h"
#include "render/visible_blades.h"
#include "shaders/shared/passes.h"

#include <vulkan/vulkan.h>

#include <compare>
#include <cstdint>
#include <map>

namespace sward::render {

/// Moves the blades of the visible patches, culls them, and lists those that are to be drawn; or
/// does the one or the other alone.
class UpdateCullPass {
public:
    explicit UpdateCullPass(const gpu::DeviceContext& context);

    /// How many patches a work-group takes where there are many, see shared::updateGroups().
    static std::uint32_t patchesOfGroup(const gpu::DeviceContext& context);

    /// What is done about a visible patch.
    enum class Role : std::uint32_t {
        moveAndCull = 0,
        move = 1, ///< as far as any of several views features, once in a frame; lists nothing
        cull = 2, ///< where blades have been moved to
    };

    /// What the shader is made for.
    struct Variant {
        std::uint32_t windCounts = 0; ///< shared::Wind::counts; 0 where nothing is moved
        bool hasColliders = false;    ///< false where nothing is moved
        Role role = Role::moveAndCull;
        bool keepsBefore = false; ///< states from which blades are moved
        bool keepsEtas = false;   ///< what collisions leave; with colliders always
        bool testsSmall = false;  ///< whether others hide it of blades that are not large, too
        std::uint32_t features =
            shared::featureAll; ///< no frame asks for more, see shared::featuresOf()
        auto operator<=>(const Variant&) const = default;
    };

    /// Makes the pipeline for a frame unless there is one.
    void prepare(const gpu::ShaderLibrary& shaders, Variant variant);

    enum class Scope {
        visible, ///< the visible patches of the walk recorded before; cull and count
        all,     ///< every patch; move only
    };

    /// What frames before have shown of blades.
    struct Shown {
        VkDeviceAddress quarters = 0; ///< see shared::RasterPush; 0: all are listed in front
        std::uint32_t frame = 0;      ///< one after the other; see shared::forgetsSeen()
    };

    /// What it reads and writes besides blades and lists.
    struct Input {
        FramePlace frame{}; ///< by whose camera blades are culled
        std::uint32_t round = 0;
        VkDeviceAddress views = 0;   ///< frames on end for which Role::move moves blades …
        std::uint32_t viewCount = 0; ///< … and how many
        VkDeviceAddress before = 0;  ///< where it keeps states, if the variant does
        Shown shown{};
        std::uint32_t maxGroups = shared::maxGroups; ///< work-groups that share all patches
    };

    /// Between a barrier from the clearing of the counts, or from the walk, and one to the draw.
    /// `variant` has been prepared.
    void record(const gpu::Recording& commands, const BakedBlades& blades,
                const VisibleBlades& found, Variant variant, Scope scope, const Input& input) const;

private:
    const gpu::DeviceContext* context_;
    gpu::UniformSetLayout frameLayout_;
    std::map<Variant, gpu::ComputePipeline> pipelines_;
};

} // namespace sward::render
