// The rows of the picture that one of several work-groups draws of a large blade.
#ifndef SWARD_RASTER_PART_ROWS_GLSL
#define SWARD_RASTER_PART_ROWS_GLSL

#include "shaders/raster/large_part.glsl"

/// Of the rows `rows.x` to `rows.y` of the picture: the first row that part `part` draws, and the number of its rows.
/// Parts take turns in blocks of eight rows.
ivec2 rowsOfPart(ivec2 rows, uint part)
{
    const int parts = int(partsOf(part));
    if (parts == 1)
        return ivec2(rows.x, rows.y - rows.x + 1);
    const int block = rows.x >> 3;
    const int ahead = (int(numberOfPart(part)) + parts - block % parts) % parts;
    const int first = ahead == 0 ? rows.x : (block + ahead) << 3;
    const int cycle = parts << 3;
    const int reach = rows.y - (first & ~7);
    return ivec2(first, rows.y < first
                            ? 0
                            : reach / cycle * 8 + min(reach % cycle + 1, 8) - (first & 7));
}

/// Row `i` of these, in cycles of `cycle` rows.
int rowAt(int first, int i, uint cycle)
{
    const int place = i + (first & 7);
    return (first & ~7) + (place >> 3) * int(cycle) + (place & 7);
}

#endif
