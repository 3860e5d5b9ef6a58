#include "core/error.h"
#include "terrain/mesh_scan.h"
#include "terrain/text_cursor.h"

#include <algorithm>

namespace sward::terrain {
namespace {

// The text behind a keyword, without spaces around it.
std::string nameBehind(std::string_view line, std::size_t keyword)
{
    std::string_view name = line.substr(std::min(keyword, line.size()));
    while (!name.empty() && (name.front() == ' ' || name.front() == '\t'))
        name.remove_prefix(1);
    while (!name.empty() && (name.back() == ' ' || name.back() == '\t'))
        name.remove_suffix(1);
    return std::string(name);
}

// The index of `name` in `names`, which it joins if it is new.
std::uint32_t indexOf(std::vector<std::string>& names, const std::string& name)
{
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end())
        names.push_back(name);
    return static_cast<std::uint32_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

std::size_t countWords(TextCursor words)
{
    std::size_t count = 0;
    while (!words.word().empty())
        ++count;
    return count;
}

glm::dvec3 readPosition(TextCursor& words, std::size_t lineNumber, const std::string& place)
{
    glm::dvec3 position(0.0);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto number = words.number();
        if (!number)
            fail(ErrorKind::input,
                 "{}: line {}: coordinate {} of the vertex is not a finite number", place,
                 lineNumber, "xyz"[axis]);
        position[axis] = *number;
    }
    return position;
}

} // namespace

MeshScan scanObj(std::string_view file, const std::string& place)
{
    MeshScan scan;
    std::uint32_t material = 0;
    std::uint32_t node = 0;
    TextCursor cursor(file);
    while (!cursor.atEnd()) {
        const std::string_view line = cursor.line();
        TextCursor words(line);
        const std::string_view keyword = words.word();
        if (keyword == "v") {
            scan.positions.push_back(readPosition(words, cursor.lineNumber(), place));
        } else if (keyword == "f") {
            // Lines and points that somebody wrote as faces.
            if (countWords(words) < 3)
                continue;
            if (scan.materials.empty())
                material = indexOf(scan.materials, "ground");
            if (scan.nodes.empty())
                node = indexOf(scan.nodes, "ground");
            scan.materialOf.push_back(material);
            scan.nodeOf.push_back(node);
        } else if (keyword == "usemtl") {
            material = indexOf(scan.materials, nameBehind(line, words.offset()));
        } else if (keyword == "o" || keyword == "g") {
            node = indexOf(scan.nodes, nameBehind(line, words.offset()));
        }
        // The reader would open the material library and decode nothing that ground needs.
        if (keyword == "v" || keyword == "vt" || keyword == "vn" || keyword == "f") {
            scan.cleaned.append(line);
            scan.cleaned.push_back('\n');
        }
    }
    scan.vertices = scan.positions.size();
    scan.faces = scan.materialOf.size();
    return scan;
}

} // namespace sward::terrain
