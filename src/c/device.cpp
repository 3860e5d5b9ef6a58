#include "c/guard.h"
#include "c/handles.h"
#include "gpu/context/host_device.h"
#include "presentation/settings_file.h"

#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <cmath>

using namespace sward;
using namespace sward::c;

namespace {

// Members that are 0 have the defaults of C++, so that hosts need not know what has been added.
render::FieldBudget budgetOf(const sward_budget& wanted)
{
    render::FieldBudget budget{.bytes = wanted.bytes,
                               .instances = wanted.instances,
                               .views = wanted.views,
                               .keepsMotion = wanted.keeps_motion,
                               .framesInFlight = wanted.frames_in_flight,
                               .waitsForDisk = wanted.waits_for_disk,
                               .isEditable = wanted.is_editable};
    if (wanted.sown_bytes > 0)
        budget.sownBytes = wanted.sown_bytes == SWARD_SOWN_NONE ? 0 : wanted.sown_bytes;
    if (wanted.sow_threads > 0)
        budget.sowThreads = wanted.sow_threads == SWARD_SOWN_IN_FRAMES ? 0 : wanted.sow_threads;
    return budget;
}

} // namespace

sward_status sward_features_create(VkPhysicalDevice physical, sward_features** features)
{
    return guarded([&] {
        checked(physical, "physical");
        checked(features, "features");
        auto made = std::make_unique<sward_features>();
        made->optional = gpu::enableFeatures(physical, made->chain);
        *features = made.release();
    });
}

void sward_features_destroy(sward_features* features)
{
    delete features;
}

VkPhysicalDeviceFeatures2* sward_features_chain(sward_features* features)
{
    return features == nullptr ? nullptr : &features->chain.core;
}

sward_status sward_context_create(const sward_context_info* info, sward_context** context)
{
    return guarded([&] {
        checked(info, "info");
        checked(context, "context");
        checked(info->instance, "instance");
        checked(info->physical, "physical");
        checked(info->device, "device");
        checked(info->queue, "queue");
        checked(info->features, "features");
        gpu::HostDevice host;
        host.instance = info->instance;
        host.physical = info->physical;
        host.device = info->device;
        host.queue = info->queue;
        host.queueFamily = info->queue_family;
        host.features = info->features->optional;
        host.hasDebugUtils = info->has_debug_utils;
        host.getInstanceProcAddr = info->get_instance_proc_addr;
        host.allocation = info->allocation;
        host.pipelineCache = info->pipeline_cache;
        *context = new sward_context{gpu::describeDevice(host)};
    });
}

void sward_context_destroy(sward_context* context)
{
    delete context;
}

sward_status sward_resident_create(const sward_context* context, const sward_field* field,
                                   sward_resident** resident)
{
    return guarded([&] {
        checked(context, "context");
        checked(field, "field");
        checked(resident, "resident");
        *resident = new sward_resident{
            std::make_shared<render::ResidentField>(context->context, field->mapped)};
    });
}

sward_status sward_resident_create_within(const sward_context* context, const sward_field* field,
                                          const sward_budget* budget, sward_resident** resident)
{
    return guarded([&] {
        checked(context, "context");
        checked(field, "field");
        checked(budget, "budget");
        checked(resident, "resident");
        *resident = new sward_resident{std::make_shared<render::ResidentField>(
            context->context, field->mapped, budgetOf(*budget))};
    });
}

bool sward_resident_is_streamed(const sward_resident* resident)
{
    return resident != nullptr && resident->field->isStreamed();
}

bool sward_resident_is_sown(const sward_resident* resident)
{
    return resident != nullptr && resident->field->isSown();
}

void sward_resident_destroy(sward_resident* resident)
{
    delete resident;
}

sward_status sward_resident_record_upload(sward_resident* resident, VkCommandBuffer commands,
                                          VkDeviceSize max_bytes)
{
    return guarded(
        [&] { checked(resident, "resident")->field->recordUpload(commands, max_bytes); });
}

bool sward_resident_is_uploaded(const sward_resident* resident)
{
    return resident != nullptr && resident->field->isUploaded();
}

sward_status sward_resident_release_staging(sward_resident* resident)
{
    return guarded([&] { checked(resident, "resident")->field->releaseStaging(); });
}

sward_status sward_settings_create(const sward_field* field, sward_settings** settings)
{
    return guarded([&] {
        checked(field, "field");
        checked(settings, "settings");
        *settings = new sward_settings{render::FrameSettings::of(field->mapped->view())};
    });
}

void sward_settings_destroy(sward_settings* settings)
{
    delete settings;
}

sward_status sward_settings_read(sward_settings* settings, const char* json)
{
    return guarded([&] {
        checked(settings, "settings");
        checked(json, "json");
        render::FrameSettings read = settings->settings;
        presentation::readSettings(json, "settings", read);
        settings->settings = read;
    });
}

sward_status sward_settings_set_sun(sward_settings* settings, const float direction[3])
{
    return guarded([&] {
        checked(settings, "settings");
        checked(direction, "direction");
        const glm::vec3 sun = glm::make_vec3(direction);
        const float length = glm::length(sun);
        requireUsage(std::isfinite(length) && length > 0.0f, "direction: it has no length");
        settings->settings.sunDirection = sun / length;
    });
}
