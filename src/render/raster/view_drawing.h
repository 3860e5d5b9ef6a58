#pragma once

#include "render/raster/opaque_layer.h"

#include <cstdint>

namespace sward::render {

/// How a view of a frame is drawn.
struct ViewDrawing {
    const char* obstacle = nullptr;      ///< why it is not rasterised; null: none
    const char* storeObstacle = nullptr; ///< why it is not stored; null: none
    std::uint32_t samples = 1;           ///< per pixel
    bool hasReversedZ = true;
    bool hasShadows = false;            ///< of the blades near its eye
    bool hasTwoPasses = false;          ///< an early and a late one
    bool drawsAll = false;              ///< what InstanceConstants::Kind::listing lists
    bool onlyMoves = false;             ///< nothing is drawn; see ViewExtras
    bool hasLayers = false;             ///< HostLayers are written
    const OpaqueLayer* layer = nullptr; ///< null: the host's depth
    bool isCulled = false;              ///< Grass::recordCull() has been called …
    bool isRastered = false;            ///< … and Grass::recordRaster()
};

} // namespace sward::render
