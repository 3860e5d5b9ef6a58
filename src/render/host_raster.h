#pragma once

#include "gpu/buffer.h"
#include "gpu/compute_pipeline.h"
#include "gpu/context.h"
#include "gpu/image_set.h"
#include "gpu/recording.h"
#include "gpu/shader_library.h"
#include "gpu/uniform_sets.h"
#include "render/frame_settings.h"
#include "render/host_view.h"
#include "render/large_blade_list.h"
#include "shaders/shared/debug_mode.h"
#include "shaders/shared/passes.h"

#include <vulkan/vulkan.h>

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace sward::render {

class PlacedField;

/// Rasterises the blades of a host's views by compute shaders: all instances of a view into one
/// visibility buffer, which begins with the host's own depth. BladeTarget draws what it shows.
class HostRaster {
public:
    /// What stays the same from frame to frame.
    struct Settings {
        std::uint32_t slots = 1;
        std::uint32_t maxViews = 1;
        bool keepsMotion = false; ///< of each sample, 4 bytes
    };

    HostRaster(const gpu::DeviceContext& context, const Settings& settings);

    /// Why a view of these instances is not rasterised; null if it is.
    const char* obstacle(const HostView& view, std::span<const PlacedField* const> instances) const;

    /// Begins a frame in `slot`, whose former commands have completed: writes tables of the
    /// instances, makes what is needed for the first time.
    void begin(const gpu::ShaderLibrary& shaders, std::uint32_t slot,
               std::span<const HostView> views, std::span<const PlacedField* const> instances,
               DebugMode debug);

    /// Rasterises and lights what the view's lists hold. `depth`: of the host, as PyramidPass has
    /// it, or null if there is none. Records a barrier before and one after.
    void record(const gpu::Recording& commands, std::uint32_t slot, std::uint32_t view,
                std::span<const PlacedField* const> instances, const gpu::ImageSet* depth) const;

    /// What the stages are told that look at all instances of a view.
    shared::HostViewPush pushFor(std::uint32_t slot, std::uint32_t view) const;

    VkDeviceSize bytes() const;

private:
    struct Pipelines {
        gpu::ComputePipeline blades;
        gpu::ComputePipeline large; ///< none on a CPU device
        gpu::ComputePipeline cut;
    };

    /// What a lighting pipeline is made for.
    struct LightSettings {
        std::uint32_t samples = 1;
        bool isOfOne = false;                           ///< instance, else of several
        std::uint32_t debugMode = shared::debugNothing; ///< see knownDebugMode()
        auto operator<=>(const LightSettings&) const = default;
    };

    /// Kept until no slot uses them.
    struct Pictures {
        std::shared_ptr<gpu::Buffer> visibility; ///< shared::VisibilityArray
        std::shared_ptr<gpu::Buffer> motions;    ///< shared::HostViewPush::motions
    };

    /// A view of the frame last begun in a slot.
    struct View {
        Pictures pictures;
        std::shared_ptr<LargeBladeList> large;
        const Pipelines* pipelines = nullptr;        ///< null: the view is not rasterised
        const gpu::ComputePipeline* light = nullptr; ///< null: no instance
        const gpu::ComputePipeline* seed = nullptr;  ///< null: the visibility begins empty
        shared::HostViewPush push = {};
        std::vector<shared::RasterPush> pushes; ///< one per instance
    };

    struct Slot {
        gpu::Buffer table; ///< shared::HostInstance, instance after instance of view after view
        std::vector<View> views;
    };

    Pipelines pipelinesFor(const gpu::ShaderLibrary& shaders, std::uint32_t samples) const;
    gpu::ComputePipeline lightFor(const gpu::ShaderLibrary& shaders, LightSettings settings) const;
    gpu::ComputePipeline seedFor(const gpu::ShaderLibrary& shaders, std::uint32_t samples,
                                 bool hasReversedZ) const;
    void prepare(const gpu::ShaderLibrary& shaders, const HostView& view, std::uint32_t index,
                 LightSettings light, View& out);
    void writeTable(Slot& slot, std::uint32_t slotIndex, std::span<const HostView> views,
                    std::span<const PlacedField* const> instances) const;

    const gpu::DeviceContext* context_;
    Settings settings_;
    gpu::UniformSetLayout frameLayout_;
    gpu::ImageSetLayout imageLayout_;              ///< the same as PyramidPass has
    std::map<std::uint32_t, Pipelines> pipelines_; ///< by samples
    std::map<LightSettings, gpu::ComputePipeline> lights_;
    /// By samples, and whether depth is reversed: how a visibility begins.
    std::map<std::pair<std::uint32_t, bool>, gpu::ComputePipeline> seeds_;
    std::shared_ptr<LargeBladeList> largeList_; ///< of all views, one after the other

    std::vector<Pictures> pictures_; ///< the newest of each view
    std::vector<Slot> slots_;
};

} // namespace sward::render
