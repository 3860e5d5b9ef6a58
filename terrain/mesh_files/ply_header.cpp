#include "terrain/mesh_files/ply_header.h"

#include "core/error.h"
#include "terrain/mesh_files/text_cursor.h"

#include <algorithm>

namespace sward::terrain {
namespace {

constexpr std::size_t maxElements = 64;
constexpr std::size_t maxProperties = 1024; // of one element

// Old and new type names.
constexpr PlyType types[] = {
    {"char", 1, false, true},    {"int8", 1, false, true},    {"uchar", 1, false, false},
    {"uint8", 1, false, false},  {"short", 2, false, true},   {"int16", 2, false, true},
    {"ushort", 2, false, false}, {"uint16", 2, false, false}, {"int", 4, false, true},
    {"int32", 4, false, true},   {"uint", 4, false, false},   {"uint32", 4, false, false},
    {"float", 4, true, true},    {"float32", 4, true, true},  {"double", 8, true, true},
    {"float64", 8, true, true},
};

PlyType typeNamed(std::string_view name, std::size_t line, const std::string& place)
{
    for (const PlyType& type : types)
        if (type.name == name)
            return type;
    fail(ErrorKind::input, "{}: line {}: type \"{}\" is not known", place, line,
         name.substr(0, 16));
}

PlyHeader::Format formatNamed(std::string_view name, const std::string& place)
{
    if (name == "ascii")
        return PlyHeader::Format::text;
    if (name == "binary_little_endian")
        return PlyHeader::Format::littleEndian;
    if (name == "binary_big_endian")
        return PlyHeader::Format::bigEndian;
    fail(ErrorKind::input, "{}: format \"{}\" is not known", place, name.substr(0, 32));
}

PlyElement readElement(TextCursor& words, std::size_t line, const std::string& place)
{
    PlyElement element;
    element.name = std::string(words.word());
    const auto count = parseCount(words.word());
    if (element.name.empty() || !count)
        fail(ErrorKind::input, "{}: line {}: element \"{}\" has no count", place, line,
             element.name);
    element.count = *count;
    return element;
}

PlyProperty readProperty(TextCursor& words, std::size_t line, const std::string& place)
{
    PlyProperty property;
    std::string_view type = words.word();
    if (type == "list") {
        property.length = typeNamed(words.word(), line, place);
        type = words.word();
    }
    property.type = typeNamed(type, line, place);
    property.name = std::string(words.word());
    if (property.name.empty())
        fail(ErrorKind::input, "{}: line {}: a property without a name", place, line);
    return property;
}

} // namespace

PlyHeader readPlyHeader(std::string_view file, const std::string& place)
{
    PlyHeader header;
    TextCursor cursor(file);
    if (cursor.line() != "ply")
        fail(ErrorKind::input, "{}: does not begin with \"ply\"", place);
    bool hasFormat = false;
    while (true) {
        if (cursor.atEnd())
            fail(ErrorKind::input, "{}: truncated: ends inside its header", place);
        TextCursor words(cursor.line());
        const std::string_view keyword = words.word();
        if (keyword == "end_header")
            break;
        if (keyword == "format") {
            header.format = formatNamed(words.word(), place);
            hasFormat = true;
        } else if (keyword == "element") {
            PlyElement element = readElement(words, cursor.lineNumber(), place);
            if (header.elements.size() == maxElements)
                fail(ErrorKind::input, "{}: line {}: more than {} elements", place,
                     cursor.lineNumber(), maxElements);
            for (const PlyElement& other : header.elements)
                if (other.name == element.name)
                    fail(ErrorKind::input, "{}: line {}: a second element \"{}\"", place,
                         cursor.lineNumber(), element.name);
            header.elements.push_back(std::move(element));
        } else if (keyword == "property") {
            if (header.elements.empty())
                fail(ErrorKind::input, "{}: line {}: a property before the first element", place,
                     cursor.lineNumber());
            header.elements.back().properties.push_back(
                readProperty(words, cursor.lineNumber(), place));
            if (header.elements.back().properties.size() > maxProperties)
                fail(ErrorKind::input, "{}: line {}: more than {} properties", place,
                     cursor.lineNumber(), maxProperties);
        }
    }
    if (!hasFormat)
        fail(ErrorKind::input, "{}: its header names no format", place);
    // Where CR alone ends the lines, a line feed behind the last one is the first byte of the body.
    std::size_t end = std::min(cursor.offset(), file.size());
    const bool endsByCr = file.size() > 4 && file[3] == '\r' && file[4] != '\n';
    if (endsByCr && end >= 2 && file[end - 1] == '\n' && file[end - 2] == '\r')
        --end;
    header.rest = file.substr(end);
    return header;
}

bool isNeeded(const PlyElement& element, const PlyProperty& property)
{
    if (element.name == "face" || element.name == "tristrips")
        return property.isCorners();
    constexpr std::string_view known[] = {"x", "y", "z", "nx", "ny", "nz"};
    return element.name == "vertex" && !property.length &&
           std::find(std::begin(known), std::end(known), property.name) != std::end(known);
}

bool isPlain(const PlyHeader& header)
{
    const auto isInt = [](const PlyType& type) {
        return type.name == "int" || type.name == "int32" || type.name == "uint" ||
               type.name == "uint32";
    };
    std::size_t vertexAt = header.elements.size();
    for (std::size_t i = 0; i < header.elements.size(); ++i) {
        const PlyElement& element = header.elements[i];
        if (element.name == "vertex")
            vertexAt = i;
        if (element.name == "tristrips" || (element.name == "face" && i < vertexAt))
            return false;
        for (const PlyProperty& property : element.properties) {
            if (!isNeeded(element, property))
                continue;
            if (property.length) {
                const std::string_view length = property.length->name;
                if (length != "uchar" && length != "uint8" && length != "int" && length != "int32")
                    return false;
                if (!isInt(property.type))
                    return false;
            } else if (isCoordinate(property) && !property.type.isFloat) {
                return false;
            }
        }
    }
    return true;
}

bool isCoordinate(const PlyProperty& property)
{
    return property.name.size() == 1 && property.name[0] >= 'x' && property.name[0] <= 'z';
}

namespace {

std::string propertyLine(const PlyProperty& property, bool isOrderly)
{
    if (property.length)
        return isOrderly ? fmt::format("property list int int {}\n", property.name)
                         : fmt::format("property list {} {} {}\n", property.length->name,
                                       property.type.name, property.name);
    const bool isWidened = isOrderly && isCoordinate(property);
    return fmt::format("property {} {}\n", isWidened ? "double" : property.type.name,
                       property.name);
}

std::string elementText(const PlyElement& element, std::size_t count, bool isOrderly)
{
    std::string text = fmt::format("element {} {}\n", element.name, count);
    for (const PlyProperty& property : element.properties)
        if (isNeeded(element, property))
            text += propertyLine(property, isOrderly);
    return text;
}

} // namespace

std::string plainPlyHeader(const PlyHeader& header)
{
    using Format = PlyHeader::Format;
    const char* const name = header.format == Format::text           ? "ascii"
                             : header.format == Format::littleEndian ? "binary_little_endian"
                                                                     : "binary_big_endian";
    std::string text = fmt::format("ply\nformat {} 1.0\n", name);
    for (const PlyElement& element : header.elements)
        if (element.name == "vertex" || element.name == "face")
            text += elementText(element, element.count, false);
    return text + "end_header\n";
}

std::string orderlyPlyHeader(const PlyHeader& header, std::size_t faces)
{
    std::string text = "ply\nformat binary_little_endian 1.0\n";
    for (const PlyElement& element : header.elements)
        if (element.name == "vertex")
            text += elementText(element, element.count, true);
    return text + fmt::format("element face {}\nproperty list int int vertex_indices\nend_header\n",
                              faces);
}

} // namespace sward::terrain
