/* A program in C that only reads field files: neither Vulkan's headers nor its library is needed.
 * Usage: fields_only FIELD.sward. Prints how many rows are blades, stalks and ribbons. */
#define SWARD_NO_VULKAN
#ifdef SWARD_IS_INSTALLED
#include <sward/c/sward.h>
#else
#include "c/sward.h"
#endif

#ifdef VULKAN_H_
#error "the functions of field files need no Vulkan"
#endif

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static int failed(const char* what)
{
    fprintf(stderr, "%s: %s\n", what, sward_last_error());
    return 1;
}

int main(int argc, char** argv)
{
    sward_field* field = NULL;
    sward_field_info info;
    if (argc != 2 || sward_field_open(argv[1], &field) != SWARD_OK ||
        sward_field_get_info(field, &info) != SWARD_OK)
        return failed("open");
    sward_blade* rows = malloc(sizeof *rows * (size_t)info.blade_count);
    if (rows == NULL || sward_field_read_blades(field, 0, info.blade_count, rows) != SWARD_OK)
        return failed("read");
    unsigned long ribbons = 0;
    for (uint64_t i = 0; i < info.blade_count; ++i) {
        const sward_blade* row = rows + i;
        if (row->group >= info.patch_count || row->clump > 255 || row->ribbon > 63)
            return failed("range");
        for (int channel = 0; channel < 3; ++channel)
            if (!(row->tint[channel] >= 0.0f && row->tint[channel] <= 1.0f))
                return failed("tint");
        /* The rotation turns +Y to the up-vector, which is as a row of its matrix. */
        float r[4] = {0.0f, 0.0f, 0.0f, 0.0f};
        sward_blade_rotation(row, r);
        const float up[3] = {2.0f * (r[0] * r[1] - r[2] * r[3]),
                             1.0f - 2.0f * (r[0] * r[0] + r[2] * r[2]),
                             2.0f * (r[1] * r[2] + r[0] * r[3])};
        for (int axis = 0; axis < 3; ++axis)
            if (!(fabsf(up[axis] - row->up[axis]) < 1e-5f))
                return failed("rotation");
        if (row->ribbon == 0)
            continue;
        ++ribbons;
        /* A ribbon follows its stalk, or the ribbon before it on that. */
        if (i == 0 || row->ribbon != rows[i - 1].ribbon + 1 || row->height != rows[i - 1].height ||
            row->root[0] != rows[i - 1].root[0] || row->group != rows[i - 1].group)
            return failed("ribbon");
    }
    printf("%lu rows, %lu ribbons\n", (unsigned long)info.blade_count, ribbons);
    free(rows);
    sward_field_destroy(field);
    return 0;
}
