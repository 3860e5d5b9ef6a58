#include "apps/sward_view/cull_list.h"

#include "apps/common/parse_text.h"
#include "core/error.h"
#include "core/settings_json.h"
#include "shaders/shared/culling.h"

#include <algorithm>
#include <array>
#include <string>

namespace sward::view {
namespace {

struct CullWord {
    std::string_view word;
    std::uint32_t bits;
};

constexpr std::array<CullWord, 5> cullWords{{{"patch", shared::cullPatch},
                                             {"orientation", shared::cullOrientation},
                                             {"frustum", shared::cullFrustum},
                                             {"distance", shared::cullDistance},
                                             {"occlusion", shared::cullOcclusion}}};

[[noreturn]] void refuse(std::string_view word)
{
    std::vector<std::string> known{"all", "none"};
    for (const CullWord& entry : cullWords)
        known.emplace_back(entry.word);
    const std::string near = nearestWord(word, known);
    fail(ErrorKind::usage,
         "--cull: '{}' is not all, none, or a list of patch,orientation,frustum,distance,"
         "occlusion{}",
         word, near.empty() ? "" : "; did you mean " + near + "?");
}

} // namespace

std::uint32_t parseCullList(std::string_view text)
{
    std::uint32_t all = 0;
    for (const CullWord& entry : cullWords)
        all |= entry.bits;
    if (text == "all")
        return all;
    if (text == "none")
        return 0;

    std::uint32_t mask = 0;
    for (const std::string_view word : apps::splitText(text, ',')) {
        const auto found =
            std::find_if(cullWords.begin(), cullWords.end(),
                         [word](const CullWord& entry) { return entry.word == word; });
        if (found == cullWords.end())
            refuse(word);
        mask |= found->bits;
    }
    return mask;
}

} // namespace sward::view
