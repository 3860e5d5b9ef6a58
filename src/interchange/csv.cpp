#include "interchange/csv.h"

#include "core/files/atomic_file.h"
#include "interchange/instances.h"
#include "shaders/shared/blade.h"

#include <fmt/format.h>

#include <iterator>

namespace sward::interchange {
namespace {

constexpr std::string_view csvHeader =
    "id,x,y,z,ux,uy,uz,facing,height,width,stiffness,species,exposure,tint_r,tint_g,tint_b,clump,"
    "patch\n";

// Buffer size of rows, to reduce the number of writes.
constexpr std::size_t csvWriteSize = std::size_t(1) << 20;

void appendRow(fmt::memory_buffer& text, std::uint64_t id, const glm::dvec3& origin,
               const shared::Blade& blade, std::uint32_t patch)
{
    const glm::dvec3 root = origin + glm::dvec3(blade.root);
    fmt::format_to(std::back_inserter(text),
                   "{},{:.9f},{:.9f},{:.9f},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{},"
                   "{:.9g},{:.9g},{:.9g},{:.9g},{},{}\n",
                   id, root.x, root.y, root.z, blade.up.x, blade.up.y, blade.up.z, blade.facing,
                   blade.height, blade.width, blade.stiffness, blade.species, blade.exposure,
                   blade.tint.x, blade.tint.y, blade.tint.z, blade.clump, patch);
}

} // namespace

void writeCsv(const field::FieldView& field, const std::filesystem::path& path,
              const ExportSettings& settings, Progress& progress)
{
    AtomicFile file(path, settings.overwrite);
    file.write(csvHeader);
    progress.begin("export", field.blades.size());
    fmt::memory_buffer text;
    for (std::uint32_t p = 0; p < field.patches.size(); ++p) {
        const shared::Patch& patch = field.patches[p];
        for (std::size_t i = patch.firstBlade; i < patch.firstBlade + patch.bladeCount; ++i)
            if (!field.isRibbon(i))
                appendRow(text, field.idOf(i), field.origin, bladeOf(field, p, i, settings.source),
                          p);
        if (text.size() >= csvWriteSize) {
            file.write(std::string_view(text.data(), text.size()));
            text.clear();
        }
        progress.advance(patch.bladeCount);
    }
    file.write(std::string_view(text.data(), text.size()));
    file.commit();
}

} // namespace sward::interchange
