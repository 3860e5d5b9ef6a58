#include "render/judged_frame.h"

#include <algorithm>

namespace sward::render {

shared::Frame judgedFrom(const shared::Frame& frame, const ViewMatrices& view)
{
    shared::Frame judged = frame;
    judged.viewProjection = view.viewProjection;
    std::copy(view.planes.begin(), view.planes.end(), judged.planes);
    judged.eye = view.eye;
    judged.pixelsPerUnit = view.pixelsPerUnit;
    return judged;
}

shared::Frame listingAll(const shared::Frame& frame)
{
    shared::Frame all = frame;
    all.cullMask = 0;
    all.lodThreshold = 0.0f;
    all.fates = 0;
    all.pyramid = {};
    return all;
}

} // namespace sward::render
