#pragma once

#include "core/embedded.h"
#include "field/field.h"
#include "gpu/shader_library.h"
#include "render/field_buffers.h"
#include "render/frame_tables.h"
#include "render/update_cull_pass.h"
#include "render/walk_pass.h"
#include "shaders/shared/frame.h"

#include <span>
#include <vector>

namespace sward::test {

/// Runs the walk and the update and cull pass of the product by themselves on one field.
class UpdateBench {
public:
    struct Settings {
        std::uint32_t walkStart = 8;
        bool recordCullResults = true; ///< else nobody is told of each blade, only of their numbers
        std::uint32_t groups = 0; ///< work-groups that share all patches; 0: as many as the product
        bool hasAllFeatures = true; ///< else shaders have code for what a frame asks for alone
    };

    UpdateBench(const gpu::DeviceContext& context, const field::FieldView& field,
                const Settings& settings);
    UpdateBench(const gpu::DeviceContext& context, const field::FieldView& field)
        : UpdateBench(context, field, Settings())
    {
    }

    struct Result {
        std::vector<shared::BladeState> states;
        std::vector<std::uint32_t> cullResults;    ///< if they are recorded
        std::vector<shared::VisibleBlade> visible; ///< only those that are listed
        shared::DrawArguments draw;
    };

    /// One pass at `frame.time` over blades in `states` that were last moved `elapsed` [s] before,
    /// in the settings' wind and among their colliders, which move from where they were `elapsed`
    /// before. Addresses and counts of the frame are filled in.
    Result run(shared::Frame frame, const render::FrameSettings& settings,
               std::span<const shared::BladeState> states, float elapsed,
               render::UpdateCullPass::Scope scope);

    field::BladeSize bladeSize() const { return buffers_.bladeSize(); }

private:
    const gpu::DeviceContext& context_;
    std::uint32_t groups_;
    bool hasAllFeatures_;
    gpu::ShaderLibrary shaders_;
    render::FieldBuffers buffers_;
    render::WalkPass walk_;
    render::UpdateCullPass pass_;
    render::FrameTables tables_;
};

} // namespace sward::test
