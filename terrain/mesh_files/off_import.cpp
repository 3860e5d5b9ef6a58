#include "core/error.h"
#include "terrain/mesh_files/mesh_readers.h"
#include "terrain/mesh_files/off_binary.h"
#include "terrain/mesh_files/text_cursor.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>
#include <vector>

namespace sward::terrain {
namespace {

// Lines without comments.
class OffLines {
public:
    OffLines(std::string_view text, const std::string& place)
        : text_(text)
        , cursor_(text)
        , place_(place)
    {
    }

    // The next non-empty line.
    std::string_view next(const char* what)
    {
        while (!cursor_.atEnd()) {
            std::string_view line = cursor_.line();
            line = line.substr(0, line.find('#'));
            if (line.find_first_not_of(" \t\r") != std::string_view::npos)
                return line;
        }
        fail(ErrorKind::input, "{}: truncated: ends before {}", place_, what);
    }

    std::size_t lineNumber() const { return cursor_.lineNumber(); }

    // The text after the last line read.
    std::string_view rest() const { return text_.substr(std::min(cursor_.offset(), text_.size())); }

private:
    std::string_view text_;
    TextCursor cursor_;
    const std::string& place_;
};

bool isKeyword(std::string_view word)
{
    return word.size() >= 3 && word.substr(word.size() - 3) == "OFF";
}

// The next word, behind comments.
std::string_view wordBehindComments(TextCursor& words)
{
    std::string_view word = words.word();
    while (word.starts_with('#')) {
        words.line();
        word = words.word();
    }
    return word;
}

// Three counts: vertices, faces, edges; none if these words are no counts below the bytes of the
// file.
std::optional<std::array<std::size_t, 3>> countsOf(TextCursor& words, std::size_t bytes)
{
    std::array<std::size_t, 3> counts{};
    for (std::size_t& count : counts) {
        const auto number = parseCount(wordBehindComments(words));
        if (!number || *number > bytes)
            return std::nullopt;
        count = *number;
    }
    return counts;
}

// Appends a line of `count` words; false if there are fewer.
bool appendLine(TextCursor& words, std::size_t count, std::string& text)
{
    for (std::size_t i = 0; i < count; ++i) {
        const std::string_view word = wordBehindComments(words);
        if (word.empty())
            return false;
        text.append(word).append(1, ' ');
    }
    text.push_back('\n');
    return true;
}

// Appends a face: the count of its corners, and these; false if it is none.
bool appendFace(TextCursor& words, std::size_t bytes, std::string& text)
{
    const std::string_view word = wordBehindComments(words);
    const auto corners = parseCount(word);
    if (!corners || *corners > bytes)
        return false;
    text.append(word).append(1, ' ');
    return appendLine(words, *corners, text);
}

// A text whose elements share lines, with a line for each; none if it has lines enough and its
// counts are on one, or if the words of `body`, which follows the keyword, are not exactly its
// elements of positions and normals.
std::optional<std::string> withLines(std::string_view keyword, std::string_view body)
{
    if (keyword.find('C') != std::string_view::npos || keyword.starts_with("ST"))
        return std::nullopt;
    const std::size_t numbers = keyword.find('N') != std::string_view::npos ? 6 : 3;
    TextCursor words(body);
    const auto counts = countsOf(words, body.size());
    if (!counts)
        return std::nullopt;
    const auto [vertices, faces, edges] = *counts;
    const std::size_t begin = words.offset();
    if (filledLines(body.substr(0, begin), '#') == 1 &&
        filledLines(body.substr(begin), '#') >= vertices + faces)
        return std::nullopt;
    std::string text = fmt::format("{}\n{} {} {}\n", keyword, vertices, faces, edges);
    for (std::size_t i = 0; i < vertices; ++i)
        if (!appendLine(words, numbers, text))
            return std::nullopt;
    for (std::size_t i = 0; i < faces; ++i)
        if (!appendFace(words, body.size(), text))
            return std::nullopt;
    return wordBehindComments(words).empty() ? std::optional(std::move(text)) : std::nullopt;
}

constexpr float noAlpha = -1.0f; // of a colour of three numbers

// What a vertex has by the keyword of its file: [ST][C][N]OFF.
struct OffVertex {
    explicit OffVertex(const std::string& keyword)
        : hasNormal(keyword.find('N') != std::string::npos)
        , hasColor(keyword.find('C') != std::string::npos)
        , hasUv(keyword.starts_with("ST"))
    {
    }

