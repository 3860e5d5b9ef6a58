#include "terrain/mesh_files/off_binary.h"

#include "core/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <optional>

namespace sward::terrain {
namespace {

struct Layout {
    bool isBigEndian;
    bool hasFaceColors; // each face: a component count, then colours
};
constexpr Layout layouts[] = {{true, true}, {false, true}, {true, false}, {false, false}};

class Reader {
public:
    Reader(std::string_view body, bool isBigEndian)
        : body_(body)
        , isBigEndian_(isBigEndian)
    {
    }

    std::size_t wordsLeft() const { return (body_.size() - at_) / 4; }
    bool isAtEnd() const { return at_ == body_.size(); }

    template <typename Value>
    bool read(Value& value)
    {
        static_assert(sizeof value == 4);
        if (wordsLeft() == 0)
            return false;
        char bytes[4];
        std::memcpy(bytes, body_.data() + at_, 4);
        if (isBigEndian_)
            std::reverse(bytes, bytes + 4);
        std::memcpy(&value, bytes, 4);
        at_ += 4;
        return true;
    }

    bool skip(std::size_t words)
    {
        if (words > wordsLeft())
            return false;
        at_ += 4 * words;
        return true;
    }

private:
    std::string_view body_;
    bool isBigEndian_;
    std::size_t at_ = 0;
};

// Count of numbers per vertex: position, normal, colour, texture coordinates.
std::size_t numbersOf(std::string_view keyword)
{
    return 3U + (keyword.find('N') != std::string_view::npos ? 3U : 0U) +
           (keyword.find('C') != std::string_view::npos ? 4U : 0U) +
           (keyword.find("ST") != std::string_view::npos ? 2U : 0U);
}

// Appends a vertex of so many numbers as a line; false if there are fewer.
bool appendVertex(Reader& reader, std::size_t numbers, std::string& text)
{
    for (std::size_t n = 0; n < numbers; ++n) {
        float number = 0.0f;
        if (!reader.read(number))
            return false;
        // With a point: no colour is a byte.
        fmt::format_to(std::back_inserter(text), "{:#} ", number);
    }
    text.push_back('\n');
    return true;
}

// Appends a face as a line, without its colour; false if it is none.
bool appendFace(Reader& reader, std::uint32_t vertices, bool hasColor, std::string& text)
{
    const auto end = std::back_inserter(text);
    std::uint32_t corners = 0;
    if (!reader.read(corners) || corners == 0 || corners > reader.wordsLeft())
        return false;
    fmt::format_to(end, "{}", corners);
    for (std::uint32_t c = 0; c < corners; ++c) {
        std::uint32_t vertex = 0;
        reader.read(vertex);
        if (vertex >= vertices)
            return false;
        fmt::format_to(end, " {}", vertex);
    }
    text.push_back('\n');
    std::uint32_t components = 0;
    return !hasColor || (reader.read(components) && components <= 4 && reader.skip(components));
}

// The text, if this layout consumes the body exactly.
std::optional<std::string> textOf(std::string_view keyword, std::string_view body,
                                  const Layout& layout)
{
    Reader reader(body, layout.isBigEndian);
    std::uint32_t vertices = 0;
    std::uint32_t faces = 0;
    std::uint32_t edges = 0;
    const std::size_t numbers = numbersOf(keyword);
    if (!reader.read(vertices) || !reader.read(faces) || !reader.read(edges) ||
        vertices > reader.wordsLeft() / numbers || faces > reader.wordsLeft() - vertices * numbers)
        return std::nullopt;

    std::string text = fmt::format("{}\n{} {} 0\n", keyword, vertices, faces);
    for (std::uint32_t i = 0; i < vertices; ++i)
        if (!appendVertex(reader, numbers, text))
            return std::nullopt;
    for (std::uint32_t i = 0; i < faces; ++i)
        if (!appendFace(reader, vertices, layout.hasFaceColors, text))
            return std::nullopt;
    return reader.isAtEnd() ? std::optional(std::move(text)) : std::nullopt;
}

} // namespace

std::string offText(std::string_view keyword, std::string_view body, const std::string& place)
{
    for (const Layout& layout : layouts)
        if (auto text = textOf(keyword, body, layout))
            return std::move(*text);
    fail(ErrorKind::input, "{}: truncated or damaged: its {} bytes are no binary OFF", place,
         body.size());
}

} // namespace sward::terrain
