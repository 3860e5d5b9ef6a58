#include "core/error.h"
#include "core/files/mapped_file.h"
#include "field/organs.h"
#include "shaders/shared/organ.h"
#include "trace/blade_poses.h"

#include <glm/geometric.hpp>

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace sward::trace {
namespace {

constexpr std::string_view header =
    "id,x,y,z,v1x,v1y,v1z,v2x,v2y,v2z,ux,uy,uz,eta,lod_width,cull_result";
constexpr std::size_t largestFile = std::size_t(64) << 30; // [bytes]

// A row as far as poses need it.
struct Row {
    std::uint64_t id = 0;
    std::array<double, 9> places{}; // [m] world: root, v1, v2
};

// The lines of a file, without their ends.
class Lines {
public:
    explicit Lines(std::string_view text)
        : rest_(text)
    {
    }

    std::size_t number() const { return number_; } // of the last line, from 1

    std::optional<std::string_view> next()
    {
        if (rest_.empty())
            return std::nullopt;
        const std::size_t end = rest_.find('\n');
        std::string_view line = rest_.substr(0, end);
        rest_ = end == std::string_view::npos ? std::string_view() : rest_.substr(end + 1);
        if (line.ends_with('\r'))
            line.remove_suffix(1);
        ++number_;
        return line;
    }

private:
    std::string_view rest_;
    std::size_t number_ = 0;
};

template <typename Number>
bool readNumber(std::string_view& line, Number& number)
{
    const char* const end = line.data() + line.size();
    const auto [stop, error] = std::from_chars(line.data(), end, number);
    if (error != std::errc() || stop == end || *stop != ',')
        return false;
    line.remove_prefix(static_cast<std::size_t>(stop - line.data()) + 1);
    return true;
}

std::optional<Row> rowOf(std::string_view line)
{
    Row row;
    if (!readNumber(line, row.id))
        return std::nullopt;
    for (double& place : row.places)
        if (!readNumber(line, place) || !std::isfinite(place))
            return std::nullopt;
    return row;
}

glm::vec3 pointOf(const Row& row, std::size_t first, const glm::dvec3& origin)
{
    return glm::vec3(glm::dvec3(row.places[first], row.places[first + 1], row.places[first + 2]) -
                     origin);
}

} // namespace

std::vector<BladePose> readPoses(const field::FieldView& field, const std::filesystem::path& path)
{
    const std::string name = path.string();
    const std::vector<std::byte> bytes = readFile(path, largestFile);
    Lines lines({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    if (lines.next().value_or("") != header)
        fail(ErrorKind::input,
             "{}: line 1: is not \"{}\", as 'sward-view render --dump-blades' writes", name,
             header);

    const std::vector<shared::Organ> organs = field::organTable(field.species);
    std::vector<BladePose> poses(field.blades.size());
    for (const shared::Patch& cell : field.patches) {
        // A ribbon stands behind its stalk and has the stalk's data, but its own row does not say
        // how its stalk stands.
        shared::PosedBlade stalk = {};
        bool hasStalk = false;
        for (std::uint32_t i = 0; i < cell.bladeCount; ++i) {
            const std::size_t index = std::size_t(cell.firstBlade) + i;
            const std::optional<std::string_view> line = lines.next();
            if (!line)
                fail(ErrorKind::input, "{}: has {} blades; the field has {}", name,
                     lines.number() - 1, field.blades.size());
            const std::optional<Row> row = rowOf(*line);
            if (!row)
                fail(ErrorKind::input, "{}: line {}: is not a number and nine places of a blade",
                     name, lines.number());
            if (row->id != field.idOf(index))
                fail(ErrorKind::input, "{}: line {}: is blade {}; the field has {} here", name,
                     lines.number(), row->id, field.idOf(index));
            const shared::Blade blade = shared::unpackBlade(field.blades[index], cell);
            const shared::Species& look = field.species[blade.species].look;
            shared::PosedBlade posed = {};
            posed.blade = blade;
            posed.v0 = pointOf(*row, 0, field.origin);
            posed.v1 = pointOf(*row, 3, field.origin);
            posed.v2 = pointOf(*row, 6, field.origin);
            posed.axis = shared::widthAxis(blade.up, blade.facing);
            const std::uint32_t number = shared::ribbonNumber(look, blade);
            if (number == 0) {
                stalk = posed;
                hasStalk = true;
            } else if (hasStalk) {
                shared::PosedBlade plant = stalk;
                plant.blade = blade;
                posed.axis = shared::ribbonOf(field::viewOf(organs), look, plant, number).axis;
            }
            poses[index] = {posed.v0, posed.v1, posed.v2, posed.axis};
        }
    }
    if (lines.next())
        fail(ErrorKind::input, "{}: line {}: the field has only {} blades{}", name, lines.number(),
             field.blades.size(),
             field.seeds == nullptr ? ""
                                    : "; 'sward-view render --sown-memory 0' leaves sown ones out");
    return poses;
}

} // namespace sward::trace
