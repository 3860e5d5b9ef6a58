#include "render/cull/cull_view.h"

#include "render/frame/frame.h"

namespace sward::render {

shared::Frame cullViewFrom(const shared::Frame& frame, const ViewMatrices& view)
{
    shared::Frame cullView = frame;
    look(cullView, view);
    return cullView;
}

shared::Frame listingAll(const shared::Frame& frame)
{
    shared::Frame all = frame;
    all.view.cullMask = 0;
    all.view.lodThreshold = 0.0f;
    all.view.maxLeafArea = 0.0f;
    all.cullResults = 0;
    all.pyramid = {};
    return all;
}

} // namespace sward::render
