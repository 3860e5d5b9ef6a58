#include "apps/sward_view/scene/cull_list.h"

#include "apps/common/parse_text.h"
#include "core/error.h"
#include "core/json/settings_json.h"
#include "render/frame/cull_tests.h"

#include <algorithm>
#include <string>

namespace sward::view {
namespace {

[[noreturn]] void refuse(std::string_view word)
{
    std::vector<std::string> known{"all", "none"};
    for (const render::CullTest& test : render::cullTests)
        known.emplace_back(test.name);
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
    for (const render::CullTest& test : render::cullTests)
        all |= test.bit;
    if (text == "all")
        return all;
    if (text == "none")
        return 0;

    std::uint32_t mask = 0;
    for (const std::string_view word : apps::splitText(text, ',')) {
        const auto* const found =
            std::find_if(render::cullTests.begin(), render::cullTests.end(),
                         [word](const render::CullTest& test) { return test.name == word; });
        if (found == render::cullTests.end())
            refuse(word);
        mask |= found->bit;
    }
    return mask;
}

} // namespace sward::view
