#include "terrain/mesh_files/mesh_import_obj.h"

#include "core/error.h"
#include "terrain/mesh_files/polygon_soup.h"
#include "terrain/mesh_files/text_cursor.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <unordered_map>

namespace sward::terrain {
namespace {

// The text after a keyword, without surrounding spaces.
std::string nameBehind(std::string_view line, std::size_t keyword)
{
    std::string_view name = line.substr(std::min(keyword, line.size()));
    while (!name.empty() && (name.front() == ' ' || name.front() == '\t'))
        name.remove_prefix(1);
    while (!name.empty() && (name.back() == ' ' || name.back() == '\t'))
        name.remove_suffix(1);
    return std::string(name);
}

// Names in order of first appearance.
class Names {
public:
    // The index of `name`; adds it if new.
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

// What corners name by number, apart from their vertices.
template <typename Value>
struct ObjElements {
    std::vector<Value> values;
    std::size_t lost = 0;         // corners that name one which is not there
    std::size_t firstLine = 0;    // of those
    std::int64_t firstNumber = 0; // that the first of them names
    std::size_t firstCount = 0;   // of values at that line

    void warn(const char* what, const std::string& place, Diagnostics& diagnostics) const
    {
        if (lost > 0)
            diagnostics.warn("{}: line {}: a face names {} {}, but there are {}; {} corners are "
                             "kept without one",
                             place, firstLine, what, firstNumber, firstCount, lost);
    }
};

class ObjReader {
public:
    ObjReader(std::string_view file, const std::string& place, std::vector<std::string>& libraries)
        : cursor_(file)
        , place_(place)
        , libraries_(libraries)
        , soup_(place)
    {
    }

    Soup run(const MaskInputs& read, Diagnostics& diagnostics)
    {
        while (!cursor_.atEnd())
            readLine(wholeLine());
        soup_.finishFaces(diagnostics);
        uvs_.warn("texture coordinate", place_, diagnostics);
        normals_.warn("normal", place_, diagnostics);

        // Names are per face, a face may be several triangles.
        std::vector<std::uint32_t> materialOf;
        std::vector<std::uint32_t> nodeOf;
        for (const std::uint32_t face : soup_.faceOf()) {
            materialOf.push_back(materialOf_[face]);
            nodeOf.push_back(nodeOf_[face]);
        }
        const std::vector<std::string> nodes = nodes_.take();
        Soup soup = soup_.take(read, diagnostics, [&](std::uint32_t face) {
            return fmt::format("{}: object \"{}\"", place_, nodes[nodeOf_[face]]);
        });
        soup.materialOf = std::move(materialOf);
        soup.nodeOf = std::move(nodeOf);
        soup.nodes = nodes;
        for (const std::string& name : materials_.take())
            soup.materials.push_back({.name = name});
        return soup;
    }

private:
    // A backslash at the end of a line continues it.
    std::string_view wholeLine()
    {
        std::string_view line = cursor_.line();
        if (line.empty() || line.back() != '\\')
            return line;
        joined_.clear();
        while (!line.empty() && line.back() == '\\') {
            joined_.append(line.substr(0, line.size() - 1)).push_back(' ');
            line = cursor_.atEnd() ? std::string_view() : cursor_.line();
        }
        joined_.append(line);
        return joined_;
    }

    template <typename... Args>
    [[noreturn]] void failHere(fmt::format_string<Args...> format, Args&&... args) const
    {
        fail(ErrorKind::input, "{}: line {}: {}", place_, cursor_.lineNumber(),
             fmt::format(format, std::forward<Args>(args)...));
    }

    void readLine(std::string_view line)
    {
        TextCursor words(line);
        const std::string_view keyword = words.word();
        if (keyword == "v")
            readVertex(words);
        else if (keyword == "vt")
            uvs_.values.push_back(readNumbers<glm::vec2>(words));
        else if (keyword == "vn")
            normals_.values.push_back(readNumbers<glm::vec3>(words));
        else if (keyword == "f")
            readFace(words);
        else if (keyword == "usemtl")
            material_ = materials_.indexOf(nameBehind(line, words.offset()));
        else if (keyword == "mtllib")
            libraries_.push_back(nameBehind(line, words.offset()));
        else if (keyword == "o" || keyword == "g")
            node_ = nodes_.indexOf(nameBehind(line, words.offset()));
    }

    // An invalid number is read as 0.
    template <typename Vector>
    static Vector readNumbers(TextCursor& words)
    {
        Vector vector(0.0f);
        for (glm::length_t i = 0; i < Vector::length(); ++i)
            vector[i] = static_cast<float>(words.number().value_or(0.0));
        return vector;
    }

