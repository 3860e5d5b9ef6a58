#pragma once

#include "core/diagnostics.h"
#include "terrain/mesh_files/polygon_soup.h"

#include <string>
#include <string_view>

namespace sward::terrain {

/// How a file stores its coordinates.
struct MeshForm {
    bool isText = false;
    bool isSingle = false; ///< in single precision
};

// Each reads the whole `file` into `soup`. `place` names the file. What a header claims is believed
// as far as bytes follow: none takes more than 64 bytes for each byte of the file. Throws
// Error{input} for a truncated file, invalid numbers, or counts too large for the file;
// Error{unsupported} for an unsupported variant. Warns of what is left over behind the last element.

/// PLY, text or binary of both byte orders, of any number types and order of elements. Colours and
/// normals of any type; lists `texcoord` of faces; `tristrips`.
MeshForm readPly(std::string_view file, const std::string& place, PolygonSoup& soup,
                 Diagnostics& diagnostics);

/// OFF with any prefix of colours, normals and texture coordinates, text or binary. The elements of
/// a text without colours and texture coordinates need no lines of their own.
MeshForm readOff(std::string_view file, const std::string& place, PolygonSoup& soup,
                 Diagnostics& diagnostics);

/// STL, text with white space of any kind, or binary. Equal corners become one vertex. Warns of a
/// text without its end.
MeshForm readStl(std::string_view file, const std::string& place, PolygonSoup& soup,
                 Diagnostics& diagnostics);

} // namespace sward::terrain
