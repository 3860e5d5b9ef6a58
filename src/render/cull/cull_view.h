#pragma once

#include "render/frame/camera.h"
#include "shaders/shared/frame.h"

namespace sward::render {

/// The frame for culling blades from a camera other than the picture's (frozen camera).
shared::Frame cullViewFrom(const shared::Frame& frame, const ViewMatrices& view);

/// The frame that lists every blade for the picture and keeps the cull results found before.
shared::Frame listingAll(const shared::Frame& frame);

} // namespace sward::render
