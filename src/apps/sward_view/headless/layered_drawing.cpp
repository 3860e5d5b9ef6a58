#include "apps/sward_view/headless/layered_drawing.h"

#include <cstddef>
#include <utility>

namespace sward::view {

LayeredDrawing::LayeredDrawing(Headless& headless, render::LayerMask layers, bool isRadiance,
                               Use use)
    : headless_(headless)
    , layers_(layers)
    , isRadiance_(isRadiance)
    , use_(std::move(use))
{
}

bool LayeredDrawing::looksAhead() const
{
    return (layers_ & render::bitOf(render::Layer::flowForward)) != 0;
}

/// Hands over the frame that waits for its forward flow, which `next` has.
void LayeredDrawing::complete(const render::FrameLayers& next)
{
    if (!waiting_)
        return;
    constexpr auto forward = static_cast<std::size_t>(render::Layer::flowForward);
    waiting_->drawn.layers.arrays[forward] = next.arrays[forward];
    use_(waiting_->frame, waiting_->drawn);
    waiting_.reset();
}

void LayeredDrawing::draw(std::uint64_t frame, bool isWanted)
{
    headless_.stream(frame);
    const bool isLayered = layers_ != 0 && (isWanted || waiting_.has_value());
    headless_.draw(frame, isLayered ? layers_ : 0);
    render::FrameLayers layers;
    if (isLayered)
        layers = headless_.layersOf(headless_.layerWords());
    complete(layers);
    if (!isWanted)
        return;
    Waiting drawn{.frame = frame, .drawn = {}};
    if (isRadiance_)
        drawn.drawn.radiance = headless_.radiance();
    else
        drawn.drawn.picture = headless_.picture();
    layers.arrays[static_cast<std::size_t>(render::Layer::flowForward)].clear();
    drawn.drawn.layers = std::move(layers);
    if (looksAhead())
        waiting_ = std::move(drawn);
    else
        use_(frame, drawn.drawn);
}

void LayeredDrawing::finish()
{
    if (waiting_)
        draw(waiting_->frame + 1, false);
}

} // namespace sward::view