    bool hasNormal;
    bool hasColor;
    bool hasUv;
};

class OffReader {
public:
    OffReader(std::string_view file, const std::string& place, PolygonSoup& soup)
        : file_(file)
        , place_(place)
        , lines_(file, place)
        , soup_(soup)
    {
    }

    MeshForm run(Diagnostics& diagnostics)
    {
        const std::string_view first = lines_.next("its header");
        TextCursor header(first);
        const std::string keyword(header.word());
        if (!isKeyword(keyword))
            fail(ErrorKind::input, "{}: begins with \"{}\", not with OFF", place_,
                 keyword.substr(0, 16));
        if (keyword.find_first_of("4n") != std::string::npos)
            fail(ErrorKind::unsupported, "{}: {} has more than three dimensions", place_, keyword);
        const std::size_t behind =
            static_cast<std::size_t>(first.data() - file_.data()) + header.offset();
        std::string_view counts = header.word();
        if (counts == "BINARY") {
            const std::string text = offText(keyword, lines_.rest(), place_);
            return OffReader(text, place_, soup_).run(diagnostics);
        }
        if (const auto text = withLines(keyword, file_.substr(behind)))
            return OffReader(*text, place_, soup_).run(diagnostics);

        // The counts follow the keyword, on its line or on the next.
        TextCursor countLine(counts.empty() ? lines_.next("its counts") : std::string_view());
        if (counts.empty())
            counts = countLine.word();
        const std::string_view faceCount = countLine.atEnd() ? header.word() : countLine.word();
        const auto vertices = parseCount(counts);
        const auto faces = parseCount(faceCount);
        // A vertex takes at least six bytes, a face without corners two, line end included.
        if (!vertices || !faces || *vertices > file_.size() / 6 || *faces > file_.size() / 2)
            fail(ErrorKind::input, "{}: says {} vertices and {} faces, which {} bytes cannot hold",
                 place_, counts, faceCount, file_.size());
        for (std::size_t i = 0; i < *vertices; ++i)
            readVertex(i, OffVertex(keyword));
        finishColors();
        for (std::size_t i = 0; i < *faces; ++i)
            readFace(i, *vertices);
        if (const std::size_t over = filledLines(lines_.rest(), '#'); over > 0)
            diagnostics.warn("{}: {} lines are left over behind its {} faces, and not read", place_,
                             over, *faces);
        return {.isText = true, .isSingle = false};
    }

private:
    // `line` and as many further ones as hold `count` words: numbers may continue on the next
    // lines, and what follows them on the last line is a colour.
    std::string_view wordsFrom(std::string_view line, std::size_t count, const char* what)
    {
        const auto counted = [&](std::string_view text, std::size_t found) {
            TextCursor words(text);
            while (found < count && !words.word().empty())
                ++found;
            return found;
        };
        std::size_t found = counted(line, 0);
        if (found == count)
            return line;
        joined_ = line;
        while (found < count) {
            const std::string_view next = lines_.next(what);
            found = counted(next, found);
            joined_.append(1, ' ').append(next);
        }
        return joined_;
    }

    // Two lines of two numbers, where nothing may follow a coordinate, are vertices without z.
    void requireThree(std::string_view line, const OffVertex& form)
    {
        const auto wordsOf = [](std::string_view text) {
            TextCursor words(text);
            std::size_t count = 0;
            while (!words.word().empty())
                ++count;
            return count;
        };
        OffLines ahead = lines_;
        if (form.hasNormal || form.hasColor || form.hasUv || wordsOf(line) != 2 ||
            wordsOf(ahead.next("its last vertex")) != 2)
            return;
        fail(ErrorKind::input, "{}: line {}: the vertex has 2 coordinates: z is missing", place_,
             lines_.lineNumber());
    }

