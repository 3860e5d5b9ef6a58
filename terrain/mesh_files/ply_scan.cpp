#include "core/error.h"
#include "terrain/mesh_files/mesh_scan.h"
#include "terrain/mesh_files/ply_header.h"
#include "terrain/mesh_files/text_cursor.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <span>

namespace sward::terrain {
namespace {

// What scanPly() reads of a vertex: its coordinates, colour and texture coordinates.
enum class PlyRole { none, position, color, uv };

struct PlyUse {
    PlyRole role = PlyRole::none;
    glm::length_t axis = 0;
};

PlyUse plyUseOf(const PlyElement& element, const PlyProperty& property)
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
        if (element.name == "vertex" && !property.length && one.name == property.name)
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

class PlyScanner {
public:
    PlyScanner(std::string_view file, const std::string& place)
        : place_(place)
        , header_(readPlyHeader(file, place))
        , rest_(header_.rest)
        , body_(rest_)
        , isPlain_(terrain::isPlain(header_))
    {
    }

    MeshScan run()
    {
        // Check the minimum size for the counts before allocating memory.
        double needed = 0.0;
        for (const PlyElement& element : header_.elements)
            for (const PlyProperty& property : element.properties)
                needed +=
                    static_cast<double>(element.count) * static_cast<double>(minSize(property));
        if (needed > static_cast<double>(rest_.size() + 1))
            fail(ErrorKind::input, "{}: truncated: its header needs {:.0f} bytes, {} follow it",
                 place_, needed, rest_.size());
        // Faces may come before the vertices.
        for (const PlyElement& element : header_.elements)
            if (element.name == "vertex")
                scan_.vertices = element.count;
        for (const PlyElement& element : header_.elements) {
            if (element.count > 0 && element.properties.empty())
                fail(ErrorKind::input, "{}: element {} has no properties for its {} entries",
                     place_, element.name, element.count);
            walk(element);
        }
        scan_.isBinary = !isPlain_ || header_.format != PlyHeader::Format::text;
        scan_.cleaned = isPlain_ ? plainPlyHeader(header_) + plainBody_
                                 : orderlyPlyHeader(header_, scan_.faces) + plainBody_ + faceBody_;
        if (!keepPositions_)
            scan_.positions.clear();
        return std::move(scan_);
    }

private:
    std::size_t minSize(const PlyProperty& property) const
    {
        if (header_.format == PlyHeader::Format::text)
            return 2; // a digit and a space
        return property.length ? property.length->size : property.type.size;
    }

    // Bytes read after the header.
    std::size_t position() const
    {
        return header_.format == PlyHeader::Format::text ? std::min(body_.offset(), rest_.size())
                                                         : at_;
    }

    [[noreturn]] void failTruncated(const PlyElement& element, std::size_t index) const
    {
        fail(ErrorKind::input, "{}: truncated or damaged at {} {} of {}", place_, element.name,
             index, element.count);
    }

