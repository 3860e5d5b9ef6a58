#include "apps/sward_view/window/loaded_field.h"

#include "apps/sward_view/scene/camera_file.h"
#include "presentation/camera_presets.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <utility>

namespace sward::view {
namespace {

glm::dvec3 unitOr(const glm::dvec3& v, const glm::dvec3& otherwise)
{
    const double length = glm::length(v);
    return length > 1e-9 ? v / length : otherwise;
}

Navigation::Place placeOf(const ShownField& field, const render::FrameSettings& settings)
{
    const Aabb& bounds = field.summary.bounds;
    Navigation::Place place;
    place.axis = groundUpOf(field.view);
    place.size = bounds.isEmpty() ? 10.0 : glm::length(glm::dvec3(bounds.size()));
    place.upAt = [&settings](const glm::dvec3& at) { return upAt(settings, at); };
    place.ground = &field.ground;
    return place;
}

} // namespace

LoadedField::LoadedField(const gpu::Device& device, std::unique_ptr<ShownField> field,
                         const render::FieldRenderer::Settings& wanted,
                         std::shared_ptr<const ShaderModules> shaders, const Framing& home,
                         const render::FrameSettings& settings, float aspect)
    : device_(device)
    , field_(std::move(field))
    , wanted_(wanted)
    , navigation_(home, placeOf(*field_, settings))
{
    drawWith(std::move(shaders));
    // Initial bookmarks: views of the whole, then those stored in the field. The first, `fit`,
    // depends on what the window shows beside the field: Viewer frames it.
    using presentation::CameraPreset;
    int number = 2;
    for (const CameraPreset preset : {CameraPreset::eye, CameraPreset::top, CameraPreset::edge})
        navigation_.setBookmark(number++,
                                presentation::presetCamera(preset, field_->view,
                                                           {.groundUp = groundUpOf(field_->view),
                                                            .aspect = aspect,
                                                            .sunDirection = settings.sunDirection,
                                                            .surface = &field_->ground}));
    for (const field::Camera& saved : field_->view.defaults->cameras) {
        if (number > 9)
            break;
        render::Camera camera;
        camera.eye = saved.eye;
        camera.target = saved.target;
        camera.up = saved.up;
        camera.fovY = saved.fovY;
        navigation_.setBookmark(number++, camera);
    }
}

void LoadedField::drawWith(std::shared_ptr<const ShaderModules> shaders)
{
    render::FieldRenderer::Settings wanted = wanted_;
    if (shaders)
        wanted.shaders = shaders->files;
    auto renderer = std::make_unique<render::FieldRenderer>(device_, field_->view, wanted);
    renderer_ = std::move(renderer);
    shaders_ = std::move(shaders);
}

glm::dvec3 upAt(const render::FrameSettings& settings, const glm::dvec3& place)
{
    const field::Defaults& environment = settings.environment;
    const glm::dvec3 down =
        unitOr(glm::dvec3(environment.gravityDirection), glm::dvec3(0.0, -1.0, 0.0));
    const glm::dvec3 pull = unitOr(environment.attractor - place, down);
    return -unitOr(glm::mix(down, pull, static_cast<double>(environment.attractorBlend)), down);
}

} // namespace sward::view
