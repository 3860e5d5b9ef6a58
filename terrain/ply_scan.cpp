#include "core/error.h"
#include "terrain/mesh_scan.h"
#include "terrain/text_cursor.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <optional>

namespace sward::terrain {
namespace {

struct Type {
    std::string_view name;
    std::size_t size;
    bool isFloat;
    bool isSigned;
};

// Both generations of names.
constexpr Type types[] = {
    {"char", 1, false, true},    {"int8", 1, false, true},    {"uchar", 1, false, false},
    {"uint8", 1, false, false},  {"short", 2, false, true},   {"int16", 2, false, true},
    {"ushort", 2, false, false}, {"uint16", 2, false, false}, {"int", 4, false, true},
    {"int32", 4, false, true},   {"uint", 4, false, false},   {"uint32", 4, false, false},
    {"float", 4, true, true},    {"float32", 4, true, true},  {"double", 8, true, true},
    {"float64", 8, true, true},
};

struct Property {
    std::string name;
    Type type{};
    std::optional<Type> length; // of a list
};

struct Element {
    std::string name;
    std::size_t count = 0;
    std::vector<Property> properties;
};

enum class Format { text, littleEndian, bigEndian };

class PlyScanner {
public:
    PlyScanner(std::string_view file, const std::string& place)
        : file_(file)
        , place_(place)
        , body_(std::string_view())
    {
    }

    MeshScan run()
    {
        readHeader();
        // Before anything is made for it: the least that the counts need must be there.
        double needed = 0.0;
        for (const Element& element : elements_)
            for (const Property& property : element.properties)
                needed +=
                    static_cast<double>(element.count) * static_cast<double>(leastSize(property));
        if (needed > static_cast<double>(rest_.size() + 1))
            fail(ErrorKind::input, "{}: truncated: its header needs {:.0f} bytes, {} follow it",
                 place_, needed, rest_.size());
        for (const Element& element : elements_)
            walk(element);
        scan_.isBinary = format_ != Format::text;
        scan_.cleaned = plainHeader();
        scan_.cleaned.append(rest_);
        if (!keepPositions_)
            scan_.positions.clear();
        return std::move(scan_);
    }

private:
    std::size_t leastSize(const Property& property) const
    {
        if (format_ == Format::text)
            return 2; // a digit and a space
        return property.length ? property.length->size : property.type.size;
    }

    Type typeNamed(std::string_view name, std::size_t line) const
    {
        for (const Type& type : types)
            if (type.name == name)
                return type;
        fail(ErrorKind::input, "{}: line {}: type \"{}\" is not known", place_, line,
             name.substr(0, 16));
    }

    void readHeader()
    {
        TextCursor cursor(file_);
        if (cursor.line() != "ply")
            fail(ErrorKind::input, "{}: does not begin with \"ply\"", place_);
        bool hasFormat = false;
        while (true) {
            if (cursor.atEnd())
                fail(ErrorKind::input, "{}: truncated: ends inside its header", place_);
            TextCursor words(cursor.line());
            const std::string_view keyword = words.word();
            if (keyword == "end_header")
                break;
            if (keyword == "format") {
                readFormat(words.word());
                hasFormat = true;
            } else if (keyword == "element") {
                Element element;
                element.name = std::string(words.word());
                const auto count = parseCount(words.word());
                if (element.name.empty() || !count)
                    fail(ErrorKind::input, "{}: line {}: element \"{}\" has no count", place_,
                         cursor.lineNumber(), element.name);
                element.count = *count;
                elements_.push_back(std::move(element));
            } else if (keyword == "property") {
                readProperty(words, cursor.lineNumber());
            }
        }
        if (!hasFormat)
            fail(ErrorKind::input, "{}: its header names no format", place_);
        rest_ = file_.substr(std::min(cursor.offset(), file_.size()));
        body_ = TextCursor(rest_);
    }

    void readFormat(std::string_view name)
    {
        if (name == "ascii")
            format_ = Format::text;
        else if (name == "binary_little_endian")
            format_ = Format::littleEndian;
        else if (name == "binary_big_endian")
            format_ = Format::bigEndian;
        else
            fail(ErrorKind::input, "{}: format \"{}\" is not known", place_, name.substr(0, 32));
    }

    void readProperty(TextCursor& words, std::size_t line)
    {
        if (elements_.empty())
            fail(ErrorKind::input, "{}: line {}: a property before the first element", place_,
                 line);
        Property property;
        std::string_view type = words.word();
        if (type == "list") {
            property.length = typeNamed(words.word(), line);
            if (property.length->isFloat)
                fail(ErrorKind::input, "{}: line {}: a list cannot have a length of floats", place_,
                     line);
            type = words.word();
        }
        property.type = typeNamed(type, line);
        property.name = std::string(words.word());
        if (property.name.empty())
            fail(ErrorKind::input, "{}: line {}: a property without a name", place_, line);
        elements_.back().properties.push_back(std::move(property));
    }

