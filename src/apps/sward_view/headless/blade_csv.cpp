#include "apps/sward_view/headless/blade_csv.h"

#include "core/expect.h"
#include "core/files/atomic_file.h"
#include "shaders/shared/culling.h"

#include <fmt/format.h>

#include <array>
#include <iterator>
#include <string_view>

namespace sward::view {
namespace {

constexpr std::string_view header =
    "id,x,y,z,v1x,v1y,v1z,v2x,v2y,v2z,ux,uy,uz,eta,lod_width,cull_result\n";
constexpr std::size_t portion = 1u << 20; ///< [bytes] buffered before a write

std::string_view cullResultWord(std::uint32_t cullResult)
{
    constexpr std::array<std::string_view, shared::cullResultCount> words = [] {
        std::array<std::string_view, shared::cullResultCount> table{};
        table[shared::cullResultDrawn] = "drawn";
        table[shared::cullResultPatch] = "patch";
        table[shared::cullResultOrientation] = "orientation";
        table[shared::cullResultFrustum] = "frustum";
        table[shared::cullResultDistance] = "distance";
        table[shared::cullResultOcclusion] = "occlusion";
        table[shared::cullResultLod] = "lod";
        return table;
    }();
    expect(cullResult < words.size(),
           "a blade's cull result is one of cullResultDrawn … cullResultLod");
    return words[cullResult];
}

void appendPlace(fmt::memory_buffer& text, const glm::dvec3& place)
{
    fmt::format_to(std::back_inserter(text), "{:.9f},{:.9f},{:.9f},", place.x, place.y, place.z);
}

} // namespace

void writeBladeCsv(std::span<const render::FieldRenderer::BladeRecord> blades,
                   const std::filesystem::path& path, bool overwrite)
{
    AtomicFile file(path, overwrite);
    file.write(header);
    fmt::memory_buffer text;
    for (const render::FieldRenderer::BladeRecord& blade : blades) {
        fmt::format_to(std::back_inserter(text), "{},", blade.id);
        appendPlace(text, blade.root);
        appendPlace(text, blade.v1);
        appendPlace(text, blade.v2);
        fmt::format_to(std::back_inserter(text), "{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{}\n",
                       blade.up.x, blade.up.y, blade.up.z, blade.eta, blade.lodWidth,
                       cullResultWord(blade.cullResult));
        if (text.size() >= portion) {
            file.write(std::string_view(text.data(), text.size()));
            text.clear();
        }
    }
    file.write(std::string_view(text.data(), text.size()));
    file.commit();
}

} // namespace sward::view