    void readVertex(TextCursor& words)
    {
        glm::dvec3 position(0.0);
        for (glm::length_t axis = 0; axis < 3; ++axis) {
            const std::string_view word = words.word();
            if (word.empty() || word.front() == '#')
                failHere("the vertex has {} coordinates: {} is missing", axis, "xyz"[axis]);
            const auto number = parseNumber(word);
            if (!number)
                failHere("coordinate {} of the vertex is not a finite number", "xyz"[axis]);
            position[axis] = *number;
        }
        soup_.addVertex(position);

        // Three more numbers are a colour.
        glm::vec4 color(0.0f, 0.0f, 0.0f, 1.0f);
        glm::length_t channels = 0;
        while (channels < 3)
            if (const auto number = words.number())
                color[channels++] = static_cast<float>(*number);
            else
                break;
        if (channels == 3)
            soup_.setColor(soup_.vertices() - 1, color);
    }

    // A corner's number: from 1, or backwards from the last if negative.
    std::int64_t numberOf(std::string_view word) const
    {
        std::int64_t number = 0;
        const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
        if (error != std::errc() || end != word.data() + word.size())
            failHere("a corner \"{}\" of a face is no number", word.substr(0, 16));
        return number;
    }

    static std::optional<std::size_t> indexOf(std::int64_t number, std::size_t count)
    {
        const auto size = static_cast<std::int64_t>(count);
        const std::int64_t index = number < 0 ? size + number : number - 1;
        return index < 0 || index >= size ? std::nullopt
                                          : std::optional(static_cast<std::size_t>(index));
    }

    // What a corner names; none, with a note, if it is not there.
    template <typename Value>
    std::optional<Value> elementOf(std::string_view word, ObjElements<Value>& elements) const
    {
        const std::int64_t number = numberOf(word);
        if (const auto index = indexOf(number, elements.values.size()))
            return elements.values[*index];
        if (elements.lost++ == 0) {
            elements.firstLine = cursor_.lineNumber();
            elements.firstNumber = number;
            elements.firstCount = elements.values.size();
        }
        return std::nullopt;
    }

    void readCorner(std::string_view word)
    {
        const std::size_t slash = std::min(word.find('/'), word.size());
        const std::size_t second = std::min(word.find('/', slash + 1), word.size());
        const std::int64_t number = numberOf(word.substr(0, slash));
        const auto vertex = indexOf(number, soup_.vertices());
        if (!vertex)
            failHere("a face names vertex {}, but there are {}", number, soup_.vertices());
        corners_.push_back(static_cast<std::uint32_t>(*vertex));
        if (slash + 1 < second)
            if (const auto uv = elementOf(word.substr(slash + 1, second - slash - 1), uvs_))
                cornerUvs_.push_back(*uv);
        cornerNormals_.push_back(
            second + 1 < word.size() ? elementOf(word.substr(second + 1), normals_) : std::nullopt);
    }

    void readFace(TextCursor& words)
    {
        corners_.clear();
        cornerUvs_.clear();
        cornerNormals_.clear();
        // A comment may end the line.
        for (std::string_view word = words.word(); !word.empty() && word.front() != '#';
             word = words.word())
            readCorner(word);
        if (materials_.isEmpty())
            material_ = materials_.indexOf("ground");
        if (nodes_.isEmpty())
            node_ = nodes_.indexOf("ground");
        materialOf_.push_back(material_);
        nodeOf_.push_back(node_);

        const bool isMapped = cornerUvs_.size() == corners_.size();
        soup_.addFace(corners_, isMapped ? cornerUvs_ : std::vector<glm::vec2>());
        for (std::size_t i = 0; i < corners_.size(); ++i)
            if (cornerNormals_[i])
                soup_.setNormal(corners_[i], *cornerNormals_[i]);
    }

    TextCursor cursor_;
    const std::string& place_;
    std::vector<std::string>& libraries_;
    PolygonSoup soup_;
    std::string joined_; // a line of several
    ObjElements<glm::vec2> uvs_;
    ObjElements<glm::vec3> normals_;
    Names materials_;
    Names nodes_;
    std::uint32_t material_ = 0;
    std::uint32_t node_ = 0;
    std::vector<std::uint32_t> materialOf_; // per face
    std::vector<std::uint32_t> nodeOf_;

    // Of the face that is being read.
    std::vector<std::uint32_t> corners_;
    std::vector<glm::vec2> cornerUvs_;
    std::vector<std::optional<glm::vec3>> cornerNormals_;
};

} // namespace

Soup readObj(std::string_view file, const std::string& place, const MaskInputs& read,
             std::vector<std::string>& libraries, Diagnostics& diagnostics)
{
    return ObjReader(file, place, libraries).run(read, diagnostics);
}

} // namespace sward::terrain
