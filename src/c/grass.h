/* Grass in a host's frames. Included by c/sward.h. */
#ifndef SWARD_C_GRASS_H
#define SWARD_C_GRASS_H

#include "c/view.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Grass of a world ---- */
typedef struct sward_grass sward_grass;
typedef uint64_t sward_instance; /* never the same twice */

typedef struct sward_grass_info {
    uint32_t frames_in_flight; /* slots, 1 to 16 */
    uint32_t max_views;        /* of a frame, 1 to 64 */
    bool keeps_motion;         /* for motion vectors; 4 bytes a blade */
} sward_grass_info;

typedef struct sward_frame {
    double time; /* [s] at most 2^33 in magnitude; where it falls, blades settle anew */
    const sward_view* views;
    uint32_t view_count, collider_count; /* at most max_views, 256 */
    const sward_settings* settings;
    const sward_collider* colliders;
    const float* ambient;    /* 27 numbers, see sward_lamp; null: sky and ground of the settings */
    const sward_lamp* lamps; /* may be null if there are none */
    uint32_t lamp_count;     /* at most 16 */
} sward_frame;

/* What blades are drawn into. */
typedef struct sward_target sward_target;

typedef struct sward_target_info {
    const VkFormat* color_formats; /* blades into the first, motion into the second */
    uint32_t color_count;          /* 0: depth alone */
    bool writes_motion;
    VkFormat depth_format, stencil_format; /* the latter or VK_FORMAT_UNDEFINED */
    uint32_t samples;
    bool has_reversed_z,
        keeps_radiance;       /* the latter: linear radiance; else developed for a screen */
    VkRenderPass render_pass; /* VK_NULL_HANDLE: dynamic rendering */
    uint32_t subpass;
} sward_target_info;

/* Rows as in sward_field_info, with the ribbons of plants. Culled by any test. */
typedef struct sward_stats {
    uint64_t resident, simulated, drawn, thinned, culled;
} sward_stats;

/* Of fields larger than their budgets: pages of 1024 blades. */
typedef struct sward_streaming {
    uint64_t pages, places;                               /* of the fields; that fit */
    uint64_t resident_pages, wanted_pages, missing_pages; /* the last are wanted and not resident */
    uint64_t copied_bytes;                                /* in the last frame */
    bool is_settled; /* with unchanged views further frames change nothing */
} sward_streaming;

sward_status sward_target_create(const sward_context* context, const sward_target_info* info,
                                 sward_target** target);
void sward_target_destroy(sward_target* target); /* after the commands that draw with it */

sward_status sward_grass_create(const sward_context* context, const sward_grass_info* info,
                                sward_grass** grass);
void sward_grass_destroy(sward_grass* grass); /* after the commands of the last frame */

/* From the next frame on. */
sward_status sward_grass_add(sward_grass* grass, const sward_resident* resident,
                             const sward_placement* placement, sward_instance* instance);
sward_status sward_grass_move(sward_grass* grass, sward_instance instance,
                              const sward_placement* placement);
sward_status sward_grass_remove(sward_grass* grass, sward_instance instance);

/* Replaces 32 m cells of an editable field in all its instances, from the next frame on. `delta` is
 * a file of `sward edit`; `field` is what `resident` was made of. SWARD_ERROR_IO, _INPUT (damaged,
 * another field), _USAGE (not editable, of another grass), _UNSUPPORTED (too many blades). */
sward_status sward_grass_edit(sward_grass* grass, sward_resident* resident,
                              const sward_field* field, const char* delta);

/* Begins a frame in a slot whose former commands have completed. Records nothing. */
sward_status sward_grass_begin(sward_grass* grass, uint32_t slot, const sward_frame* frame);

/* Outside of a rendering, in this order: once; for each view; for each view. The last stores grass
 * into the view's sward_stored_picture, if it has one and nothing is in the way. */
sward_status sward_grass_record_update(sward_grass* grass, VkCommandBuffer commands);
sward_status sward_grass_record_cull(sward_grass* grass, VkCommandBuffer commands, uint32_t view);
sward_status sward_grass_record_raster(sward_grass* grass, VkCommandBuffer commands, uint32_t view);

/* Layers. `words` is what the host has read of sward_view::layer_words. The numbers of a layer are
 * written to `numbers`, row after row from the top, `bytes` in all. Instances name blades and
 * plants, in the order of sward_grass_get_layer_instances(); others need none. */
typedef struct sward_layer_instance {
    const sward_field* field;
    const sward_resident* resident; /* if it is sown or edited, whose last frame this is; or null */
} sward_layer_instance;

uint64_t sward_layer_bytes(uint32_t layers, uint32_t width, uint32_t height);
sward_status sward_layer_read(const uint32_t* words, uint32_t layers, uint32_t width,
                              uint32_t height, sward_layer layer,
                              const sward_layer_instance* instances, uint32_t instance_count,
                              void* numbers, uint64_t bytes);

/* The instances of the frame last begun; at most `capacity` are written, all are counted. */
sward_status sward_grass_get_layer_instances(const sward_grass* grass, sward_instance* instances,
                                             uint32_t capacity, uint32_t* count);

/* Inside the host's rendering, viewport and scissor set. */
sward_status sward_grass_record_draw(const sward_grass* grass, VkCommandBuffer commands,
                                     uint32_t view, const sward_target* target);
sward_status sward_grass_record_depth(const sward_grass* grass, VkCommandBuffer commands,
                                      uint32_t view, const sward_target* target);

/* Why a view of the frame last begun is tessellated into a target; null if it is rasterised.
 * `target` may be null: one of the view's samples. */
const char* sward_grass_why_tessellated(const sward_grass* grass, uint32_t view,
                                        const sward_target* target);

/* Why a view of that frame is not stored and needs sward_grass_record_draw(), which draws nothing
 * of a view that is stored; null if it is stored. */
const char* sward_grass_why_not_stored(const sward_grass* grass, uint32_t view);

/* Of the frame last begun in `slot`, completed. */
sward_status sward_grass_get_stats(const sward_grass* grass, uint32_t view, uint32_t slot,
                                   sward_stats* stats);

/* Of the frame last begun, after sward_grass_record_update(). */
sward_status sward_grass_get_streaming(const sward_grass* grass, sward_streaming* streaming);

#ifdef __cplusplus
}
#endif

#endif
