#include "render/judged_frame.h"

#include "render/frame.h"

namespace sward::render {

shared::Frame judgedFrom(const shared::Frame& frame, const ViewMatrices& view)
{
    shared::Frame judged = frame;
    look(judged, view);
    return judged;
}

shared::Frame listingAll(const shared::Frame& frame)
{
    shared::Frame all = frame;
    all.view.cullMask = 0;
    all.view.lodThreshold = 0.0f;
    all.view.maxLayers = 0.0f;
    all.fates = 0;
    all.pyramid = {};
    return all;
}

} // namespace sward::render
