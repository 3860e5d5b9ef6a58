#include "core/error.h"
#include "terrain/mesh_scan.h"
#include "terrain/text_cursor.h"

#include <algorithm>
#include <unordered_map>

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

// Names in the order in which they come.
class Names {
public:
    // The index of `name`, which joins if it is new.
    std::uint32_t indexOf(const std::string& name)
    {
        const auto [found, isNew] =
            indices_.try_emplace(name, static_cast<std::uint32_t>(names_.size()));
        if (isNew)
            names_.push_back(name);
        return found->second;
    }

    bool isEmpty() const { return names_.empty(); }
    std::vector<std::string> take() { return std::move(names_); }

private:
    std::vector<std::string> names_;
    std::unordered_map<std::string, std::uint32_t> indices_;
};

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
    Names materials;
    Names nodes;
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
            if (materials.isEmpty())
                material = materials.indexOf("ground");
            if (nodes.isEmpty())
                node = nodes.indexOf("ground");
            scan.materialOf.push_back(material);
            scan.nodeOf.push_back(node);
        } else if (keyword == "usemtl") {
            material = materials.indexOf(nameBehind(line, words.offset()));
        } else if (keyword == "mtllib") {
            scan.libraries.push_back(nameBehind(line, words.offset()));
        } else if (keyword == "o" || keyword == "g") {
            node = nodes.indexOf(nameBehind(line, words.offset()));
        }
        // The reader would open the material library, too, and keep nothing of it.
        if (keyword == "v" || keyword == "vt" || keyword == "vn" || keyword == "f") {
            scan.cleaned.append(line);
            scan.cleaned.push_back('\n');
        }
    }
    scan.materials = materials.take();
    scan.nodes = nodes.take();
    scan.vertices = scan.positions.size();
    scan.faces = scan.materialOf.size();
    return scan;
}

} // namespace sward::terrain
