#pragma once

#include "apps/sward_view/headless/headless.h"
#include "apps/sward_view/picture/png.h"
#include "apps/sward_view/picture/radiance.h"
#include "render/layers/frame_layers.h"

#include <cstdint>
#include <functional>
#include <optional>

namespace sward::view {

/// A picture and its layers.
struct LayeredFrame {
    Picture picture;   ///< on film …
    Radiance radiance; ///< … or this
    render::FrameLayers layers;
};

/// Draws frames with layers. The forward flow of a frame is known once the next one is drawn.
class LayeredDrawing {
public:
    using Use = std::function<void(std::uint64_t frame, const LayeredFrame&)>;

    /// `use` gets the frames that are wanted, in their order. `isRadiance`: as Headless has it.
    LayeredDrawing(Headless& headless, render::LayerMask layers, bool isRadiance, Use use);

    /// Draws a frame; call with consecutive ones. `isWanted`: for `use`.
    void draw(std::uint64_t frame, bool isWanted);

    /// Hands over what is left, for which another frame may be drawn.
    void finish();

private:
    struct Waiting {
        std::uint64_t frame = 0;
        LayeredFrame drawn;
    };

    bool looksAhead() const;
    void complete(const render::FrameLayers& next);

    Headless& headless_;
    render::LayerMask layers_;
    bool isRadiance_;
    Use use_;
    std::optional<Waiting> waiting_;
};

} // namespace sward::view
