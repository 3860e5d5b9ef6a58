#pragma once

#include "apps/sward_view/picture/picture_mean.h"
#include "apps/sward_view/picture/scaled_picture.h"
#include "gpu/context/context.h"
#include "gpu/memory/buffer.h"
#include "gpu/memory/image.h"
#include "gpu/recording/frame_ring.h"
#include "render/viewer/field_renderer.h"

#include <glm/vec2.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace sward::view {

/// A fine picture of something that stands still: the mean of pictures that are shifted by less
/// than a pixel. It is drawn in tiles, so that a slow device can do something else between two, and
/// shown when all of them are there: tiles that are finer than others would be seen as rectangles.
class RefinedPicture {
public:
    explicit RefinedPicture(const gpu::DeviceContext& context)
        : context_(context)
    {
    }

    /// Begins anew: shows `coarse`, scaled to `window` pixels, until the first pass has ended. The
    /// fine picture has as many pixels, and begins `shift` pixels right of the window's left
    /// border. Waits for the device.
    void begin(const ScaledPicture& coarse, VkExtent2D window, std::uint32_t shift);

    /// What is drawn; constant from begin() on.
    struct Scene {
        render::FieldRenderer& renderer;
        const render::Camera& camera;
        const render::FrameSettings& settings; ///< for the samples of a mean (refinedSettings())
        double time;                           ///< [s]
    };

    struct Progress {
        bool isShown;  ///< the picture has changed, as a whole
        bool endsPass; ///< all pixels have one more picture
    };

    /// Draws the next tile and waits for it.
    Progress drawTile(gpu::FrameRing& ring, const Scene& scene);

    /// Of the window's size, in ImageUse::transferSource.
    const gpu::Image& image() const { return image_; }

    /// Where the picture begins in the window [pixels].
    std::uint32_t shift() const { return pass_ > 0 ? shift_ : 0; }

    /// Blades drawn in the tiles of the first pass so far. A blade counts in each of its tiles.
    std::uint64_t drawnBlades() const { return drawnBlades_; }

    /// Blades of the field in the last tile.
    std::uint64_t fieldBlades() const { return fieldBlades_; }

private:
    void beginPass();
    Picture drawPart(gpu::FrameRing& ring, const Scene& scene, glm::uvec2 first, glm::uvec2 size);
    void keep(const Picture& part, glm::uvec2 first);

    const gpu::DeviceContext& context_;
    gpu::Image image_;
    gpu::Image next_; ///< the same with the tiles of this pass, in ImageUse::transferSource
    gpu::Image tile_;
    gpu::Buffer staging_;
    std::optional<PictureMean> mean_;
    std::vector<glm::uvec2> tiles_; ///< first pixel of each, from the middle outwards
    std::size_t drawnTiles_ = 0;    ///< of this pass
    std::uint32_t pass_ = 0;
    std::uint32_t shift_ = 0; ///< [pixels]
    std::uint64_t drawnBlades_ = 0;
    std::uint64_t fieldBlades_ = 0;
    double longest_ = 0.0;     ///< [s] tile of this pass
    std::uint32_t edge_ = 192; ///< [pixels] of a tile, its margin included
};

/// Edge of the next pass's tiles [pixels], if the longest tile of one with `edge` took `seconds`.
std::uint32_t nextTileEdge(std::uint32_t edge, double seconds);

/// Settings for pictures of a mean, whose renderer has `samples` per pixel: blades are as narrow as
/// in a picture of sixteen samples.
render::FrameSettings refinedSettings(render::FrameSettings settings, std::uint32_t samples);

} // namespace sward::view
