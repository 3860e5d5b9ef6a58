#pragma once

#include "gpu/context/context.h"
#include "gpu/pipeline/compute_pipeline.h"
#include "gpu/pipeline/image_set.h"
#include "gpu/pipeline/shader_library.h"
#include "gpu/pipeline/uniform_sets.h"
#include "gpu/recording/recording.h"
#include "render/field/field_looks.h"
#include "render/frame/frame_place.h"
#include "render/host/host_view.h"
#include "shaders/shared/constants.h"
#include "shaders/shared/passes.h"

#include <vulkan/vulkan.h>

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

namespace sward::render {

class HostShadowMaps;

/// Lights the visibility of hosts' views: in place of its ids, for a composite, or into a
/// StoredPicture.
class HostLighting {
public:
    /// Specialisation of a pipeline.
    struct Settings {
        std::uint32_t samples = 1, debugMode = shared::debugNothing; ///< see knownDebugMode()
        bool isOfOne = false;                                        ///< of a single instance
        bool hasHostLight = false;  ///< see HostShadowMaps::isLit()
        std::uint32_t storedAs = 0; ///< flags of shared::storesPicture …; 0: in place of ids
        bool storesHalves = false;  ///< else bytes
        // Of the only instance; what is unknown of several has the widest value.
        FieldLooks looks{};
        bool limitsLeafArea = true;   ///< see Shading
        bool hasShadingCache = false; ///< see ShadingCachePass
        auto operator<=>(const Settings&) const = default;
    };

    /// What lights one view.
    struct View {
        const gpu::ComputePipeline* pipeline = nullptr; ///< null: nothing is lit
        const gpu::ImageSet* shadowMap = nullptr;       ///< of HostShadowMaps
        const gpu::ImageSet* color = nullptr;           ///< null: the light replaces ids
        const gpu::ImageSet* depth = nullptr;           ///< beside a colour
    };

    HostLighting(const gpu::DeviceContext& context, const HostShadowMaps& shadowMaps,
                 std::uint32_t slots, std::uint32_t maxViews);

    /// `settings` with samples and storage of a view, which is stored if `stores` and has light of
    /// the host's if `isLit`.
    static Settings settingsOf(const HostView& view, bool stores, bool isLit, Settings settings);

    /// The pipeline with these settings, which stays valid. Makes it on first use.
    const gpu::ComputePipeline& pipelineOf(const gpu::ShaderLibrary& shaders,
                                           const Settings& settings);

    /// Makes what lights a view of a frame in a completed `slot`, after its HostShadowMaps. The
    /// view is stored if `stores`; `pipeline` is made for that.
    View prepare(std::uint32_t slot, std::uint32_t index, const HostView& view, bool stores,
                 const gpu::ComputePipeline& pipeline);

    /// Lights the view. `frame`: of its only instance; null for several.
    static void record(const gpu::Recording& commands, const View& view, const FramePlace* frame,
                       const shared::HostViewPush& push);

private:
    gpu::ComputePipeline pipelineFor(const gpu::ShaderLibrary& shaders,
                                     const Settings& settings) const;

    /// The images of a StoredPicture. Without depth the colour takes its place, unused.
    struct Picture {
        gpu::ImageSet color, depth;
    };

    const gpu::DeviceContext* context_;
    const HostShadowMaps* shadowMaps_;
    gpu::UniformSetLayout frameLayout_;
    gpu::ImageSetLayout imageLayout_; ///< of one stored image
    std::uint32_t maxViews_;
    std::map<Settings, gpu::ComputePipeline> pipelines_;
    std::vector<std::optional<Picture>> pictures_; ///< [slot][view], made on first use
};

} // namespace sward::render
