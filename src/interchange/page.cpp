#include "interchange/page.h"

#include "core/embedded.h"
#include "core/error.h"
#include "core/files/atomic_file.h"
#include "field/measure/leaf_area.h"
#include "field/organs.h"

#include <bit>
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

/// The cover of a field as the page's script reads it: shared::Cover with field::areaFactor() as a
/// float and four zeros in place of its table, and the corners. A page draws before all blades are
/// there, so it cannot measure them itself.
std::string coverBytes(const field::FieldView& field)
{
    field::LeafAreaGrid grid = field::leafAreaOf(field);
    field::describeUndergrowth(field, grid.shape);
    grid.shape.grass.address = std::bit_cast<std::uint32_t>(field::areaFactor(field));
    std::string bytes(reinterpret_cast<const char*>(&grid.shape), sizeof grid.shape);
    bytes.append(reinterpret_cast<const char*>(grid.values.data()),
                 grid.values.size() * sizeof(std::uint32_t));
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
