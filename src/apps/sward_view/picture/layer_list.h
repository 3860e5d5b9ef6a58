#pragma once

#include "render/layers/frame_layers.h"

#include <string>

namespace sward::view {

/// Names of layers for help and messages: "depth, normal, …".
std::string layerNames();

/// The layers in a list such as "depth,id", or all of "all". Throws Error{usage} that names
/// `option` and the word.
render::LayerMask parseLayers(const std::string& option, const std::string& list);

} // namespace sward::view
