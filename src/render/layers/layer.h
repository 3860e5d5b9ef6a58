#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace sward::render {

/// What the pixels of a frame show, as numbers beside the picture: docs/layers.md. With several
/// samples per pixel, of the nearest sample.
enum class Layer : std::uint32_t {
    depth,        ///< [m] along the ray; infinite for the sky
    planarDepth,  ///< [m] along the view; infinite for the sky
    normal,       ///< unit, world space, of the visible side; 0 for the sky
    albedo,       ///< linear R G B; 0 for the sky
    blade,        ///< LayerId of the blade; 0: no blade
    plant,        ///< LayerId of the stalk that the blade stands on, or of the blade itself
    species,      ///< 1 + slot of the blade's species in the field; 0: no blade
    patch,        ///< 1 + number of the blade's patch in device memory; 0: no blade
    kind,         ///< shared::kindSky …
    flowBackward, ///< [pixels] right and down, to where the frame before had the same place
    flowForward,  ///< [pixels] likewise, to where the next frame has it
    coverage,     ///< [0, 1] share of the samples that show blades
    sun,          ///< [0, 1] share of the sun's light that reaches the place
};

constexpr std::size_t layerCount = 13; ///< of Layer

/// Layers as bits, 1 << Layer.
using LayerMask = std::uint32_t;

/// The bit of a layer.
constexpr LayerMask bitOf(Layer layer)
{
    return LayerMask(1) << static_cast<std::uint32_t>(layer);
}

/// Every layer.
constexpr LayerMask allLayers = (LayerMask(1) << layerCount) - 1;
/// Those that need FieldRendererSettings::keepsMotion.
constexpr LayerMask flowLayers = bitOf(Layer::flowBackward) | bitOf(Layer::flowForward);

/// How a layer's numbers are stored.
enum class LayerNumber {
    half,  ///< 16-bit floating point
    real,  ///< float
    byte,  ///< std::uint8_t
    whole, ///< std::uint32_t
    wide,  ///< std::uint64_t
};

/// Size of a number [bytes].
std::size_t sizeOf(LayerNumber number);

/// Name and form of a layer.
struct LayerForm {
    std::string_view name; ///< as --layers and files have it
    LayerNumber number = LayerNumber::real;
    std::uint32_t channels = 1; ///< numbers of a pixel
};

/// The form of a layer.
const LayerForm& formOf(Layer layer);

/// Ids of blades in layers: the lower bits are field::bladeId(), which --dump-blades writes; the
/// upper 11 are 1 + number of the field among those that are drawn together. Never 0.
struct LayerId {
    static constexpr std::uint32_t bladeBits = 53;   ///< of field::bladeId()
    static constexpr std::uint32_t maxFields = 2047; ///< that can be told apart

    /// `field`: below maxFields.
    static constexpr std::uint64_t of(std::uint64_t blade, std::uint32_t field = 0)
    {
        return blade | (std::uint64_t(field) + 1) << bladeBits;
    }
};

} // namespace sward::render
