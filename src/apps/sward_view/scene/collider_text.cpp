#include "apps/sward_view/scene/collider_text.h"

#include "apps/common/parse_text.h"
#include "core/error.h"

#include <vector>

namespace sward::view {
namespace {

constexpr double farthest = 1e12; ///< [m] far beyond the Moon

} // namespace

render::Collider parseCollider(std::string_view text)
{
    const std::size_t colon = text.find(':');
    const std::string_view kind = text.substr(0, colon);
    const std::size_t count = kind == "sphere" ? 4 : kind == "capsule" ? 7 : 0;
    std::vector<std::string_view> parts;
    if (count > 0 && colon != std::string_view::npos)
        parts = apps::splitText(text.substr(colon + 1), ',');
    if (parts.size() != count || count == 0)
        fail(ErrorKind::usage, "--collider: '{}' is not sphere:x,y,z,r or capsule:x,y,z,x,y,z,r",
             text);

    std::vector<double> numbers;
    for (std::size_t i = 0; i < count; ++i)
        numbers.push_back(
            apps::parseNumber("--collider", parts[i], i + 1 < count ? -farthest : 1e-6, farthest));
    render::Collider collider;
    collider.from = {numbers[0], numbers[1], numbers[2]};
    collider.to = count == 7 ? glm::dvec3(numbers[3], numbers[4], numbers[5]) : collider.from;
    collider.radius = numbers.back();
    return collider;
}

} // namespace sward::view
