#include "c/guard.h"
#include "c/handles.h"
#include "field/delta.h"
#include "render/host/host_checks.h"

#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <vector>

using namespace sward;
using namespace sward::c;

namespace {

render::Placement placementOf(const sward_placement* given)
{
    checked(given, "placement");
    const glm::dquat rotation(given->rotation[3], given->rotation[0], given->rotation[1],
                              given->rotation[2]);
    const render::Placement placement{
        .position = glm::make_vec3(given->position), .rotation = rotation, .scale = given->scale};
    render::requireValid(placement);
    return {placement.position, glm::normalize(rotation), placement.scale};
}

/// `matrices` receives those of the cascades; the result refers to them.
render::HostShadow shadowOf(const sward_shadow& given, std::vector<glm::dmat4>& matrices)
{
    requireUsage(given.cascade_count <= render::maxCascades, "shadow map: {} cascades, not 1 to {}",
                 given.cascade_count, render::maxCascades);
    requireUsage(given.cascade_count == 0 || given.world_to_shadow != nullptr,
                 "shadow: world_to_shadow is null");
    for (std::uint32_t i = 0; i < given.cascade_count; ++i)
        matrices.push_back(glm::make_mat4(given.world_to_shadow + 16 * i));
    return {.view = given.view,
            .layout = given.layout,
            .worldToShadow = matrices,
            .hasReversedZ = given.has_reversed_z,
            .bias = given.bias,
            .lift = given.lift,
            .image = {given.format, given.usage}};
}

render::StoredPicture storedOf(const sward_stored_picture& given)
{
    return {.color = given.color,
            .format = given.format,
            .isSrgb = given.is_srgb,
            .isBgr = given.is_bgr,
            .keepsRadiance = given.keeps_radiance,
            .depth = given.depth,
            .size = {given.width, given.height},
            .first = {given.first_x, given.first_y},
            .image = {given.image_format, given.image_usage},
            .depthImage = {given.depth_format, given.depth_usage}};
}

render::HostLamp lampOf(const sward_lamp& given)
{
    render::HostLamp lamp{.position = glm::make_vec3(given.position),
                          .range = given.range,
                          .color = glm::make_vec3(given.color)};
    if (given.has_cone)
        lamp.cone = render::HostCone{glm::make_vec3(given.direction), given.inner_cosine,
                                     given.outer_cosine};
    return lamp;
}

render::HostView viewOf(const sward_view& given)
{
    render::HostView view;
    view.worldToClip = glm::make_mat4(given.world_to_clip);
    view.size = {given.width, given.height};
    view.samples = given.samples;
    view.hasReversedZ = given.has_reversed_z;
    switch (given.geometry) {
    case SWARD_GEOMETRY_AUTOMATIC:
        view.geometry = render::Geometry::automatic;
        break;
    case SWARD_GEOMETRY_RASTER:
        view.geometry = render::Geometry::raster;
        break;
    case SWARD_GEOMETRY_TESSELLATION:
        view.geometry = render::Geometry::tessellation;
        break;
    default:
        fail(ErrorKind::usage, "view: geometry {} is not known", int(given.geometry));
    }
    if (given.clip_before != nullptr)
        view.clipBefore = glm::make_mat4(given.clip_before);
    if (given.depth != VK_NULL_HANDLE)
        view.depth = render::HostDepth{.view = given.depth,
                                       .layout = given.depth_layout,
                                       .samples = given.depth_samples,
                                       .slack = given.depth_slack,
                                       .image = {given.depth_format, given.depth_usage}};
    if (given.stored != nullptr)
        view.stored = storedOf(*given.stored);
    if (given.layers != 0)
        view.layers = render::HostLayers{.wanted = given.layers, .words = given.layer_words};
    return view;
}

render::HostCollider colliderOf(const sward_collider& given)
{
    return {glm::make_vec3(given.from), glm::make_vec3(given.to), given.radius,
            glm::make_vec3(given.velocity)};
}

} // namespace

sward_status sward_target_create(const sward_context* context, const sward_target_info* info,
                                 sward_target** target)
{
    return guarded([&] {
        checked(context, "context");
        checked(info, "info");
        checked(target, "target");
        render::HostTarget wanted;
        if (info->color_count > 0)
            wanted.colorFormats.assign(checked(info->color_formats, "color_formats"),
                                       info->color_formats + info->color_count);
        wanted.writesMotion = info->writes_motion;
        wanted.depthFormat = info->depth_format;
        wanted.stencilFormat = info->stencil_format;
        wanted.samples = info->samples;
        wanted.hasReversedZ = info->has_reversed_z;
        wanted.keepsRadiance = info->keeps_radiance;
        wanted.renderPass = info->render_pass;
        wanted.subpass = info->subpass;
        *target = new sward_target{render::BladeTarget(context->context, wanted)};
    });
}

void sward_target_destroy(sward_target* target)
{
    delete target;
}

sward_status sward_grass_create(const sward_context* context, const sward_grass_info* info,
                                sward_grass** grass)
{
    return guarded([&] {
        checked(context, "context");
        checked(info, "info");
        checked(grass, "grass");
        *grass = new sward_grass{{context->context,
                                  {.framesInFlight = info->frames_in_flight,
                                   .maxViews = info->max_views,
                                   .keepsMotion = info->keeps_motion}}};
    });
}

void sward_grass_destroy(sward_grass* grass)
{
    delete grass;
}

sward_status sward_grass_add(sward_grass* grass, const sward_resident* resident,
                             const sward_placement* placement, sward_instance* instance)
{
    return guarded([&] {
        checked(grass, "grass");
        checked(resident, "resident");
        checked(instance, "instance");
        const render::Placement place = placementOf(placement);
        *instance = static_cast<sward_instance>(grass->grass.add({resident->field, place}));
    });
}

