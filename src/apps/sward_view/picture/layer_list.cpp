#include "apps/sward_view/picture/layer_list.h"

#include "core/error.h"

#include <cstdint>
#include <sstream>

namespace sward::view {
namespace {

template <typename Use>
void forEachKnown(const Use& use)
{
    for (std::uint32_t i = 0; i < render::layerCount; ++i)
        use(static_cast<render::Layer>(i));
}

} // namespace

std::string layerNames()
{
    std::string names;
    forEachKnown([&](render::Layer layer) {
        names += names.empty() ? "" : ", ";
        names += render::formOf(layer).name;
    });
    return names;
}

render::LayerMask parseLayers(const std::string& option, const std::string& list)
{
    render::LayerMask found = 0;
    std::istringstream words(list);
    for (std::string word; std::getline(words, word, ',');) {
        render::LayerMask named = word == "all" ? render::allLayers : 0;
        forEachKnown([&](render::Layer layer) {
            if (word == render::formOf(layer).name)
                named = render::bitOf(layer);
        });
        if (named == 0)
            fail(ErrorKind::usage, "{}: '{}' is not all or one of {}", option, word, layerNames());
        found |= named;
    }
    if (found == 0)
        fail(ErrorKind::usage, "{}: '{}' names no layer", option, list);
    return found;
}

} // namespace sward::view
