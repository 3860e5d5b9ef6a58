#include "apps/sward_view/interface/meadow_sketch.h"

#include "core/random.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>

namespace sward::view {
namespace {

constexpr float sunlit = 2.2f;        ///< radiance of a white sheet in the sketch
constexpr float highest = 1.2f;       ///< [m] height of a blade that fills the sketch
constexpr float bladesAcross = 0.45f; ///< blades per pixel of width
constexpr std::uint64_t dice = 41;    ///< of the places of blades
constexpr int pieces = 4;             ///< of a blade
constexpr float baseWidth = 2.6f;     ///< [pixels]

void drawBlade(ImDrawList& list, const Style& style, const MeadowSpecies& species,
               const ImVec2& root, float height, float lean)
{
    ImVec2 before = root;
    float widthBefore = style.scaled(baseWidth);
    for (int i = 1; i <= pieces; ++i) {
        const float t = static_cast<float>(i) / pieces;
        const ImVec2 here{root.x + lean * height * t * t, root.y - height * t};
        const float width = style.scaled(baseWidth) * (1.0f - t);
        const ImU32 color =
            packedLinear(sunlit * glm::mix(species.root, species.tip, t - 0.5f / pieces));
        list.AddQuadFilled({before.x - 0.5f * widthBefore, before.y},
                           {before.x + 0.5f * widthBefore, before.y},
                           {here.x + 0.5f * width, here.y}, {here.x - 0.5f * width, here.y}, color);
        before = here;
        widthBefore = width;
    }
    if (species.flower)
        list.AddCircleFilled(before, style.scaled(2.2f), packedLinear(sunlit * *species.flower), 8);
}

} // namespace

void drawMeadowSketch(ImDrawList& list, const Style& style, const ImVec2& low, const ImVec2& high,
                      std::span<const MeadowSpecies> species)
{
    list.AddRectFilled(low, high, style.packed(palette::raised), style.scaled(3.0f));
    list.PushClipRect(low, high, true);
    float shares = 0.0f;
    for (const MeadowSpecies& one : species)
        shares += one.share;
    const float blades = bladesAcross * (high.x - low.x) / style.scaled(1.0f);
    std::uint64_t number = 0;
    for (const MeadowSpecies& one : species) {
        // Of what is rare at least one; of flowers more than there are, or none would be seen.
        const float wanted = blades * one.share / std::max(shares, 1e-6f);
        const int count = std::max(static_cast<int>(std::lround(wanted)), one.flower ? 3 : 1);
        for (int i = 0; i < count; ++i, ++number) {
            const auto throwDice = [&number](std::uint32_t dimension) {
                return static_cast<float>(uniform(dice, number, dimension));
            };
            const float metres = glm::mix(one.height.x, one.height.y, throwDice(1));
            const float height = (high.y - low.y) * std::sqrt(std::min(metres / highest, 1.0f));
            drawBlade(list, style, one, {glm::mix(low.x, high.x, throwDice(0)), high.y}, height,
                      0.7f * (throwDice(2) - 0.5f));
        }
    }
    list.PopClipRect();
}

} // namespace sward::view