sward_status sward_grass_move(sward_grass* grass, sward_instance instance,
                              const sward_placement* placement)
{
    return guarded([&] {
        checked(grass, "grass")->grass.move(render::InstanceId(instance), placementOf(placement));
    });
}

sward_status sward_grass_remove(sward_grass* grass, sward_instance instance)
{
    return guarded([&] { checked(grass, "grass")->grass.remove(render::InstanceId(instance)); });
}

sward_status sward_grass_edit(sward_grass* grass, sward_resident* resident,
                              const sward_field* field, const char* delta)
{
    return guarded([&] {
        checked(grass, "grass");
        checked(resident, "resident");
        checked(field, "field");
        checked(delta, "delta");
        grass->grass.edit(*resident->field, field::readDelta(delta, field->mapped->view().species));
    });
}

sward_status sward_grass_begin(sward_grass* grass, uint32_t slot, const sward_frame* frame)
{
    return guarded([&] {
        checked(grass, "grass");
        checked(frame, "frame");
        checked(frame->settings, "settings");
        requireUsage(frame->view_count == 0 || frame->views != nullptr, "views is null");
        requireUsage(frame->collider_count == 0 || frame->colliders != nullptr,
                     "colliders is null");
        requireUsage(frame->lamp_count == 0 || frame->lamps != nullptr, "lamps is null");
        // Before what they count is read.
        render::requireCounts({.views = frame->view_count,
                               .colliders = frame->collider_count,
                               .lamps = frame->lamp_count},
                              grass->grass.settings());
        std::vector<render::HostView> views;
        std::vector<std::vector<glm::dmat4>> cascades(frame->view_count);
        for (std::uint32_t i = 0; i < frame->view_count; ++i) {
            views.push_back(viewOf(frame->views[i]));
            if (frame->views[i].shadow != nullptr)
                views.back().shadow = shadowOf(*frame->views[i].shadow, cascades[i]);
        }
        render::HostLight light;
        std::vector<render::HostLamp> lamps;
        for (std::uint32_t i = 0; i < frame->lamp_count; ++i)
            lamps.push_back(lampOf(frame->lamps[i]));
        light.lamps = lamps;
        if (frame->ambient != nullptr) {
            light.ambient.emplace();
            for (std::size_t i = 0; i < light.ambient->radiance.size(); ++i)
                light.ambient->radiance[i] = glm::make_vec3(frame->ambient + 3 * i);
        }
        std::vector<render::HostCollider> colliders;
        for (std::uint32_t i = 0; i < frame->collider_count; ++i)
            colliders.push_back(colliderOf(frame->colliders[i]));
        grass->grass.begin(slot, {.time = frame->time,
                                  .views = views,
                                  .settings = frame->settings->settings,
                                  .colliders = colliders,
                                  .light = light});
    });
}

sward_status sward_grass_record_update(sward_grass* grass, VkCommandBuffer commands)
{
    return guarded([&] { checked(grass, "grass")->grass.recordUpdate(commands); });
}

sward_status sward_grass_record_cull(sward_grass* grass, VkCommandBuffer commands, uint32_t view)
{
    return guarded([&] { checked(grass, "grass")->grass.recordCull(commands, view); });
}

sward_status sward_grass_record_raster(sward_grass* grass, VkCommandBuffer commands, uint32_t view)
{
    return guarded([&] { checked(grass, "grass")->grass.recordRaster(commands, view); });
}

sward_status sward_grass_record_draw(const sward_grass* grass, VkCommandBuffer commands,
                                     uint32_t view, const sward_target* target)
{
    return guarded([&] {
        checked(target, "target");
        checked(grass, "grass")->grass.recordDraw(commands, view, target->target);
    });
}

sward_status sward_grass_record_depth(const sward_grass* grass, VkCommandBuffer commands,
                                      uint32_t view, const sward_target* target)
{
    return guarded([&] {
        checked(target, "target");
        checked(grass, "grass")->grass.recordDepth(commands, view, target->target);
    });
}

const char* sward_grass_why_tessellated(const sward_grass* grass, uint32_t view,
                                        const sward_target* target)
{
    const char* reason = "there is no such view, or the target does not suit it";
    guarded([&] {
        const render::Grass& asked = checked(grass, "grass")->grass;
        reason = target == nullptr ? asked.whyTessellated(view)
                                   : asked.whyTessellated(view, target->target);
    });
    return reason;
}

const char* sward_grass_why_not_stored(const sward_grass* grass, uint32_t view)
{
    const char* reason = "there is no such view";
    guarded([&] { reason = checked(grass, "grass")->grass.whyNotStored(view); });
    return reason;
}

sward_status sward_grass_get_stats(const sward_grass* grass, uint32_t view, uint32_t slot,
                                   sward_stats* stats)
{
    return guarded([&] {
        checked(grass, "grass");
        checked(stats, "stats");
        const render::FrameStats found = grass->grass.stats(view, slot);
        *stats = {found.resident, found.simulated, found.drawn, found.lod,
                  found.culledPatch + found.culledOrientation + found.culledFrustum +
                      found.culledDistance + found.culledOcclusion};
    });
}

sward_status sward_grass_get_streaming(const sward_grass* grass, sward_streaming* streaming)
{
    return guarded([&] {
        checked(grass, "grass");
        checked(streaming, "streaming");
        const render::StreamingStats found = grass->grass.streamingStats();
        *streaming = {found.pages,        found.places,      found.residentPages, found.wantedPages,
                      found.missingPages, found.copiedBytes, found.isSettled};
    });
}
