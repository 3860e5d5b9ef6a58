#include "core/error.h"
#include "terrain/mesh_files/mesh_readers.h"
#include "terrain/mesh_files/ply_header.h"
#include "terrain/mesh_files/text_cursor.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

namespace sward::terrain {
namespace {

// What is read of a vertex.
enum class PlyRole { none, position, normal, color, uv };

struct PlyUse {
    PlyRole role = PlyRole::none;
    glm::length_t axis = 0;
};

PlyUse plyUseOf(const PlyProperty& property)
{
    struct Known {
        std::string_view name;
        PlyRole role;
        glm::length_t axis;
    };
    constexpr Known all[] = {
        {"x", PlyRole::position, 0},
        {"y", PlyRole::position, 1},
        {"z", PlyRole::position, 2},
        {"nx", PlyRole::normal, 0},
        {"ny", PlyRole::normal, 1},
        {"nz", PlyRole::normal, 2},
        {"red", PlyRole::color, 0},
        {"green", PlyRole::color, 1},
        {"blue", PlyRole::color, 2},
        {"alpha", PlyRole::color, 3},
        {"diffuse_red", PlyRole::color, 0},
        {"diffuse_green", PlyRole::color, 1},
        {"diffuse_blue", PlyRole::color, 2},
        {"r", PlyRole::color, 0},
        {"g", PlyRole::color, 1},
        {"b", PlyRole::color, 2},
        {"a", PlyRole::color, 3},
        {"texture_u", PlyRole::uv, 0},
        {"texture_v", PlyRole::uv, 1},
        {"u", PlyRole::uv, 0},
        {"v", PlyRole::uv, 1},
        {"s", PlyRole::uv, 0},
        {"t", PlyRole::uv, 1},
    };
    for (const Known& one : all)
        if (!property.length && one.name == property.name)
            return {one.role, one.axis};
    return {};
}

// The number of an integer type that stands for 1 in a colour; 1 for types that have no such rule.
double plyUnitOf(const PlyType& type)
{
    if (type.isFloat || type.size > 2)
        return 1.0;
    return static_cast<double>((1U << (8 * type.size - (type.isSigned ? 1 : 0))) - 1U);
}

class PlyReader {
public:
    PlyReader(std::string_view file, const std::string& place, PolygonSoup& soup)
        : place_(place)
        , header_(readPlyHeader(file, place))
        , rest_(header_.rest)
        , body_(rest_)
        , isText_(header_.format == PlyHeader::Format::text)
        , soup_(soup)
    {
    }

    MeshForm run(Diagnostics& diagnostics)
    {
        requireBytes();
        for (const PlyElement& element : header_.elements)
            if (element.name == "vertex")
                vertices_ = element.count;
        for (const PlyElement& element : header_.elements)
            walk(element);
        addFaces();
        warnOfRest(diagnostics);
        return {.isText = isText_, .isSingle = isSingle_};
    }

private:
    // The least size for the counts of the header, before memory is allocated.
    void requireBytes() const
    {
        double needed = 0.0;
        for (const PlyElement& element : header_.elements) {
            if (element.count > 0 && element.properties.empty())
                fail(ErrorKind::input, "{}: element {} has no properties for its {} entries",
                     place_, element.name, element.count);
            for (const PlyProperty& property : element.properties)
                needed +=
                    static_cast<double>(element.count) * static_cast<double>(minSize(property));
        }
        if (needed > static_cast<double>(rest_.size() + 1))
            fail(ErrorKind::input, "{}: truncated: its header needs {:.0f} bytes, {} follow it",
                 place_, needed, rest_.size());
    }

    std::size_t minSize(const PlyProperty& property) const
    {
        if (isText_)
            return 2; // a digit and a space
        return property.length ? property.length->size : property.type.size;
    }

    // Numbers left over tell of a header that is wrong.
    void warnOfRest(Diagnostics& diagnostics) const
    {
        const std::string_view over = rest_.substr(rest_.size() - left());
        const std::size_t lines = filledLines(over);
        if (lines > 0)
            diagnostics.warn("{}: {} {} left over behind the elements that its header counts, and "
                             "not read",
                             place_, isText_ ? lines : over.size(),
                             isText_ ? "lines are" : "bytes are");
    }

    // Bytes that are left after the header.
    std::size_t left() const
    {
        return rest_.size() - (isText_ ? std::min(body_.offset(), rest_.size()) : at_);
    }

    [[noreturn]] void failTruncated(const PlyElement& element, std::size_t index) const
    {
        fail(ErrorKind::input, "{}: truncated or damaged at {} {} of {}", place_, element.name,
             index, element.count);
    }

