#include "c/guard.h"
#include "c/handles.h"
#include "shaders/shared/collision.h"

#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <vector>

using namespace sward;
using namespace sward::c;

namespace {

render::Placement placementOf(const sward_placement* given)
{
    checked(given, "placement");
    require(isFinite(given->position, 3) && isFinite(given->rotation, 4) &&
                std::isfinite(given->scale),
            "placement: a number is not finite");
    require(given->scale > 0.0, "placement: scale is not above 0");
    const glm::dquat rotation(given->rotation[3], given->rotation[0], given->rotation[1],
                              given->rotation[2]);
    require(std::abs(glm::length(rotation) - 1.0) < 1e-3, "placement: rotation is not unit");
    return {.position = glm::make_vec3(given->position),
            .rotation = glm::normalize(rotation),
            .scale = given->scale};
}

/// `matrices` receives those of the cascades; the result refers to them.
render::HostShadow shadowOf(const sward_shadow& given, std::vector<glm::dmat4>& matrices)
{
    require(given.cascade_count <= shared::maxCascades, "shadow: cascade_count is above 4");
    require(given.cascade_count == 0 || given.world_to_shadow != nullptr,
            "shadow: world_to_shadow is null");
    for (std::uint32_t i = 0; i < given.cascade_count; ++i)
        matrices.push_back(glm::make_mat4(given.world_to_shadow + 16 * i));
    return {.view = given.view,
            .layout = given.layout,
            .worldToShadow = matrices,
            .hasReversedZ = given.has_reversed_z,
            .bias = given.bias,
            .lift = given.lift};
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
            .first = {given.first_x, given.first_y}};
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
    require(isFinite(given.world_to_clip, 16), "view: world_to_clip is not finite");
    require(given.width > 0 && given.height > 0, "view: its size is 0");
    const auto isCount = [](std::uint32_t n) { return n == 1 || n == 2 || n == 4 || n == 8; };
    require(isCount(given.samples), "view: samples is not 1, 2, 4 or 8");
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
    if (given.clip_before != nullptr) {
        require(isFinite(given.clip_before, 16), "view: clip_before is not finite");
        view.clipBefore = glm::make_mat4(given.clip_before);
    }
    if (given.depth != VK_NULL_HANDLE) {
        require(isCount(given.depth_samples), "view: depth_samples is not 1, 2, 4 or 8");
        require(given.depth_slack >= 0.0f && given.depth_slack < 1.0f,
                "view: depth_slack is outside [0, 1)");
        view.depth = render::HostDepth{given.depth, given.depth_layout, given.depth_samples,
                                       given.depth_slack};
    }
    if (given.stored != nullptr)
        view.stored = storedOf(*given.stored);
    return view;
}

render::HostCollider colliderOf(const sward_collider& given)
{
    require(isFinite(given.from, 3) && isFinite(given.to, 3) && std::isfinite(given.radius),
            "collider: a number is not finite");
    require(given.radius > 0.0, "collider: radius is not above 0");
    const glm::vec3 velocity = glm::make_vec3(given.velocity);
    require(std::isfinite(glm::dot(velocity, velocity)), "collider: velocity is not finite");
    return {glm::make_vec3(given.from), glm::make_vec3(given.to), given.radius, velocity};
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
        require(!info->writes_motion || info->color_count >= 2,
                "writes_motion: there is no second colour");
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
        require(info->frames_in_flight >= 1 && info->frames_in_flight <= 16,
                "frames_in_flight is outside [1, 16]");
        require(info->max_views >= 1 && info->max_views <= 64, "max_views is outside [1, 64]");
        *grass = new sward_grass{*info,
                                 {context->context,
                                  {.framesInFlight = info->frames_in_flight,
                                   .maxViews = info->max_views,
                                   .keepsMotion = info->keeps_motion}},
                                 {}};
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
        const auto id = static_cast<sward_instance>(grass->grass.add({resident->field, place}));
        grass->instances.insert(id);
        *instance = id;
    });
}

