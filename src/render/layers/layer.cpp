#include "render/layers/frame_layers.h"

#include <array>

namespace sward::render {

std::size_t sizeOf(LayerNumber number)
{
    switch (number) {
    case LayerNumber::byte:
        return 1;
    case LayerNumber::half:
        return 2;
    case LayerNumber::wide:
        return 8;
    case LayerNumber::real:
    case LayerNumber::whole:
        break;
    }
    return 4;
}

const LayerForm& formOf(Layer layer)
{
    using enum LayerNumber;
    static constexpr std::array<LayerForm, layerCount> forms{{{"depth", real, 1},
                                                              {"planar-depth", real, 1},
                                                              {"normal", half, 3},
                                                              {"albedo", half, 3},
                                                              {"id", wide, 1},
                                                              {"plant", wide, 1},
                                                              {"species", byte, 1},
                                                              {"patch", whole, 1},
                                                              {"class", byte, 1},
                                                              {"flow-backward", real, 2},
                                                              {"flow-forward", real, 2},
                                                              {"coverage", half, 1},
                                                              {"sun", half, 1}}};
    return forms[static_cast<std::size_t>(layer)];
}

} // namespace sward::render
