#include "core/error.h"
#include "terrain/mesh_files/mesh_scan.h"
#include "terrain/mesh_files/text_cursor.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace sward::terrain {
namespace {

constexpr std::size_t headerSize = 84; // a text of 80 bytes, then the number of triangles
constexpr std::size_t triangleSize = 50;

bool isUpperCase(char c)
{
    return c >= 'A' && c <= 'Z';
}

// Whether the file begins like text: no byte of its start is a control character.
bool isTextual(std::string_view file)
{
    const std::string_view start = file.substr(0, 512);
    return std::all_of(start.begin(), start.end(), [](char c) {
        const auto byte = static_cast<unsigned char>(c);
        return byte >= 0x20 || (byte >= '\t' && byte <= '\r');
    });
}

// OpenMesh's reader knows keywords in small letters and lines that end in LF.
std::string plainStlText(std::string_view file)
{
    std::string text;
    text.reserve(file.size());
    TextCursor cursor(file);
    while (!cursor.atEnd()) {
        for (const char c : cursor.line())
            text.push_back(isUpperCase(c) ? static_cast<char>(c - 'A' + 'a') : c);
        text.push_back('\n');
    }
    return text;
}

MeshScan scanText(std::string_view file, const std::string& place)
{
    MeshScan scan;
    const bool isPlain = file.find("FACET") == std::string_view::npos &&
                         file.find("Facet") == std::string_view::npos &&
                         file.find('\n') != std::string_view::npos && file.substr(0, 5) == "solid";
    if (!isPlain) {
        scan.cleaned = plainStlText(file);
        file = scan.cleaned;
    }
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

// A NaN is neither equal to itself nor a place.
void requireNumbers(std::string_view file, std::size_t triangles, const std::string& place)
{
    constexpr std::size_t cornersAt = 12; // after the normal
    for (std::size_t i = 0; i < triangles; ++i) {
        float numbers[9];
        std::memcpy(numbers, file.data() + headerSize + triangleSize * i + cornersAt,
                    sizeof numbers);
        for (std::size_t n = 0; n < 9; ++n)
            if (!std::isfinite(numbers[n]))
                fail(ErrorKind::input,
                     "{}: coordinate {} of corner {} of triangle {} is not a finite number", place,
                     "xyz"[n % 3], n / 3, i);
    }
}

} // namespace

MeshScan scanStl(std::string_view file, const std::string& place)
{
    std::uint32_t triangles = 0;
    if (file.size() >= headerSize)
        std::memcpy(&triangles, file.data() + headerSize - 4, sizeof triangles);
    const std::size_t size = headerSize + triangleSize * std::size_t(triangles);

    // A binary file may also begin with "solid"; its size distinguishes it.
    if (file.size() < headerSize || (file.size() != size && isTextual(file)))
        return scanText(file, place);
    if (file.size() < size)
        fail(ErrorKind::input, "{}: truncated: {} triangles need {} bytes, the file has {}", place,
             triangles, size, file.size());
    requireNumbers(file, triangles, place);
    MeshScan scan;
    scan.isBinary = true;
    if (file.size() > size)
        scan.cleaned = std::string(file.substr(0, size));
    return scan;
}

} // namespace sward::terrain