sward_status sward_grass_move(sward_grass* grass, sward_instance instance,
                              const sward_placement* placement)
{
    return guarded([&] {
        require(checked(grass, "grass")->instances.contains(instance), "there is no such instance");
        grass->grass.move(render::InstanceId(instance), placementOf(placement));
    });
}

sward_status sward_grass_remove(sward_grass* grass, sward_instance instance)
{
    return guarded([&] {
        require(checked(grass, "grass")->instances.contains(instance), "there is no such instance");
        grass->grass.remove(render::InstanceId(instance));
        grass->instances.erase(instance);
    });
}

sward_status sward_grass_begin(sward_grass* grass, uint32_t slot, const sward_frame* frame)
{
    return guarded([&] {
        checked(grass, "grass");
        checked(frame, "frame");
        checked(frame->settings, "settings");
        require(slot < grass->info.frames_in_flight, "slot is not below frames_in_flight");
        require(frame->view_count <= grass->info.max_views, "view_count is above max_views");
        require(frame->view_count == 0 || frame->views != nullptr, "views is null");
        require(frame->collider_count <= shared::maxColliders, "collider_count is above 256");
        require(frame->collider_count == 0 || frame->colliders != nullptr, "colliders is null");
        require(std::isfinite(frame->time), "time is not finite");
        require(frame->lamp_count == 0 || frame->lamps != nullptr, "lamps is null");
        require(frame->lamp_count <= shared::maxLamps, "lamp_count is above 16");
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
        grass->views = 0;
        grass->hasBegun = grass->hasUpdated = false;
        grass->grass.begin(slot, {.time = frame->time,
                                  .views = views,
                                  .settings = frame->settings->settings,
                                  .colliders = colliders,
                                  .light = light});
        grass->views = frame->view_count;
        grass->hasBegun = true;
    });
}

void sward_grass_record_update(sward_grass* grass, VkCommandBuffer commands)
{
    if (grass == nullptr || !grass->hasBegun || grass->hasUpdated)
        return;
    grass->grass.recordUpdate(commands);
    grass->hasUpdated = true;
}

void sward_grass_record_cull(sward_grass* grass, VkCommandBuffer commands, uint32_t view)
{
    if (grass != nullptr && view < grass->views && grass->hasUpdated)
        grass->grass.recordCull(commands, view);
}

void sward_grass_record_raster(sward_grass* grass, VkCommandBuffer commands, uint32_t view)
{
    if (grass != nullptr && view < grass->views && grass->hasUpdated)
        grass->grass.recordRaster(commands, view);
}

void sward_grass_record_draw(const sward_grass* grass, VkCommandBuffer commands, uint32_t view,
                             const sward_target* target)
{
    if (grass == nullptr || target == nullptr || view >= grass->views || !grass->hasUpdated)
        return;
    if (target->target.settings().writesMotion && !grass->info.keeps_motion)
        return;
    grass->grass.recordDraw(commands, view, target->target);
}

void sward_grass_record_depth(const sward_grass* grass, VkCommandBuffer commands, uint32_t view,
                              const sward_target* target)
{
    if (grass != nullptr && target != nullptr && view < grass->views && grass->hasUpdated &&
        target->target.settings().colorFormats.empty())
        grass->grass.recordDepth(commands, view, target->target);
}

const char* sward_grass_why_tessellated(const sward_grass* grass, uint32_t view)
{
    return grass == nullptr || view >= grass->views ? "there is no such view"
                                                    : grass->grass.whyTessellated(view);
}

const char* sward_grass_why_not_stored(const sward_grass* grass, uint32_t view)
{
    return grass == nullptr || view >= grass->views ? "there is no such view"
                                                    : grass->grass.whyNotStored(view);
}

sward_status sward_grass_get_stats(const sward_grass* grass, uint32_t view, uint32_t slot,
                                   sward_stats* stats)
{
    return guarded([&] {
        checked(grass, "grass");
        checked(stats, "stats");
        require(view < grass->info.max_views, "view is not below max_views");
        require(slot < grass->info.frames_in_flight, "slot is not below frames_in_flight");
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