    // A word of a text that is no number is NaN.
    double readNumber(const PlyType& type, const PlyElement& element, std::size_t index)
    {
        if (isText_) {
            const std::string_view word = body_.word();
            if (word.empty())
                failTruncated(element, index);
            return parseNumber(word).value_or(std::numeric_limits<double>::quiet_NaN());
        }
        if (left() < type.size)
            failTruncated(element, index);
        unsigned char bytes[8] = {};
        std::memcpy(bytes, rest_.data() + at_, type.size);
        at_ += type.size;
        if (header_.format == PlyHeader::Format::bigEndian)
            std::reverse(bytes, bytes + type.size);
        std::uint64_t bits = 0;
        std::memcpy(&bits, bytes, sizeof bits);
        if (type.isFloat)
            return type.size == 8 ? std::bit_cast<double>(bits)
                                  : static_cast<double>(
                                        std::bit_cast<float>(static_cast<std::uint32_t>(bits)));
        // Sign-extend to 64 bits.
        const unsigned shift = 64 - 8 * static_cast<unsigned>(type.size);
        if (type.isSigned)
            return static_cast<double>(static_cast<std::int64_t>(bits << shift) >> shift);
        return static_cast<double>(bits);
    }

    std::size_t readLength(const PlyProperty& property, const PlyElement& element,
                           std::size_t index)
    {
        const double length = readNumber(*property.length, element, index);
        if (!(length >= 0.0) || length > static_cast<double>(left()))
            fail(ErrorKind::input, "{}: {} {}: a list of {} entries, which the file cannot hold",
                 place_, element.name, index, length);
        if (length != std::floor(length))
            fail(ErrorKind::input, "{}: {} {}: a list of {} entries, which is no whole number",
                 place_, element.name, index, length);
        return static_cast<std::size_t>(length);
    }

    // A list whose numbers nothing reads.
    void skipList(const PlyProperty& property, const PlyElement& element, std::size_t index)
    {
        for (std::size_t i = readLength(property, element, index); i > 0; --i)
            readNumber(property.type, element, index);
    }

    // Appends the corners of a face or strip. −1 in a strip begins another one.
    void readCorners(const PlyProperty& property, const PlyElement& element, std::size_t index,
                     bool isStrip)
    {
        for (std::size_t i = readLength(property, element, index); i > 0; --i) {
            const double value = readNumber(property.type, element, index);
            if (isStrip && value == -1.0) {
                corners_.push_back(noCorner);
                continue;
            }
            if (std::isnan(value))
                fail(ErrorKind::input, "{}: {} {}: a corner is no number", place_, element.name,
                     index);
            if (value != std::floor(value))
                fail(ErrorKind::input,
                     "{}: {} {}: the number of its vertex, about {:.6g}, has a fraction", place_,
                     element.name, index, value);
            if (!(value >= 0.0) || value >= static_cast<double>(vertices_))
                fail(ErrorKind::input, "{}: {} {}: names vertex {:.10g}, but there are {}", place_,
                     element.name, index, value, vertices_);
            corners_.push_back(static_cast<std::uint32_t>(value));
        }
    }

    void readVertex(const PlyElement& element, const std::vector<PlyUse>& uses, std::size_t index)
    {
        glm::dvec3 position(0.0);
        glm::vec3 normal(0.0f);
        glm::vec4 color(0.0f, 0.0f, 0.0f, 1.0f);
        glm::vec2 uv(0.0f);
        for (std::size_t p = 0; p < element.properties.size(); ++p) {
            const PlyProperty& property = element.properties[p];
            if (property.length) {
                skipList(property, element, index);
                continue;
            }
            const double value = readNumber(property.type, element, index);
            switch (const glm::length_t axis = uses[p].axis; uses[p].role) {
            case PlyRole::none:
                break;
            case PlyRole::position:
                if (!std::isfinite(value))
                    fail(ErrorKind::input, "{}: coordinate {} of vertex {} is not a finite number",
                         place_, property.name, index);
                position[axis] = value;
                break;
            case PlyRole::normal:
                normal[axis] = std::isfinite(value) ? static_cast<float>(value) : 0.0f;
                break;
            case PlyRole::color:
                color[axis] = static_cast<float>(value / plyUnitOf(property.type));
                break;
            case PlyRole::uv:
                uv[axis] = static_cast<float>(value);
                break;
            }
        }
        soup_.addVertex(position);
        if (hasNormals_)
            soup_.setNormal(index, normal);
        if (hasColors_)
            soup_.setColor(index, color);
        if (hasUvs_)
            soup_.setUv(index, uv);
    }

