#include "core/error.h"
#include "terrain/mesh_files/mesh_scan.h"
#include "terrain/mesh_files/off_binary.h"
#include "terrain/mesh_files/text_cursor.h"

#include <algorithm>

namespace sward::terrain {
namespace {

// Lines without comments; OpenMesh's reader would parse a comment as data.
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

// Reads colour and texture coordinates. Alpha may be missing; what is no number is 0.
void readOffRest(TextCursor& words, const OffVertex& form, MeshScan& scan, bool& hasShares)
{
    std::vector<float> numbers;
    for (std::string_view word = words.word(); !word.empty(); word = words.word()) {
        hasShares = hasShares || (form.hasColor && numbers.size() < 3 &&
                                  word.find_first_of(".eE") != std::string_view::npos);
        numbers.push_back(static_cast<float>(parseNumber(word).value_or(0.0)));
    }
    const std::size_t uvs = form.hasUv && numbers.size() >= 2 ? 2 : 0;
    const std::size_t colors = numbers.size() - uvs;
    if (form.hasUv)
        scan.uvs.emplace_back(uvs == 2 ? glm::vec2(numbers[colors], numbers[colors + 1])
                                       : glm::vec2(0.0f));
    if (!form.hasColor)
        return;
    glm::vec4 color(0.0f);
    for (std::size_t c = 0; c < std::min<std::size_t>(colors, 4); ++c)
        color[int(c)] = numbers[c];
    if (colors < 4)
        color.w = noAlpha;
    scan.colors.push_back(color);
}

} // namespace

MeshScan scanOff(std::string_view file, const std::string& place)
{
    OffLines lines(file, place);
    TextCursor header(lines.next("its header"));
    const std::string keyword(header.word());
    if (!isKeyword(keyword))
        fail(ErrorKind::input, "{}: begins with \"{}\", not with OFF", place,
             keyword.substr(0, 16));
    if (keyword.find_first_of("4n") != std::string::npos)
        fail(ErrorKind::unsupported, "{}: {} has more than three dimensions", place, keyword);
    std::string_view counts = header.word();
    if (counts == "BINARY")
        return scanOff(offText(keyword, lines.rest(), place), place);

    // The counts follow the keyword, on its line or on the next.
    TextCursor countLine(counts.empty() ? lines.next("its counts") : std::string_view());
    if (counts.empty())
        counts = countLine.word();
    const std::string_view faceCount = countLine.atEnd() ? header.word() : countLine.word();
    const auto vertices = parseCount(counts);
    const auto faces = parseCount(faceCount);
    // A vertex or face takes at least six bytes, line end included.
    if (!vertices || !faces || *vertices > file.size() / 6 || *faces > file.size() / 6)
        fail(ErrorKind::input, "{}: says {} vertices and {} faces, which {} bytes cannot hold",
             place, counts, faceCount, file.size());

    // After the coordinates come normals, colours and texture coordinates. The reader is given
    // normals alone.
    const OffVertex form(keyword);
    bool hasShares = false; // some colour has a point: it is no byte
    MeshScan scan;
    scan.vertices = *vertices;
    scan.faces = *faces;
    scan.cleaned = std::string(form.hasNormal ? "NOFF" : "OFF") + "\n" + std::to_string(*vertices) +
                   " " + std::to_string(*faces) + " 0\n";
    const auto keep = [&](std::string_view line) {
        scan.cleaned.append(line);
        scan.cleaned.push_back('\n');
    };
    // Numbers may continue on the next lines; what follows them on the last line is a colour.
    std::string joined;
    const auto wordsFrom = [&](std::string_view line, std::size_t count, const char* what) {
        const auto counted = [&](std::string_view text, std::size_t found) {
            TextCursor words(text);
            while (found < count && !words.word().empty())
                ++found;
            return found;
        };
        std::size_t found = counted(line, 0);
        if (found == count)
            return line;
        joined = line;
        while (found < count) {
            const std::string_view next = lines.next(what);
            found = counted(next, found);
            joined.append(1, ' ').append(next);
        }
        return std::string_view(joined);
    };
    for (std::size_t i = 0; i < *vertices; ++i) {
        const std::string_view line =
            wordsFrom(lines.next("its last vertex"), 3, "its last vertex");
        TextCursor words(line);
        glm::dvec3 position(0.0);
        for (glm::length_t axis = 0; axis < 3; ++axis) {
            const auto number = words.number();
            if (!number)
                fail(ErrorKind::input,
                     "{}: line {}: coordinate {} of vertex {} is not a finite number", place,
                     lines.lineNumber(), "xyz"[axis], i);
            position[axis] = *number;
        }
        scan.positions.push_back(position);
        for (int axis = 0; form.hasNormal && axis < 3; ++axis)
            words.word();
        keep(line.substr(0, std::min(words.offset(), line.size())));
        readOffRest(words, form, scan, hasShares);
    }
    for (glm::vec4& color : scan.colors) {
        const bool isOpaque = color.w == noAlpha;
        color = hasShares ? color : color / 255.0f;
        color.w = isOpaque ? 1.0f : color.w;
    }
    for (std::size_t i = 0; i < *faces; ++i) {
        std::string_view line = lines.next("its last face");
        const auto corners = parseCount(TextCursor(line).word());
        bool whole = corners.has_value() && *corners <= file.size();
        if (whole)
            line = wordsFrom(line, *corners + 1, "its last face");
        TextCursor words(line);
        words.word();
        // Drop what follows the corners (a colour, say): OpenMesh's reader would parse it as the
        // next face. It would read −1 corners as four thousand million.
        std::string face = corners ? std::to_string(*corners) : std::string();
        for (std::size_t c = 0; whole && c < *corners; ++c) {
            const auto index = parseCount(words.word());
            whole = index.has_value() && *index < *vertices;
            if (whole)
                face.append(1, ' ').append(std::to_string(*index));
        }
        if (!whole)
            fail(ErrorKind::input, "{}: line {}: face {} does not name its corners below {}", place,
                 lines.lineNumber(), i, *vertices);
        keep(face);
    }
    return scan;
}

} // namespace sward::terrain
