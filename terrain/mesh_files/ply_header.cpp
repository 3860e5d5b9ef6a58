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

void requireNewName(const PlyElement& element, const PlyProperty& property, std::size_t line,
                    const std::string& place)
{
    for (const PlyProperty& other : element.properties)
        if (other.name == property.name)
            fail(ErrorKind::input, "{}: line {}: element {} has a second property {}", place, line,
                 element.name, property.name);
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

const PlyElement* elementNamed(const PlyHeader& header, std::string_view name)
{
    for (const PlyElement& element : header.elements)
        if (element.name == name)
            return &element;
    return nullptr;
}

void requireCorners(const PlyElement& element, const std::string& place)
{
    for (const PlyProperty& property : element.properties)
        if (property.isCorners())
            return;
    for (const PlyProperty& property : element.properties)
        if (property.name == "vertex_indices" || property.name == "vertex_index")
            fail(ErrorKind::input, "{}: property {} of element {} is no list", place, property.name,
                 element.name);
    fail(ErrorKind::input, "{}: element {} has no list vertex_indices of its corners", place,
         element.name);
}

// What ground cannot do without.
void requireMesh(const PlyHeader& header, const std::string& place)
{
    const PlyElement* const vertices = elementNamed(header, "vertex");
    if (vertices == nullptr)
        fail(ErrorKind::input, "{}: no element vertex", place);
    for (const std::string_view axis : {"x", "y", "z"}) {
        const auto found =
            std::find_if(vertices->properties.begin(), vertices->properties.end(),
                         [&](const PlyProperty& property) { return property.name == axis; });
        if (found == vertices->properties.end())
            fail(ErrorKind::input, "{}: property {} of its vertices is missing", place, axis);
        if (found->length)
            fail(ErrorKind::input, "{}: property {} of its vertices is a list, not a number", place,
                 axis);
    }
    const PlyElement* const faces = elementNamed(header, "face");
    const PlyElement* const strips = elementNamed(header, "tristrips");
    const std::size_t count =
        (faces == nullptr ? 0 : faces->count) + (strips == nullptr ? 0 : strips->count);
    if (faces == nullptr && strips == nullptr)
        fail(ErrorKind::input, "{}: no element face: points alone are no ground", place);
    if (count == 0)
        fail(ErrorKind::input, "{}: no faces: its element {} has 0 entries", place,
             faces == nullptr ? "tristrips" : "face");
    for (const PlyElement* const element : {faces, strips})
        if (element != nullptr && element->count > 0)
            requireCorners(*element, place);
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
            PlyElement& element = header.elements.back();
            PlyProperty property = readProperty(words, cursor.lineNumber(), place);
            requireNewName(element, property, cursor.lineNumber(), place);
            element.properties.push_back(std::move(property));
            if (element.properties.size() > maxProperties)
                fail(ErrorKind::input, "{}: line {}: more than {} properties", place,
                     cursor.lineNumber(), maxProperties);
        }
    }
    if (!hasFormat)
        fail(ErrorKind::input, "{}: its header names no format", place);
    requireMesh(header, place);
    // Where CR alone ends the lines, a line feed behind the last one is the first byte of the body.
    std::size_t end = std::min(cursor.offset(), file.size());
    const bool endsByCr = file.size() > 4 && file[3] == '\r' && file[4] != '\n';
    if (endsByCr && end >= 2 && file[end - 1] == '\n' && file[end - 2] == '\r')
        --end;
    header.rest = file.substr(end);
    return header;
}

} // namespace sward::terrain
