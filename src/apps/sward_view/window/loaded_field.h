#pragma once

#include "apps/sward_view/fields/shown_field.h"
#include "apps/sward_view/files/shader_sources.h"
#include "apps/sward_view/navigation/navigation.h"
#include "gpu/device/device.h"
#include "render/frame/frame_settings.h"
#include "render/viewer/field_renderer.h"

#include <cstdint>
#include <memory>

namespace sward::view {

/// A loaded field: host data, device data, and its camera.
class LoadedField {
public:
    /// `shaders` may be null: the built-in ones. `settings` must outlive this: the camera's up
    /// follows their gravity. Throws as FieldRenderer does.
    LoadedField(const gpu::Device& device, std::unique_ptr<ShownField> field,
                const render::FieldRenderer::Settings& wanted,
                std::shared_ptr<const ShaderModules> shaders, const Framing& home,
                const render::FrameSettings& settings, float aspect);

    /// Creates a renderer with other shaders and blades at rest; null: the built-in ones. The
    /// device must be idle. Throws as FieldRenderer does, and then keeps the former renderer.
    void drawWith(std::shared_ptr<const ShaderModules> shaders);

    /// Whether the next renderer takes changes of the field.
    void setEditable(bool isEditable) { wanted_.isEditable = isEditable; }

    std::uint32_t samples() const { return wanted_.samples; } ///< per pixel
    const ShownField& field() const { return *field_; }
    render::FieldRenderer& renderer() { return *renderer_; }
    const render::FieldRenderer& renderer() const { return *renderer_; }
    Navigation& navigation() { return navigation_; }
    const Navigation& navigation() const { return navigation_; }

private:
    const gpu::Device& device_;
    std::unique_ptr<ShownField> field_;
    render::FieldRenderer::Settings wanted_;
    std::shared_ptr<const ShaderModules> shaders_; ///< outlive the renderer; null: built in
    std::unique_ptr<render::FieldRenderer> renderer_;
    Navigation navigation_;
};

/// Unit vector away from gravity at `place` (world).
glm::dvec3 upAt(const render::FrameSettings& settings, const glm::dvec3& place);

} // namespace sward::view
