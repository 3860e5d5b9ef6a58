#pragma once

#include "render/camera.h"
#include "shaders/shared/frame.h"

namespace sward::render {

/// The frame by which blades are culled from another camera than the picture's: a frozen one.
shared::Frame cullViewFrom(const shared::Frame& frame, const ViewMatrices& view);

/// The frame that lists every blade for the picture and leaves the cull results alone that have been
/// found before.
shared::Frame listingAll(const shared::Frame& frame);

} // namespace sward::render
