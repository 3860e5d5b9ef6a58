#include "core/error.h"
#include "terrain/mesh_files/mesh_readers.h"
#include "terrain/mesh_files/text_cursor.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <unordered_map>
#include <vector>

namespace sward::terrain {
namespace {

constexpr std::size_t headerSize = 84; // a text of 80 bytes, then the number of triangles
constexpr std::size_t triangleSize = 50;

// Whether the file begins like text: no byte of its start is a control character.
bool isTextual(std::string_view file)
{
    const std::string_view start = file.substr(0, 512);
    return std::all_of(start.begin(), start.end(), [](char c) {
        const auto byte = static_cast<unsigned char>(c);
        return byte >= 0x20 || (byte >= '\t' && byte <= '\r');
    });
}

// Whether a word is `keyword`, in letters of any case.
bool isWord(std::string_view word, std::string_view keyword)
{
    return std::equal(word.begin(), word.end(), keyword.begin(), keyword.end(), [](char a, char b) {
        return (a >= 'A' && a <= 'Z' ? static_cast<char>(a - 'A' + 'a') : a) == b;
    });
}

// Numbers equal corners as one vertex.
class StlVertices {
public:
    explicit StlVertices(PolygonSoup& soup)
        : soup_(soup)
    {
    }

    std::uint32_t indexOf(const glm::dvec3& position)
    {
        const glm::dvec3 key = position + 0.0; // −0 is 0
        const auto next = static_cast<std::uint32_t>(soup_.vertices());
        const auto [found, isNew] = indices_.try_emplace(key, next);
        if (isNew)
            soup_.addVertex(position);
        return found->second;
    }

private:
    struct Hash {
        std::size_t operator()(const glm::dvec3& v) const
        {
            std::uint64_t hash = 0;
            for (glm::length_t axis = 0; axis < 3; ++axis) {
                hash = (hash ^ std::bit_cast<std::uint64_t>(v[axis])) * 0x9e3779b97f4a7c15ULL;
                hash ^= hash >> 29U;
            }
            return hash;
        }
    };

    PolygonSoup& soup_;
    std::unordered_map<glm::dvec3, std::uint32_t, Hash> indices_;
};

// Reads words; their lines do not matter.
class StlText {
public:
    StlText(std::string_view file, const std::string& place, PolygonSoup& soup)
        : file_(file)
        , place_(place)
        , words_(file)
        , soup_(soup)
        , vertices_(soup)
    {
    }

    void run(Diagnostics& diagnostics)
    {
        bool hasEnded = false;
        bool isName = true; // any words may follow solid and endsolid
        for (std::string_view word = words_.word(); !word.empty(); word = words_.word()) {
            if (isWord(word, "facet") && isFacet(isName)) {
                readFacet();
                hasEnded = isName = false;
            } else if (isWord(word, "endsolid")) {
                hasEnded = isName = true;
            } else if (isWord(word, "solid")) {
                isName = true;
            } else if (!isName) {
                failHere("\"{}\" stands where a facet or endsolid is expected", word.substr(0, 16));
            }
        }
        if (soup_.faces() == 0)
            fail(ErrorKind::input, "{}: no facets: it is neither an STL of text nor a binary one",
                 place_);
        if (!hasEnded)
            diagnostics.warn("{}: no endsolid after its {} facets; it may be truncated", place_,
                             soup_.faces());
    }

private:
    template <typename... Args>
    [[noreturn]] void failHere(fmt::format_string<Args...> format, Args&&... args) const
    {
        fail(ErrorKind::input, "{}: line {}: {}", place_, lineAt(file_, words_.offset()),
             fmt::format(format, std::forward<Args>(args)...));
    }

    // Whether the words ahead belong to a facet and not to a name, where one may stand.
    bool isFacet(bool isName) const
    {
        TextCursor ahead = words_;
        const std::string_view word = ahead.word();
        return isWord(word, "normal") || isWord(word, "outer") || isWord(word, "vertex") ||
               (word.empty() && !isName);
    }

    void readFacet()
    {
        corners_.clear();
        while (true) {
            const std::string_view word = words_.word();
            if (word.empty())
                fail(ErrorKind::input, "{}: truncated inside facet {}", place_, soup_.faces());
            if (isWord(word, "endfacet") || isWord(word, "endsolid"))
                break;
            if (isWord(word, "facet"))
                failHere("facet {} has no endfacet", soup_.faces());
            if (isWord(word, "vertex"))
                readCorner();
        }
        if (corners_.size() < 3)
            failHere("facet {} has {} corners, not three", soup_.faces(), corners_.size());
        soup_.addFace(corners_);
    }

    void readCorner()
    {
        glm::dvec3 position(0.0);
        for (glm::length_t axis = 0; axis < 3; ++axis) {
            const std::string_view word = words_.word();
            const auto number = parseNumber(word);
            if (word.empty())
                fail(ErrorKind::input, "{}: truncated inside facet {}", place_, soup_.faces());
            if (!number && (isWord(word, "vertex") || isWord(word, "endloop")))
                failHere("coordinate {} of a vertex is missing", "xyz"[axis]);
            if (!number)
                failHere("coordinate {} is not a finite number", "xyz"[axis]);
            position[axis] = *number;
        }
        corners_.push_back(vertices_.indexOf(position));
    }

    std::string_view file_;
    const std::string& place_;
    TextCursor words_;
    PolygonSoup& soup_;
    StlVertices vertices_;
    std::vector<std::uint32_t> corners_; // of a facet
};

void readBinary(std::string_view file, std::size_t triangles, const std::string& place,
                PolygonSoup& soup)
{
    constexpr std::size_t cornersAt = 12; // after the normal
    StlVertices vertices(soup);
    for (std::size_t i = 0; i < triangles; ++i) {
        float numbers[9];
        std::memcpy(numbers, file.data() + headerSize + triangleSize * i + cornersAt,
                    sizeof numbers);
        for (std::size_t n = 0; n < 9; ++n)
            if (!std::isfinite(numbers[n]))
                fail(ErrorKind::input,
                     "{}: coordinate {} of corner {} of triangle {} is not a finite number", place,
                     "xyz"[n % 3], n / 3, i);
        std::uint32_t corners[3];
        for (std::size_t c = 0; c < 3; ++c)
            corners[c] = vertices.indexOf({numbers[3 * c], numbers[3 * c + 1], numbers[3 * c + 2]});
        soup.addFace(corners);
    }
}

} // namespace

MeshForm readStl(std::string_view file, const std::string& place, PolygonSoup& soup,
                 Diagnostics& diagnostics)
{
    std::uint32_t triangles = 0;
    if (file.size() >= headerSize)
        std::memcpy(&triangles, file.data() + headerSize - 4, sizeof triangles);
    const std::size_t size = headerSize + triangleSize * std::size_t(triangles);

    // A binary file may also begin with "solid"; its size distinguishes it.
    if (file.size() < headerSize || (file.size() != size && isTextual(file))) {
        StlText(file, place, soup).run(diagnostics);
        return {.isText = true, .isSingle = false};
    }
    if (file.size() < size)
        fail(ErrorKind::input, "{}: truncated: {} triangles need {} bytes, the file has {}", place,
             triangles, size, file.size());
    readBinary(file, triangles, place, soup);
    if (file.size() > size)
        diagnostics.warn("{}: {} bytes are left over behind its {} triangles, and not read", place,
                         file.size() - size, triangles);
    return {.isText = false, .isSingle = true};
}

} // namespace sward::terrain
