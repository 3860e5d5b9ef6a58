#include "interchange/page.h"

#include "core/embedded.h"
#include "core/error.h"
#include "core/files/atomic_file.h"
#include "field/measure/leaf_area.h"
#include "field/organs.h"

#include <xxhash.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

namespace sward::embedded {
std::span<const EmbeddedFile> page();
} // namespace sward::embedded

namespace sward::interchange {
namespace {

constexpr std::string_view titlePlace = "{{title}}";
constexpr std::string_view posterPlace = "{{poster}}";
constexpr std::string_view pageName = "index.html";
constexpr std::string_view sowerName = "sow.wasm";

std::string inHtml(std::string_view text)
{
    std::string html;
    for (const char c : text) {
        switch (c) {
        case '&':
            html += "&amp;";
            break;
        case '<':
            html += "&lt;";
            break;
        case '>':
            html += "&gt;";
            break;
        case '"':
            html += "&quot;";
            break;
        default:
            html += c;
        }
    }
    return html;
}

std::string replaced(std::string text, std::string_view place, std::string_view by)
{
    for (std::size_t at = text.find(place); at != std::string::npos;
         at = text.find(place, at + by.size()))
        text.replace(at, place.size(), by);
    return text;
}

/// The page with its title, which may hold any characters, and its picture.
std::string filledIn(std::string_view page, std::string_view title, bool hasPoster)
{
    const std::string name = inHtml(title);
    const std::string poster = hasPoster ? "<img class=\"sward-poster\" src=\"poster.jpg\" alt=\"A "
                                           "picture of the field " +
                                               name + "\">"
                                         : std::string();
    const std::size_t at = page.find(posterPlace);
    return replaced(std::string(page.substr(0, at)), titlePlace, name) + poster +
           replaced(std::string(page.substr(at + posterPlace.size())), titlePlace, name);
}

/// What precedes shared::Cover and its corners in field.cover; little-endian.
struct CoverHead {
    std::array<char, 8> magic = {'S', 'W', 'C', 'O', 'V', 'E', 'R', '1'};
    std::uint64_t hash = 0;       ///< XXH3-64 of all bytes that follow it
    std::uint64_t bladesHash = 0; ///< XXH3-64 of the packed blades: that of the chunk BLADES
    float areaFactor = 1.0F;      ///< field::areaFactor()
    std::uint32_t reserved = 0;
};
static_assert(sizeof(CoverHead) == 32);

std::string_view bytesOf(const auto& values)
{
    return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(*values.data())};
}

/// The cover of a field as the page's script reads it. A page draws before all blades are there,
/// so it cannot measure them itself. Hashes tell a damaged cover, and one of another field.
std::string coverBytes(const field::FieldView& field)
{
    field::LeafAreaGrid grid = field::leafAreaOf(field);
    field::describeUndergrowth(field, grid.shape);
    grid.shape.grass.address = 0;
    CoverHead head;
    head.areaFactor = field::areaFactor(field);
    const std::string_view blades = bytesOf(field.blades);
    head.bladesHash = XXH3_64bits(blades.data(), blades.size());
    std::string bytes;
    const auto append = [&](const auto& value) { bytes += bytesOf(std::span(&value, 1)); };
    append(head);
    append(grid.shape);
    bytes += bytesOf(grid.values);
    constexpr std::size_t hashed = offsetof(CoverHead, bladesHash);
    head.hash = XXH3_64bits(bytes.data() + hashed, bytes.size() - hashed);
    bytes.replace(0, hashed, bytesOf(std::span(&head, 1)).substr(0, hashed));
    return bytes;
}

} // namespace

std::uint64_t writePage(const field::FieldView& field, const std::filesystem::path& folder,
                        const ExportSettings& settings, Progress& progress)
{
    std::error_code error;
    std::filesystem::create_directory(folder, error);
    if (error)
        fail(ErrorKind::io, "{}: the folder cannot be made: {}", folder.string(), error.message());
    progress.begin("export", embedded::page().size() + 2);
    std::uint64_t bytes = 0;
    const auto put = [&](std::string_view name, std::string_view text) {
        writeTextFile(folder / name, text, settings.overwrite);
        bytes += text.size();
        progress.advance(1);
    };
    put("field.cover", coverBytes(field));
    if (!settings.poster.empty())
        put("poster.jpg", settings.poster);
    // The page itself comes last: it is there when all is.
    const std::string title = std::filesystem::path(settings.source).stem().string();
    for (const EmbeddedFile& file : embedded::page())
        if (file.name != pageName && (file.name != sowerName || field.seeds != nullptr))
            put(file.name, file.text());
    for (const EmbeddedFile& file : embedded::page())
        if (file.name == pageName)
            put(file.name, filledIn(file.text(), title, !settings.poster.empty()));
    return bytes;
}

} // namespace sward::interchange
