#include "terrain/mesh_files/mesh_import_obj.h"

#include "core/error.h"
#include "terrain/mesh_files/openmesh_soup.h"
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
        if (soup_.facesSeen() == 0)
            fail(ErrorKind::input, "{}: no faces", place_);
        soup_.warnOfCrossed(diagnostics);

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
            uvs_.push_back(readNumbers<OpenMesh::Vec2f>(words));
        else if (keyword == "vn")
            normals_.push_back(readNumbers<OpenMesh::Vec3f>(words));
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
        Vector vector;
        for (std::size_t i = 0; i < vector.size(); ++i)
            vector[i] = static_cast<float>(words.number().value_or(0.0));
        return vector;
    }

    void readVertex(TextCursor& words)
    {
        glm::dvec3 position(0.0);
        for (glm::length_t axis = 0; axis < 3; ++axis) {
            const auto number = words.number();
            if (!number)
                failHere("coordinate {} of the vertex is not a finite number", "xyz"[axis]);
            position[axis] = *number;
        }
        const OpenMesh::VertexHandle vertex = soup_.add_vertex();
        soup_.soup().positions.back() = position;

        // Three more numbers are a colour.
        OpenMesh::Vec3f color;
        std::size_t channels = 0;
        while (channels < 3)
            if (const auto number = words.number())
                color[channels++] = static_cast<float>(*number);
            else
                break;
        if (channels == 3)
            soup_.set_color(vertex, color);
    }

    // Element index of a corner's number: counted from 1, or backwards from the last if negative.
    std::size_t elementOf(std::string_view word, std::size_t count, const char* what) const
    {
        std::int64_t number = 0;
        const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
        if (error != std::errc() || end != word.data() + word.size())
            failHere("a corner \"{}\" of a face is no number", word.substr(0, 16));
        const auto size = static_cast<std::int64_t>(count);
        const std::int64_t index = number < 0 ? size + number : number - 1;
        if (index < 0 || index >= size)
            failHere("a face names {} {}, but there are {}", what, number, count);
        return static_cast<std::size_t>(index);
    }

    void readCorner(std::string_view word)
    {
        const std::size_t slash = std::min(word.find('/'), word.size());
        const std::size_t second = std::min(word.find('/', slash + 1), word.size());
        const std::size_t count = soup_.n_vertices();
        const auto vertex = elementOf(word.substr(0, slash), count, "vertex");
        corners_.push_back(OpenMesh::VertexHandle(static_cast<int>(vertex)));
        if (slash + 1 < second)
            cornerUvs_.push_back(uvs_[elementOf(word.substr(slash + 1, second - slash - 1),
                                                uvs_.size(), "texture coordinate")]);
        cornerNormals_.push_back(
            second + 1 < word.size()
                ? std::optional(
                      normals_[elementOf(word.substr(second + 1), normals_.size(), "normal")])
                : std::nullopt);
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
        // Skip lines and points written as faces.
        if (corners_.size() < 3)
            return;
        if (materials_.isEmpty())
            material_ = materials_.indexOf("ground");
        if (nodes_.isEmpty())
            node_ = nodes_.indexOf("ground");
        materialOf_.push_back(material_);
        nodeOf_.push_back(node_);

        const OpenMesh::FaceHandle face = soup_.add_face(corners_);
        if (cornerUvs_.size() == corners_.size())
            soup_.add_face_texcoords(face, corners_[0], cornerUvs_);
        for (std::size_t i = 0; i < corners_.size(); ++i)
            if (cornerNormals_[i])
                soup_.set_normal(corners_[i], *cornerNormals_[i]);
    }

    TextCursor cursor_;
    const std::string& place_;
    std::vector<std::string>& libraries_;
    OpenMeshSoup soup_;
    std::string joined_; // a line of several
    std::vector<OpenMesh::Vec2f> uvs_;
    std::vector<OpenMesh::Vec3f> normals_;
    Names materials_;
    Names nodes_;
    std::uint32_t material_ = 0;
    std::uint32_t node_ = 0;
    std::vector<std::uint32_t> materialOf_; // per face
    std::vector<std::uint32_t> nodeOf_;

    // Of the face that is being read.
    OpenMeshSoup::VHandles corners_;
    std::vector<OpenMesh::Vec2f> cornerUvs_;
    std::vector<std::optional<OpenMesh::Vec3f>> cornerNormals_;
};

} // namespace

Soup readObj(std::string_view file, const std::string& place, const MaskInputs& read,
             std::vector<std::string>& libraries, Diagnostics& diagnostics)
{
    return ObjReader(file, place, libraries).run(read, diagnostics);
}

} // namespace sward::terrain