    // The header in the words of the format alone; OpenMesh's reader never ends on some others.
    std::string plainHeader() const
    {
        const char* const name = format_ == Format::text           ? "ascii"
                                 : format_ == Format::littleEndian ? "binary_little_endian"
                                                                   : "binary_big_endian";
        std::string header = fmt::format("ply\nformat {} 1.0\n", name);
        for (const Element& element : elements_) {
            header += fmt::format("element {} {}\n", element.name, element.count);
            for (const Property& property : element.properties)
                header += property.length
                              ? fmt::format("property list {} {} {}\n", property.length->name,
                                            property.type.name, property.name)
                              : fmt::format("property {} {}\n", property.type.name, property.name);
        }
        return header + "end_header\n";
    }

    [[noreturn]] void failTruncated(const Element& element, std::size_t index) const
    {
        fail(ErrorKind::input, "{}: truncated or damaged at {} {} of {}", place_, element.name,
             index, element.count);
    }

    double readNumber(const Type& type, const Element& element, std::size_t index)
    {
        if (format_ == Format::text) {
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
        if (format_ == Format::bigEndian)
            std::reverse(bytes, bytes + type.size);
        std::uint64_t bits = 0;
        std::memcpy(&bits, bytes, sizeof bits);
        if (type.isFloat)
            return type.size == 8 ? std::bit_cast<double>(bits)
                                  : static_cast<double>(
                                        std::bit_cast<float>(static_cast<std::uint32_t>(bits)));
        // Bring the sign to where a 64-bit number has it.
        const unsigned shift = 64 - 8 * static_cast<unsigned>(type.size);
        if (type.isSigned)
            return static_cast<double>(static_cast<std::int64_t>(bits << shift) >> shift);
        return static_cast<double>(bits);
    }

    void readList(const Property& property, const Element& element, std::size_t index)
    {
        const double length = readNumber(*property.length, element, index);
        const double left = static_cast<double>(
            format_ == Format::text ? rest_.size() - std::min(body_.offset(), rest_.size())
                                    : rest_.size() - at_);
        if (!(length >= 0.0) || length > left)
            fail(ErrorKind::input, "{}: {} {}: a list of {} entries, which the file cannot hold",
                 place_, element.name, index, length);
        const auto count = static_cast<std::size_t>(length);
        const bool isCorners = property.name == "vertex_indices" || property.name == "vertex_index";
        for (std::size_t i = 0; i < count; ++i) {
            const double value = readNumber(property.type, element, index);
            if (isCorners && !(value >= 0.0 && value < static_cast<double>(scan_.vertices)))
                fail(ErrorKind::input, "{}: {} {}: names vertex {}, but there are {}", place_,
                     element.name, index, value, scan_.vertices);
        }
    }

    void walk(const Element& element)
    {
        const bool isVertex = element.name == "vertex";
        if (isVertex)
            scan_.vertices = element.count;
        if (element.name == "face")
            scan_.faces = element.count;
        for (std::size_t i = 0; i < element.count; ++i) {
            glm::dvec3 position(0.0);
            for (const Property& property : element.properties) {
                if (property.length) {
                    readList(property, element, i);
                    continue;
                }
                const double value = readNumber(property.type, element, i);
                const std::size_t axis = property.name == "x"   ? 0
                                         : property.name == "y" ? 1
                                         : property.name == "z" ? 2
                                                                : 3;
                if (!isVertex || axis == 3)
                    continue;
                if (!std::isfinite(value))
                    fail(ErrorKind::input, "{}: coordinate {} of vertex {} is not a finite number",
                         place_, property.name, i);
                position[axis] = value;
                keepPositions_ =
                    keepPositions_ || property.type.size == 8 || format_ == Format::text;
            }
            if (isVertex)
                scan_.positions.push_back(position);
        }
    }

    std::string_view file_;
    const std::string& place_;
    std::string_view rest_; // behind the header
    TextCursor body_;
    std::size_t at_ = 0;
    Format format_ = Format::text;
    std::vector<Element> elements_;
    MeshScan scan_;
    bool keepPositions_ = false;
};

} // namespace

MeshScan scanPly(std::string_view file, const std::string& place)
{
    return PlyScanner(file, place).run();
}

} // namespace sward::terrain