    double readNumber(const PlyType& type, const PlyElement& element, std::size_t index)
    {
        if (header_.format == PlyHeader::Format::text) {
            const auto number = body_.number();
            if (!number)
                fail(ErrorKind::input, "{}: {} {} of {}: not a finite number, or the file ends",
                     place_, element.name, index, element.count);
            return *number;
        }
        if (rest_.size() - at_ < type.size)
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

    void readList(const PlyProperty& property, const PlyElement& element, std::size_t index)
    {
        const double length = readNumber(*property.length, element, index);
        const double left = static_cast<double>(rest_.size() - position());
        if (!(length >= 0.0) || length > left)
            fail(ErrorKind::input, "{}: {} {}: a list of {} entries, which the file cannot hold",
                 place_, element.name, index, length);
        if (length != std::floor(length))
            fail(ErrorKind::input, "{}: {} {}: a list of {} entries, which is no whole number",
                 place_, element.name, index, length);
        const auto count = static_cast<std::size_t>(length);
        const bool named = property.isCorners();
        const bool isStrip = named && element.name == "tristrips";
        const bool isUv = element.name == "face" && property.name == "texcoord";
        std::vector<float> numbers;
        corners_.clear();
        for (std::size_t i = 0; i < count; ++i) {
            const double value = readNumber(property.type, element, index);
            if (isUv)
                numbers.push_back(static_cast<float>(value));
            if (!named)
                continue;
            // −1 in a strip begins another one.
            const bool isSound = (value >= 0.0 && value < static_cast<double>(scan_.vertices)) ||
                                 (isStrip && value == -1.0);
            if (!isSound || value != std::floor(value))
                fail(ErrorKind::input, "{}: {} {}: names vertex {}, but there are {}", place_,
                     element.name, index, value, scan_.vertices);
            if (!isPlain_)
                corners_.push_back(static_cast<std::int32_t>(value));
        }
        if (isStrip)
            addStrips();
        else if (named && !isPlain_ && element.name == "face")
            addFace(corners_);
        if (!isUv)
            return;
        scan_.faceUvs.resize(index + 1);
        for (std::size_t i = 0; i + 1 < numbers.size(); i += 2)
            scan_.faceUvs[index].emplace_back(numbers[i], numbers[i + 1]);
    }

    template <typename Value>
    static void addValue(Value value, std::string& to)
    {
        char bytes[sizeof value];
        std::memcpy(bytes, &value, sizeof value);
        to.append(bytes, sizeof value);
    }

    void addFace(std::span<const std::int32_t> corners)
    {
        addValue(static_cast<std::int32_t>(corners.size()), faceBody_);
        for (const std::int32_t corner : corners)
            addValue(corner, faceBody_);
    }

    // Every other triangle of a strip is flipped.
    void addStrips()
    {
        std::size_t begin = 0;
        for (std::size_t i = 0; i < corners_.size(); ++i) {
            if (corners_[i] < 0) {
                begin = i + 1;
                continue;
            }
            if (i < begin + 2)
                continue;
            const bool isFlipped = (i - begin) % 2 == 1;
            const std::int32_t triangle[] = {corners_[i - 2], corners_[isFlipped ? i : i - 1],
                                             corners_[isFlipped ? i - 1 : i]};
            addFace(triangle);
            ++scan_.faces;
        }
    }

    // Keeps a number of vertex `index`.
    void readScalar(const PlyUse& use, const PlyProperty& property, const PlyElement& element,
                    std::size_t index)
    {
        const double value = readNumber(property.type, element, index);
        if (!isPlain_ && isNeeded(element, property))
            addScalar(value, use.role == PlyRole::position, property.type);
        switch (use.role) {
        case PlyRole::none:
            return;
        case PlyRole::position:
            break;
        case PlyRole::color:
            scan_.colors[index][use.axis] = static_cast<float>(value / plyUnitOf(property.type));
            return;
        case PlyRole::uv:
            scan_.uvs[index][use.axis] = static_cast<float>(value);
            return;
        }
        if (!std::isfinite(value))
            fail(ErrorKind::input, "{}: coordinate {} of vertex {} is not a finite number", place_,
                 property.name, index);
        scan_.positions[index][use.axis] = value;
        keepPositions_ = keepPositions_ || property.type.size == 8 || !isPlain_ ||
                         header_.format == PlyHeader::Format::text;
    }

    // A number of an orderly file: coordinates are doubles, others keep their type.
    void addScalar(double value, bool isPlace, const PlyType& type)
    {
        if (isPlace || (type.isFloat && type.size == 8))
            addValue(value, plainBody_);
        else if (type.isFloat)
            addValue(static_cast<float>(value), plainBody_);
        else {
            const auto bits = static_cast<std::int64_t>(std::clamp(value, -0x1p53, 0x1p53));
            char bytes[sizeof bits];
            std::memcpy(bytes, &bits, sizeof bits);
            plainBody_.append(bytes, type.size);
        }
    }

    // What is read of each property. Makes room for colours and texture coordinates.
    std::vector<PlyUse> usesOf(const PlyElement& element)
    {
        std::vector<PlyUse> uses;
        const auto allocate = [&](auto& values, const auto& value, PlyRole role) {
            const auto has = [&](const PlyUse& use) { return use.role == role; };
            if (std::any_of(uses.begin(), uses.end(), has))
                values.assign(element.count, value);
        };
        for (const PlyProperty& property : element.properties)
            uses.push_back(plyUseOf(element, property));
        if (element.name == "vertex")
            scan_.positions.assign(element.count, glm::dvec3(0.0));
        allocate(scan_.colors, glm::vec4(0.0f, 0.0f, 0.0f, 1.0f), PlyRole::color);
        allocate(scan_.uvs, glm::vec2(0.0f), PlyRole::uv);
        return uses;
    }

    void walk(const PlyElement& element)
    {
        const std::vector<PlyUse> uses = usesOf(element);
        if (element.name == "face")
            scan_.faces += element.count;
        for (std::size_t i = 0; i < element.count; ++i) {
            for (std::size_t p = 0; p < element.properties.size(); ++p) {
                const PlyProperty& property = element.properties[p];
                const std::size_t begin = position();
                if (property.length)
                    readList(property, element, i);
                else
                    readScalar(uses[p], property, element, i);
                if (isPlain_ && isNeeded(element, property))
                    plainBody_.append(rest_.substr(begin, position() - begin));
            }
            if (isPlain_ && header_.format == PlyHeader::Format::text)
                plainBody_.push_back('\n');
        }
    }

    const std::string& place_;
    PlyHeader header_;
    std::string_view rest_; // after the header
    TextCursor body_;
    std::size_t at_ = 0;
    MeshScan scan_;
    std::string plainBody_;             // the part of the rest for the reader
    bool isPlain_;                      // the reader takes order and types as they are
    std::string faceBody_;              // faces of an orderly file
    std::vector<std::int32_t> corners_; // of the last list
    bool keepPositions_ = false;
};

} // namespace

MeshScan scanPly(std::string_view file, const std::string& place)
{
    return PlyScanner(file, place).run();
}

} // namespace sward::terrain