    void readFace(const PlyElement& element, std::size_t index, bool isStrip)
    {
        const std::size_t begin = corners_.size();
        const std::size_t uvBegin = uvs_.size();
        for (const PlyProperty& property : element.properties) {
            if (property.isCorners())
                readCorners(property, element, index, isStrip);
            else if (property.length && property.name == "texcoord" && !isStrip)
                readUvs(property, element, index);
            else if (property.length)
                skipList(property, element, index);
            else
                readNumber(property.type, element, index);
        }
        if (isStrip) {
            cutStrip(begin);
            return;
        }
        // Texture coordinates that are not one pair to a corner are none.
        const std::size_t count = corners_.size() - begin;
        const bool isMapped = uvs_.size() - uvBegin == count && count > 0;
        if (!isMapped)
            uvs_.resize(uvBegin);
        faces_.push_back({static_cast<std::uint32_t>(count), isMapped});
    }

    void readUvs(const PlyProperty& property, const PlyElement& element, std::size_t index)
    {
        float first = 0.0f;
        const std::size_t count = readLength(property, element, index);
        for (std::size_t i = 0; i < count; ++i) {
            const auto number = static_cast<float>(readNumber(property.type, element, index));
            if (i % 2 == 0)
                first = number;
            else
                uvs_.emplace_back(first, number);
        }
    }

    // Replaces the strips from corner `begin` on by their triangles: every other one is flipped.
    void cutStrip(std::size_t begin)
    {
        const std::vector<std::uint32_t> strip(
            corners_.begin() + static_cast<std::ptrdiff_t>(begin), corners_.end());
        corners_.resize(begin);
        std::size_t start = 0;
        for (std::size_t i = 0; i < strip.size(); ++i) {
            if (strip[i] == noCorner)
                start = i + 1;
            if (strip[i] == noCorner || i < start + 2)
                continue;
            const bool isFlipped = (i - start) % 2 == 1;
            corners_.insert(corners_.end(), {strip[i - 2], strip[isFlipped ? i : i - 1],
                                             strip[isFlipped ? i - 1 : i]});
            faces_.push_back({3, false});
        }
    }

    void walk(const PlyElement& element)
    {
        const bool isVertex = element.name == "vertex";
        const bool isStrip = element.name == "tristrips";
        const bool isFace = element.name == "face" || isStrip;
        std::vector<PlyUse> uses;
        for (const PlyProperty& property : element.properties) {
            uses.push_back(isVertex ? plyUseOf(property) : PlyUse{});
            hasNormals_ = hasNormals_ || uses.back().role == PlyRole::normal;
            hasColors_ = hasColors_ || uses.back().role == PlyRole::color;
            hasUvs_ = hasUvs_ || uses.back().role == PlyRole::uv;
            isSingle_ = isSingle_ || (!isText_ && uses.back().role == PlyRole::position &&
                                      property.type.isFloat && property.type.size == 4);
        }
        for (std::size_t i = 0; i < element.count; ++i) {
            if (isVertex) {
                readVertex(element, uses, i);
                continue;
            }
            if (isFace) {
                readFace(element, i, isStrip);
                continue;
            }
            for (const PlyProperty& property : element.properties)
                if (property.length)
                    skipList(property, element, i);
                else
                    readNumber(property.type, element, i);
        }
    }

    // Faces may come before the vertices in the file.
    void addFaces()
    {
        std::span<const std::uint32_t> corners = corners_;
        std::span<const glm::vec2> uvs = uvs_;
        for (const Face& face : faces_) {
            const std::size_t mapped = face.isMapped ? face.corners : 0;
            soup_.addFace(corners.first(face.corners), uvs.first(mapped));
            corners = corners.subspan(face.corners);
            uvs = uvs.subspan(mapped);
        }
    }

    static constexpr std::uint32_t noCorner = 0xffffffffU;

    struct Face {
        std::uint32_t corners;
        bool isMapped; // a pair of texture coordinates for each corner
    };

    const std::string& place_;
    PlyHeader header_;
    std::string_view rest_; // after the header
    TextCursor body_;       // of a text
    std::size_t at_ = 0;    // of a binary file: bytes read of `rest_`
    bool isText_;
    PolygonSoup& soup_;
    std::size_t vertices_ = 0; // by the header
    bool isSingle_ = false;
    bool hasNormals_ = false; // of the vertices
    bool hasColors_ = false;
    bool hasUvs_ = false;
    std::vector<std::uint32_t> corners_; // of all faces
    std::vector<glm::vec2> uvs_;         // of the corners of faces that have them
    std::vector<Face> faces_;
};

} // namespace

MeshForm readPly(std::string_view file, const std::string& place, PolygonSoup& soup,
                 Diagnostics& diagnostics)
{
    return PlyReader(file, place, soup).run(diagnostics);
}

} // namespace sward::terrain
