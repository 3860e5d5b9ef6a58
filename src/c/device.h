/* The host's device, fields on it, and settings. Included by c/sward.h. */
#ifndef SWARD_C_DEVICE_H
#define SWARD_C_DEVICE_H

#include "c/field.h"

#include <vulkan/vulkan.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ---- The host's device ------------------------------------------------------------------- */

/* Features for VkDeviceCreateInfo. */
typedef struct sward_features sward_features;

/* Asks a device, by the loader that the program is linked with, for what Sward needs and for what
 * it uses where it is there. SWARD_ERROR_UNSUPPORTED names what is missing. */
sward_status sward_features_create(VkPhysicalDevice physical, sward_features** features);
void sward_features_destroy(sward_features* features);

/* Chain for VkDeviceCreateInfo::pNext, valid as long as `features`. The host may set more in it,
 * and append structs of types that it does not have: those of Vulkan 1.1, 1.2 and 1.3. */
VkPhysicalDeviceFeatures2* sward_features_chain(sward_features* features);

/* A device as Sward uses it. Outlives whatever is made with it. */
typedef struct sward_context sward_context;

typedef struct sward_context_info {
    VkInstance instance;
    VkPhysicalDevice physical;
    VkDevice device;       /* made with sward_features_chain() */
    VkQueue queue;         /* draws and computes */
    uint32_t queue_family; /* of the queue */
    const sward_features* features;
    bool has_debug_utils;                             /* VK_EXT_debug_utils is enabled */
    PFN_vkGetInstanceProcAddr get_instance_proc_addr; /* of the host's loader; null: the system's */
    const VkAllocationCallbacks* allocation;          /* or null; outlives the context */
    VkPipelineCache pipeline_cache;                   /* or VK_NULL_HANDLE */
} sward_context_info;

sward_status sward_context_create(const sward_context_info* info, sward_context** context);
void sward_context_destroy(sward_context* context);

/* ---- A field on the device --------------------------------------------------------------- */

typedef struct sward_resident sward_resident;

/* Allocates, and copies the field into mapped memory; the field may be destroyed then. */
sward_status sward_resident_create(const sward_context* context, const sward_field* field,
                                   sward_resident** resident);

/* Limit of the device memory of a field and its `instances`, each in `views` views. */
typedef struct sward_budget {
    uint64_t bytes; /* 0: unlimited */
    uint32_t instances, views;
    uint32_t frames_in_flight; /* at least that of sward_grass_info */
    bool keeps_motion;         /* as in sward_grass_info */
    bool waits_for_disk;       /* false: what is not in the CPU's memory comes in later frames */
    bool is_editable;          /* for sward_grass_edit(): all must fit, and edits may take more */
    uint64_t sown_bytes;       /* for blades that a field with seeds sows near the views, at most half
                                * of `bytes`; 0: 512 MiB; SWARD_SOWN_NONE: none are sown */
    uint32_t sow_threads;      /* that grow them; 0: one; SWARD_SOWN_IN_FRAMES: a unit each frame */
} sward_budget;

#define SWARD_SOWN_NONE UINT64_MAX
#define SWARD_SOWN_IN_FRAMES UINT32_MAX

/* The same within a budget. If not all fits, blades that the views see come by pages: the resident
 * field and its instances then keep the file mapped, also after sward_field_destroy(). So do those
 * of a field with seeds. One grass alone draws such a field, or an editable one. */
sward_status sward_resident_create_within(const sward_context* context, const sward_field* field,
                                          const sward_budget* budget, sward_resident** resident);
bool sward_resident_is_streamed(const sward_resident* resident);
bool sward_resident_is_sown(const sward_resident* resident);

/* Instances keep what they need; destroy after the commands of sward_resident_record_upload(). */
void sward_resident_destroy(sward_resident* resident);

/* Records the copy of at most `max_bytes` more, outside of a rendering. */
sward_status sward_resident_record_upload(sward_resident* resident, VkCommandBuffer commands,
                                          VkDeviceSize max_bytes);
bool sward_resident_is_uploaded(const sward_resident* resident);

/* Frees the mapped memory, after the commands of the whole upload have completed. */
sward_status sward_resident_release_staging(sward_resident* resident);

/* ---- Settings ---------------------------------------------------------------------------- */

/* Wind, gravity, sun, sky and level of detail of a frame, in world space. */
typedef struct sward_settings sward_settings;

/* The defaults that a field has saved. */
sward_status sward_settings_create(const sward_field* field, sward_settings** settings);
void sward_settings_destroy(sward_settings* settings);

/* Lays the text of a settings file (docs/settings.md) over them; half of a wrong one never stays.
 * Colliders are a frame's own. */
sward_status sward_settings_read(sward_settings* settings, const char* json);

/* Direction towards the sun; any length but 0. */
sward_status sward_settings_set_sun(sward_settings* settings, const float direction[3]);

#ifdef __cplusplus
}
#endif

#endif
