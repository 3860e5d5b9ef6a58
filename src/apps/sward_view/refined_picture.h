#pragma once

#include "apps/sward_view/picture_mean.h"
#include "apps/sward_view/scaled_picture.h"
#include "gpu/buffer.h"
#include "gpu/context.h"
#include "gpu/frame_ring.h"
#include "gpu/image.h"
#include "render/field_renderer.h"

#include <glm/vec2.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace sward::view {

/// A fine picture of something that stands still: the mean of pictures that are shifted by less
/// than a pixel. It is drawn in tiles, so that a slow device can do something else between two.
class RefinedPicture {
public:
    explicit RefinedPicture(const gpu::DeviceContext& context)
        : context_(context)
    {
    }

    /// Begins anew: shows `coarse`, scaled to `window` pixels, until tiles cover it. Waits for the
    /// device.
    void begin(const ScaledPicture& coarse, VkExtent2D window);

    /// What is drawn; constant from begin() on.
    struct Scene {
        render::FieldRenderer& renderer;
        const render::Camera& camera;
        const render::FrameSettings& settings; ///< for the samples of a mean (refinedSettings())
        double time;                           ///< [s]
    };

    struct Progress {
        bool isShown;  ///< the picture has changed
        bool endsPass; ///< all pixels have one more picture
    };

    /// Draws the next tile and waits for it.
    Progress drawTile(gpu::FrameRing& ring, const Scene& scene);

    /// Of the window's size, in ImageUse::transferSource.
    const gpu::Image& image() const { return image_; }

    /// Blades drawn in the tiles of the first pass so far. A blade counts in each of its tiles.
    std::uint64_t drawnBlades() const { return drawnBlades_; }

private:
    void beginPass();
    Picture drawPart(gpu::FrameRing& ring, const Scene& scene, glm::uvec2 first, glm::uvec2 size);
    void show(const Picture& part, glm::uvec2 first);

    const gpu::DeviceContext& context_;
    gpu::Image image_;
    gpu::Image tile_;
    gpu::Buffer staging_;
    std::optional<PictureMean> mean_;
    std::vector<glm::uvec2> tiles_; ///< first pixel of each, from the middle outwards
    std::size_t next_ = 0;
    std::uint32_t pass_ = 0;
    std::uint64_t drawnBlades_ = 0;
    double longest_ = 0.0;     ///< [s] tile of this pass
    std::uint32_t edge_ = 192; ///< [pixels] of a tile, its margin included
};

/// Edge of the next pass's tiles [pixels], if the longest tile of one with `edge` took `seconds`.
std::uint32_t nextTileEdge(std::uint32_t edge, double seconds);

/// Settings for pictures of a mean, whose renderer has `samples` per pixel: blades are as narrow as
/// in a picture of sixteen samples.
render::FrameSettings refinedSettings(render::FrameSettings settings, std::uint32_t samples);

} // namespace sward::view
