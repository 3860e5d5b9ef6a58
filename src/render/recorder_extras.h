#pragma once

#include "core/embedded.h"
#include "render/raster/opaque_layer.h"
#include "shaders/shared/frame.h"

#include <optional>
#include <span>

namespace sward::render {

/// What the renderer of a field with its ground (FieldRenderer) sets besides what hosts do.
struct RecorderExtras {
    std::span<const EmbeddedFile> shaders{}; ///< empty: the built-in ones
    std::optional<bool> testsSmall{}; ///< see UpdateCullPass::Variant; unset: where groups draw
};

/// The same for the only view of a frame.
struct ViewExtras {
    const OpaqueLayer* layer = nullptr; ///< of a view that is rasterised
    shared::DepthPyramid frozen{};      ///< of a frozen camera: the last one of the picture's
    bool drawsAll = false;  ///< culls and counts, then lists all blades; needs the cull results
    bool onlyMoves = false; ///< draws nothing: what other frames rasterise into is kept
};

} // namespace sward::render
