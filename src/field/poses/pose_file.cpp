#include "core/error.h"
#include "core/files/mapped_file.h"
#include "field/poses/blade_poses.h"

#include <glm/geometric.hpp>

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace sward::field {
namespace {

constexpr std::string_view poseHeader =
    "id,x,y,z,v1x,v1y,v1z,v2x,v2y,v2z,ux,uy,uz,eta,lod_width,cull_result";
constexpr std::size_t largestPoseFile = std::size_t(64) << 30; // [bytes]

// A row as far as poses need it.
struct PoseRow {
    std::uint64_t id = 0;
    std::array<double, 9> places{}; // [m] world: root, v1, v2
};

// The lines of a file, without their ends.
class PoseLines {
public:
    explicit PoseLines(std::string_view text)
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
bool readPoseNumber(std::string_view& line, Number& number)
{
    const char* const end = line.data() + line.size();
    const auto [stop, error] = std::from_chars(line.data(), end, number);
    if (error != std::errc() || stop == end || *stop != ',')
        return false;
    line.remove_prefix(static_cast<std::size_t>(stop - line.data()) + 1);
    return true;
}

std::optional<PoseRow> poseRowOf(std::string_view line)
{
    PoseRow row;
    if (!readPoseNumber(line, row.id))
        return std::nullopt;
    for (double& place : row.places)
        if (!readPoseNumber(line, place) || !std::isfinite(place))
            return std::nullopt;
    return row;
}

glm::vec3 posePoint(const PoseRow& row, std::size_t first, const glm::dvec3& origin)
{
    return glm::vec3(glm::dvec3(row.places[first], row.places[first + 1], row.places[first + 2]) -
                     origin);
}

} // namespace

std::vector<BladePose> readPoses(const FieldView& field, const std::filesystem::path& path)
{
    const std::string name = path.string();
    const std::vector<std::byte> bytes = readFile(path, largestPoseFile);
    PoseLines lines({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    if (lines.next().value_or("") != poseHeader)
        fail(ErrorKind::input,
             "{}: line 1: is not \"{}\", as 'sward-view render --dump-blades' writes", name,
             poseHeader);

    std::vector<BladePose> poses(field.blades.size());
    for (const shared::Patch& cell : field.patches) {
        for (std::uint32_t i = 0; i < cell.bladeCount; ++i) {
            const std::size_t index = std::size_t(cell.firstBlade) + i;
            const std::optional<std::string_view> line = lines.next();
            if (!line)
                fail(ErrorKind::input, "{}: has {} blades; the field has {}", name,
                     lines.number() - 1, field.blades.size());
            const std::optional<PoseRow> row = poseRowOf(*line);
            if (!row)
                fail(ErrorKind::input, "{}: line {}: is not a number and nine places of a blade",
                     name, lines.number());
            if (row->id != field.idOf(index))
                fail(ErrorKind::input, "{}: line {}: is blade {}; the field has {} here", name,
                     lines.number(), row->id, field.idOf(index));
            poses[index].v0 = posePoint(*row, 0, field.origin);
            poses[index].v1 = posePoint(*row, 3, field.origin);
            poses[index].v2 = posePoint(*row, 6, field.origin);
        }
    }
    if (lines.next())
        fail(ErrorKind::input, "{}: line {}: the field has only {} blades{}", name, lines.number(),
             field.blades.size(),
             field.seeds == nullptr ? ""
                                    : "; 'sward-view render --sown-memory 0' leaves sown ones out");
    setAxes(field, poses);
    return poses;
}

} // namespace sward::field
