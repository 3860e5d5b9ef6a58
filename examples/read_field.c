/* Reads a field of grass (.sward) by the C interface, on Linux and on Windows. Vulkan is not needed.
 *
 *   read_field FIELD.sward              what is in it
 *   read_field FIELD.sward OUT.csv      one row for each blade: place, height, species
 *
 * Windows, in the folder of the zip (docs/windows.md):
 *   cl /I include examples\read_field.c lib\sward.lib
 *   x86_64-w64-mingw32-gcc -I include examples/read_field.c -L lib -lsward -o read_field.exe
 * and sward.dll beside the program. */
#define SWARD_NO_VULKAN
#include <sward/c/sward.h>

#include <stdio.h>

enum { ROWS = 4096 };

static int failed(const char* what)
{
    fprintf(stderr, "%s: %s\n", what, sward_last_error());
    return 1;
}

static int write_table(const sward_field* field, const sward_field_info* info, FILE* table)
{
    static sward_blade rows[ROWS];
    fprintf(table, "x,y,z,height,species\n");
    for (uint64_t first = 0; first < info->blade_count; first += ROWS) {
        const uint64_t left = info->blade_count - first;
        const uint64_t count = left < ROWS ? left : ROWS;
        if (sward_field_read_blades(field, first, count, rows) != SWARD_OK)
            return failed("read");
        for (uint64_t i = 0; i < count; ++i)
            if (rows[i].ribbon == 0) /* no leaf of a compound plant */
                fprintf(table, "%.4f,%.4f,%.4f,%.4f,%u\n", rows[i].root[0], rows[i].root[1],
                        rows[i].root[2], rows[i].height, (unsigned)rows[i].species);
    }
    return 0;
}

int main(int argc, char** argv)
{
    sward_field* field = NULL;
    sward_field_info info;
    if (argc < 2 || argc > 3) {
        fprintf(stderr, "usage: read_field FIELD.sward [OUT.csv]\n");
        return 1;
    }
    if (sward_field_open(argv[1], &field) != SWARD_OK ||
        sward_field_get_info(field, &info) != SWARD_OK)
        return failed(argv[1]);
    printf("%llu blades in %llu patches\n", (unsigned long long)info.blade_count,
           (unsigned long long)info.patch_count);
    for (uint32_t i = 0; i < info.species_count; ++i)
        printf("species %u: %s\n", (unsigned)i, sward_field_species_name(field, i));
    int code = 0;
    if (argc == 3) {
        FILE* table = fopen(argv[2], "w");
        if (table == NULL) {
            perror(argv[2]);
            code = 1;
        } else {
            code = write_table(field, &info, table);
            if (fclose(table) != 0)
                code = 1;
        }
    }
    sward_field_destroy(field);
    return code;
}
