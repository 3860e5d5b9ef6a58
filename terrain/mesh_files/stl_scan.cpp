#include "core/error.h"
#include "terrain/mesh_files/mesh_scan.h"
#include "terrain/mesh_files/text_cursor.h"

#include <cstring>

namespace sward::terrain {
namespace {

constexpr std::size_t headerSize = 84; // a text of 80 bytes, then the number of triangles
constexpr std::size_t triangleSize = 50;

MeshScan scanText(std::string_view file, const std::string& place)
{
    MeshScan scan;
    std::size_t corners = 0;
    bool ended = false;
    TextCursor cursor(file);
    while (!cursor.atEnd()) {
        TextCursor words(cursor.line());
        const std::string_view keyword = words.word();
        ended = ended || keyword == "endsolid";
        if (keyword != "vertex")
            continue;
        ++corners;
        for (glm::length_t axis = 0; axis < 3; ++axis)
            if (!words.number())
                fail(ErrorKind::input, "{}: line {}: coordinate {} is not a finite number", place,
                     cursor.lineNumber(), "xyz"[axis]);
    }
    if (!ended)
        fail(ErrorKind::input, "{}: truncated: no endsolid", place);
    if (corners % 3 != 0)
        fail(ErrorKind::input, "{}: {} corners do not make triangles", place, corners);
    return scan;
}

} // namespace

MeshScan scanStl(std::string_view file, const std::string& place)
{
    std::uint32_t triangles = 0;
    if (file.size() >= headerSize)
        std::memcpy(&triangles, file.data() + headerSize - 4, sizeof triangles);
    const std::size_t size = headerSize + triangleSize * std::size_t(triangles);

    // A binary file may also begin with "solid"; its size distinguishes it.
    if (file.size() < headerSize || (file.size() != size && file.substr(0, 5) == "solid"))
        return scanText(file, place);
    if (file.size() < size)
        fail(ErrorKind::input, "{}: truncated: {} triangles need {} bytes, the file has {}", place,
             triangles, size, file.size());
    MeshScan scan;
    scan.isBinary = true;
    if (file.size() > size)
        scan.cleaned = std::string(file.substr(0, size));
    return scan;
}

} // namespace sward::terrain