    void readVertex(std::size_t index, const OffVertex& form)
    {
        const std::string_view line = lines_.next("its last vertex");
        if (index == 0)
            requireThree(line, form);
        TextCursor words(wordsFrom(line, 3, "its last vertex"));
        glm::dvec3 position(0.0);
        for (glm::length_t axis = 0; axis < 3; ++axis) {
            const auto number = words.number();
            if (!number)
                fail(ErrorKind::input,
                     "{}: line {}: coordinate {} of vertex {} is not a finite number", place_,
                     lines_.lineNumber(), "xyz"[axis], index);
            position[axis] = *number;
        }
        soup_.addVertex(position);
        glm::vec3 normal(0.0f);
        for (glm::length_t axis = 0; form.hasNormal && axis < 3; ++axis)
            normal[axis] = static_cast<float>(words.number().value_or(0.0));
        if (form.hasNormal)
            soup_.setNormal(index, normal);
        readRest(words, form, index);
    }

    // Reads colour and texture coordinates. Alpha may be missing; what is no number is 0.
    void readRest(TextCursor& words, const OffVertex& form, std::size_t index)
    {
        std::vector<float> numbers;
        for (std::string_view word = words.word(); !word.empty(); word = words.word()) {
            hasShares_ = hasShares_ || (form.hasColor && numbers.size() < 3 &&
                                        word.find_first_of(".eE") != std::string_view::npos);
            numbers.push_back(static_cast<float>(parseNumber(word).value_or(0.0)));
        }
        const std::size_t uvs = form.hasUv && numbers.size() >= 2 ? 2 : 0;
        const std::size_t colors = numbers.size() - uvs;
        if (form.hasUv)
            soup_.setUv(index, uvs == 2 ? glm::vec2(numbers[colors], numbers[colors + 1])
                                        : glm::vec2(0.0f));
        if (!form.hasColor)
            return;
        glm::vec4 color(0.0f);
        for (std::size_t c = 0; c < std::min<std::size_t>(colors, 4); ++c)
            color[int(c)] = numbers[c];
        if (colors < 4)
            color.w = noAlpha;
        colors_.push_back(color);
    }

    // Colours are bytes unless one of them has a point.
    void finishColors()
    {
        for (std::size_t v = 0; v < colors_.size(); ++v) {
            glm::vec4 color = hasShares_ ? colors_[v] : colors_[v] / 255.0f;
            color.w = colors_[v].w == noAlpha ? 1.0f : color.w;
            soup_.setColor(v, color);
        }
        colors_ = {};
    }

    // What follows the corners, a colour say, is not read.
    void readFace(std::size_t index, std::size_t vertices)
    {
        std::string_view line = lines_.next("its last face");
        const auto corners = parseCount(TextCursor(line).word());
        bool whole = corners.has_value() && *corners <= file_.size();
        if (whole)
            line = wordsFrom(line, *corners + 1, "its last face");
        TextCursor words(line);
        words.word();
        corners_.clear();
        for (std::size_t c = 0; whole && c < *corners; ++c) {
            const auto corner = parseCount(words.word());
            whole = corner.has_value() && *corner < vertices;
            if (whole)
                corners_.push_back(static_cast<std::uint32_t>(*corner));
        }
        if (!whole)
            fail(ErrorKind::input, "{}: line {}: face {} does not name its corners below {}",
                 place_, lines_.lineNumber(), index, vertices);
        soup_.addFace(corners_);
    }

    std::string_view file_;
    const std::string& place_;
    OffLines lines_;
    PolygonSoup& soup_;
    bool hasShares_ = false; // some colour has a point: it is no byte
    std::vector<glm::vec4> colors_;
    std::string joined_;                 // of several lines
    std::vector<std::uint32_t> corners_; // of a face
};

} // namespace

MeshForm readOff(std::string_view file, const std::string& place, PolygonSoup& soup,
                 Diagnostics& diagnostics)
{
    return OffReader(file, place, soup).run(diagnostics);
}

} // namespace sward::terrain
