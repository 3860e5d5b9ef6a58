/* What a host says of its views, and of its scene around the grass. Included by c/grass.h. */
#ifndef SWARD_C_VIEW_H
#define SWARD_C_VIEW_H

#include "c/device.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum sward_geometry {
    SWARD_GEOMETRY_AUTOMATIC = 0, /* compute rasteriser on a GPU, tessellation on a CPU */
    SWARD_GEOMETRY_RASTER = 1,
    SWARD_GEOMETRY_TESSELLATION = 2 /* also of shadow maps */
} sward_geometry;

/* The host's shadow map of its sun: a 2D array of depths, one layer for each cascade, of one mip
 * level. Blades take the first cascade that contains them; outside of all they are in the sun. */
typedef struct sward_shadow {
    VkImageView view;
    VkImageLayout layout;          /* while it is read */
    const double* world_to_shadow; /* 16 numbers a cascade, column after column; parallel rays */
    uint32_t cascade_count;        /* 1 to 4, the finest first */
    bool has_reversed_z;           /* true: 1 nearest to the sun */
    float bias;                    /* [m] towards the sun, before places are compared: 0.02 */
    float lift;                    /* [texels] along the blade's up-vector: 1.5 */

    /* Of the image behind `view`, as it was made; checked by sward_grass_begin() unless 0. */
    VkFormat format;
    VkImageUsageFlags usage;
} sward_shadow;

/* The host's picture, of one sample a pixel, that sward_grass_record_raster() stores grass into,
 * over what the host has drawn. Both images are 2D views of one layer and one mip level with the
 * usage STORAGE, in the layout GENERAL. */
typedef struct sward_stored_picture {
    VkImageView color;
    VkFormat format;           /* of the view: R8G8B8A8_UNORM or R16G16B16A16_SFLOAT */
    bool is_srgb;              /* the image is sRGB, its view UNORM */
    bool is_bgr;               /* the image has blue first, its view red */
    bool keeps_radiance;       /* linear radiance; else developed for a screen */
    VkImageView depth;         /* R32_SFLOAT: gets the nearest blade's; VK_NULL_HANDLE: none */
    uint32_t width, height;    /* [pixels] of both images */
    uint32_t first_x, first_y; /* [pixels] where the view begins */

    /* Of the images behind both views, as they were made; checked unless 0. */
    VkFormat image_format, depth_format;
    VkImageUsageFlags image_usage, depth_usage;
} sward_stored_picture;

/* Numbers beside the picture (docs/layers.md): bits of sward_view::layers. Forward flow is none of
 * a host's. */
typedef enum sward_layer {
    SWARD_LAYER_DEPTH = 1 << 0,         /* float [m] along the ray; infinite without grass */
    SWARD_LAYER_PLANAR_DEPTH = 1 << 1,  /* float, the clip space's w; likewise */
    SWARD_LAYER_NORMAL = 1 << 2,        /* 3 halves, world */
    SWARD_LAYER_ALBEDO = 1 << 3,        /* 3 halves, linear */
    SWARD_LAYER_BLADE = 1 << 4,         /* uint64_t: sward_blade::id, 1 + instance from bit 53 on */
    SWARD_LAYER_PLANT = 1 << 5,         /* likewise of the stalk that it stands on */
    SWARD_LAYER_SPECIES = 1 << 6,       /* uint8_t: 1 + species; 0: no grass */
    SWARD_LAYER_PATCH = 1 << 7,         /* uint32_t: 1 + patch in device memory */
    SWARD_LAYER_CLASS = 1 << 8,         /* uint8_t: 2 is grass, 0 is none */
    SWARD_LAYER_FLOW_BACKWARD = 1 << 9, /* 2 floats [pixels]; needs keeps_motion */
    SWARD_LAYER_COVERAGE = 1 << 11,     /* half: share of the samples that show grass */
    SWARD_LAYER_SUN = 1 << 12           /* half: share of the sun that arrives */
} sward_layer;

typedef struct sward_view {
    double world_to_clip[16]; /* column after column, to Vulkan's clip space */
    uint32_t width, height;   /* [pixels] */
    uint32_t samples;         /* 1, 2, 4 or 8 */
    bool has_reversed_z;      /* compared with a perspective world_to_clip */
    sward_geometry geometry;
    const double* clip_before; /* 16 numbers: world_to_clip of the frame before; null: the same */

    /* Depth that the host has drawn, which hides blades; VK_NULL_HANDLE: nothing does. */
    VkImageView depth;
    VkImageLayout depth_layout;
    uint32_t depth_samples;
    float depth_slack;             /* 1.2e-7 of 32 and 24 bits, 3e-5 of 16 bits */
    VkFormat depth_format;         /* of its image, as it was made; checked unless 0 */
    VkImageUsageFlags depth_usage; /* likewise */

    const sward_shadow* shadow; /* of the sun; null: the whole view is in the sun */

    const sward_stored_picture* stored; /* null: grass is drawn by sward_grass_record_draw() */

    /* Layers that sward_grass_record_raster() writes, if it rasterises: sward_layer_bytes() at a
     * device address, a multiple of 16, in a STORAGE_BUFFER. 0: none. */
    uint32_t layers;
    VkDeviceAddress layer_words;
} sward_view;

/* world = position + scale * rotation * place */
typedef struct sward_placement {
    double position[3]; /* [m] */
    double rotation[4]; /* unit quaternion x, y, z, w */
    double scale;       /* above 0 */
} sward_placement;

typedef struct sward_collider {
    double from[3], to[3]; /* [m] ends of a capsule, world; the same: a ball */
    double radius;         /* [m] */
    float velocity[3];     /* [m/s] */
} sward_collider;

/* A point light, or a spot light. Its light falls with the inverse square, times
 * (1 - (distance / range)^4)^2.
 *
 * Ambient light is the radiance around, nine coefficients of three linear channels each: those of
 * orthonormal real spherical harmonics 1; y, z, x; xy, yz, 3zz - 1, xz, xx - yy, in the world. */
typedef struct sward_lamp {
    double position[3];               /* [m] world */
    float range;                      /* [m] above 0 */
    float color[3];                   /* linear, not negative: irradiance over pi at 1 m */
    bool has_cone;                    /* what follows is of a spot light */
    float direction[3];               /* away from it; any length above 0 */
    float inner_cosine, outer_cosine; /* all of its light within, none without */
} sward_lamp;

#ifdef __cplusplus
}
#endif

#endif
