#pragma once

#include "core/embedded.h"
#include "field/field.h"
#include "gpu/pipeline/shader_library.h"
#include "render/cull/update_cull_pass.h"
#include "render/cull/walk_pass.h"
#include "render/field/baked_blades.h"
#include "render/field/blade_states.h"
#include "render/field/frame_tables.h"
#include "render/field/visible_blades.h"
#include "shaders/shared/frame.h"

#include <optional>
#include <span>
#include <vector>

namespace sward::test {

/// The time of a frame [s] whose ticks have not passed their largest number.
double timeOf(const shared::Frame& frame);

/// Runs the product's walk and its update and cull pass alone on one field.
class UpdateBench {
public:
    struct Settings {
        std::uint32_t walkStart = 8;
        bool recordCullResults = true; ///< else only the counts are recorded
        std::uint32_t groups = 0;      ///< work-groups for all patches; 0: the product's number
        bool hasAllFeatures = true;    ///< else shaders contain only the frame's features
    };

    UpdateBench(const gpu::DeviceContext& context, const field::FieldView& field,
                const Settings& settings);
    UpdateBench(const gpu::DeviceContext& context, const field::FieldView& field)
        : UpdateBench(context, field, Settings())
    {
    }

    struct Result {
        std::vector<shared::BladeState> states;
        std::vector<std::uint32_t> cullResults;    ///< if recorded
        std::vector<shared::VisibleBlade> visible; ///< only listed blades
        shared::DrawArguments draw;
        std::uint32_t nearColliders = 0; ///< patches taken by the code for colliders, on a CPU
    };

    /// One pass at the frame's time, timeOf() if it is not given, over blades in `states` last
    /// moved `elapsed` [s] before, in the settings' wind and among their colliders, which move from
    /// their positions `elapsed` before. Fills in addresses and counts of the frame.
    Result run(shared::Frame frame, const render::FrameSettings& settings,
               std::span<const shared::BladeState> states, float elapsed,
               render::UpdateCullPass::Scope scope, std::optional<double> frameTime = std::nullopt);

    field::BladeSize bladeSize() const { return blades_.bladeSize(); }

private:
    const gpu::DeviceContext& context_;
    std::uint32_t groups_;
    bool hasAllFeatures_;
    gpu::ShaderLibrary shaders_;
    render::BakedBlades blades_;
    render::BladeStates states_;
    render::VisibleBlades list_;
    gpu::Buffer cullResults_; ///< if recorded
    render::WalkPass walk_;
    render::UpdateCullPass pass_;
    gpu::Buffer tables_;
};

} // namespace sward::test
