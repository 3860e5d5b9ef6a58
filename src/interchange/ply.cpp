#include "interchange/ply.h"

#include "core/files/atomic_file.h"
#include "interchange/instances.h"

#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <string>
#include <vector>

namespace sward::interchange {
namespace {

// Line limit: some readers have buffers of a few hundred characters.
constexpr std::size_t longestComment = 200;

// Buffer size of points, to reduce the number of writes.
constexpr std::size_t plyWriteSize = std::size_t(1) << 20;

// Formats a text, possibly of several lines, as "comment …" lines.
std::string commentLines(std::string_view text)
{
    std::string lines;
    std::size_t length = longestComment;
    for (const char c : text) {
        if (c == '\n' || length == longestComment) {
            lines += lines.empty() ? "comment " : "\ncomment ";
            length = 0;
        }
        // Replace non-printable and non-ASCII characters, which readers treat differently.
        if (c != '\n') {
            lines += c >= ' ' && c <= '~' ? c : '?';
            ++length;
        }
    }
    return lines.empty() ? lines : lines + "\n";
}

std::string headerOf(const field::FieldView& field, const ExportSettings& settings)
{
    std::string header = "ply\nformat binary_little_endian 1.0\n";
    header += commentLines(settings.generator);
    header += "comment metres, Y up, world space; colour of the ground at the root, sRGB\n";
    header += commentLines(*field.copyright);
    header += fmt::format("element vertex {}\n", field::rootedBlades(field));
    for (const char* name : {"x", "y", "z"})
        header += fmt::format("property double {}\n", name);
    for (const char* name :
         {"nx", "ny", "nz", "facing", "height", "width", "stiffness", "exposure"})
        header += fmt::format("property float {}\n", name);
    for (const char* name : {"red", "green", "blue", "species", "clump"})
        header += fmt::format("property uchar {}\n", name);
    return header + "property double id\nend_header\n";
}

class Points {
public:
    template <typename T>
    void add(T value)
    {
        const std::size_t at = bytes_.size();
        bytes_.resize(at + sizeof value);
        std::memcpy(bytes_.data() + at, &value, sizeof value);
    }

    void addBlade(const shared::Blade& blade, const glm::dvec3& origin, std::uint64_t id)
    {
        for (glm::length_t axis = 0; axis < 3; ++axis)
            add(origin[axis] + double(blade.root[axis]));
        for (const float value : {blade.up.x, blade.up.y, blade.up.z, blade.facing, blade.height,
                                  blade.width, blade.stiffness, blade.exposure})
            add(value);
        for (glm::length_t channel = 0; channel < 3; ++channel)
            add(static_cast<std::uint8_t>(std::lround(255.0f * blade.tint[channel])));
        add(static_cast<std::uint8_t>(blade.species));
        add(static_cast<std::uint8_t>(blade.clump));
        // A double is exact for ids, which are below 2⁵³.
        add(static_cast<double>(id));
    }

    void writeTo(AtomicFile& file)
    {
        file.write(bytes_);
        bytes_.clear();
    }

    std::size_t size() const { return bytes_.size(); }

private:
    std::vector<std::byte> bytes_;
};

} // namespace

void writePly(const field::FieldView& field, const std::filesystem::path& path,
              const ExportSettings& settings, Progress& progress)
{
    AtomicFile file(path, settings.overwrite);
    file.write(headerOf(field, settings));
    progress.begin("export", field.blades.size());
    Points points;
    for (std::uint32_t p = 0; p < field.patches.size(); ++p) {
        const shared::Patch& patch = field.patches[p];
        for (std::size_t i = patch.firstBlade; i < patch.firstBlade + patch.bladeCount; ++i)
            if (!field.isRibbon(i))
                points.addBlade(bladeOf(field, p, i, settings.source), field.origin, field.idOf(i));
        if (points.size() >= plyWriteSize)
            points.writeTo(file);
        progress.advance(patch.bladeCount);
    }
    points.writeTo(file);
    file.commit();
}

} // namespace sward::interchange
