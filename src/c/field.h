/* Field files of Sward's C interface. Included by c/sward.h. */
#ifndef SWARD_C_FIELD_H
#define SWARD_C_FIELD_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Of a call. The values are those of the programs' exit codes. */
typedef enum sward_status {
    SWARD_OK = 0,
    SWARD_ERROR_USAGE = 1,       /* a parameter is wrong */
    SWARD_ERROR_IO = 2,          /* a file cannot be read */
    SWARD_ERROR_INPUT = 3,       /* a file was read, but its content is not valid */
    SWARD_ERROR_RUNTIME = 4,     /* memory does not suffice, or the device was lost */
    SWARD_ERROR_UNSUPPORTED = 5, /* valid, but not supported: a file version, a device */
    SWARD_ERROR_INTERNAL = 6     /* a defect of Sward */
} sward_status;

/* Message of this thread's last call that returns a status, or a reason; empty if that succeeded,
 * and before any. Valid until the next such call. */
const char* sward_last_error(void);

/* ---- Field files ------------------------------------------------------------------------- */

/* A field file, mapped and verified. */
typedef struct sward_field sward_field;

typedef struct sward_field_info {
    uint64_t blade_count; /* rows: blades, stalks of compound plants, and each of their ribbons */
    uint64_t patch_count;
    uint32_t species_count; /* 1 to 8 */
    double origin[3];       /* [m] world = origin + position */
    float low[3], high[3];  /* [m] box of everything visible, relative to the origin */
} sward_field_info;

/* One row as it is stored: a blade, the stalk of a compound plant, or a ribbon on a stalk. */
typedef struct sward_blade {
    double root[3];   /* [m] world */
    float up[3];      /* unit: the normal it stands on */
    float facing;     /* [rad] turn of the width axis about `up`, in [0, 2 pi) */
    float height;     /* [m] */
    float width;      /* [m] at its widest */
    float stiffness;  /* [0, 1] */
    float exposure;   /* [0, 1] share of open sky above the root */
    float tint[3];    /* [0, 1] colour of the ground at the root, red, green, blue, in sRGB */
    uint32_t species; /* below species_count */
    uint32_t clump;   /* 0 to 254, the same for neighbours; 255: dead and dry; 0 of a plant */
    uint32_t group;   /* what stands together: number of its patch, below patch_count */

    /* 0: a blade or a stalk. Else the number, 1 to 63, of a leaf or a petal on the stalk that is
     * the nearest row before with 0: a ribbon grows on it, and has its data but for width and id.
     * Whoever counts plants or draws blades of their own leaves these rows out. */
    uint32_t ribbon;
    uint64_t id; /* the same in every bake that has this blade; below 2^53 */
} sward_blade;

/* Maps `path` (UTF-8) and verifies all of it. SWARD_ERROR_IO, _INPUT or _UNSUPPORTED. */
sward_status sward_field_open(const char* path, sward_field** field);
void sward_field_destroy(sward_field* field);
sward_status sward_field_get_info(const sward_field* field, sward_field_info* info);

/* Unpacks `count` rows from `first` on. SWARD_ERROR_USAGE beyond blade_count. */
sward_status sward_field_read_blades(const sward_field* field, uint64_t first, uint64_t count,
                                     sward_blade* blades);

/* How a mesh of a blade stands as `blade`, for instances of any engine: a unit quaternion x, y, z,
 * w that turns +Y to the up-vector and +Z to the side to which the blade leans. The mesh is 1 high
 * and 1 wide; its scale is (width, height, height). Does nothing if a pointer is null. */
void sward_blade_rotation(const sward_blade* blade, float rotation[4]);

/* Name of a species, valid as long as the field; null beyond species_count. */
const char* sward_field_species_name(const sward_field* field, uint32_t species);

#ifdef __cplusplus
}
#endif

#endif
