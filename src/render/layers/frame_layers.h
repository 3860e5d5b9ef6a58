#pragma once

#include "core/expect.h"
#include "field/field.h"

#include <glm/vec2.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

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
    LayerNumber number = LayerNumber::real; ///< kind of its numbers
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

/// Layers of a frame as arrays: rows from the top, the numbers of a pixel together.
struct FrameLayers {
    glm::uvec2 size{0}; ///< [pixels]
    /// By Layer, in its LayerForm; empty: not there.
    std::array<std::vector<std::byte>, layerCount> arrays;

    /// Whether a layer is there.
    bool has(Layer layer) const { return !arrays[static_cast<std::size_t>(layer)].empty(); }

    /// A layer's numbers: formOf().channels of each pixel. `T` has the size of its numbers, and may
    /// be a vector of all channels.
    template <typename T>
    std::span<const T> as(Layer layer) const
    {
        const std::vector<std::byte>& bytes = arrays[static_cast<std::size_t>(layer)];
        expect(bytes.size() % sizeof(T) == 0, "a layer holds whole numbers");
        return {reinterpret_cast<const T*>(bytes.data()), bytes.size() / sizeof(T)};
    }
};

/// Layers as a device wrote them, which any thread may convert while other frames are drawn.
struct LayerWords {
    glm::uvec2 size{0};                     ///< [pixels]
    LayerMask wanted = 0;                   ///< flowForward is of the frame before
    std::span<const std::uint32_t> words{}; ///< of layerBytes(), in the caller's memory, or …
    std::shared_ptr<const std::vector<std::uint32_t>> copied{}; ///< … in this; else null
    /// LayerId of blades by resident id; null: those of the field's blades, in file order.
    std::shared_ptr<const std::vector<std::uint64_t>> ids{};
};

/// Bytes of the words of some layers of a picture. `ofInstances`: as HostLayers has them.
std::size_t layerBytes(LayerMask wanted, glm::uvec2 size, bool ofInstances = false);

/// The layers as arrays. `field` is the renderer's. `numberOfPatch`: for LayerId, number of the
/// field that each patch comes from; empty: there is one.
FrameLayers layersOf(const LayerWords& words, const field::FieldView& field,
                     std::span<const std::uint32_t> numberOfPatch = {});

/// What names the blades of an instance of render::Grass.
struct LayerInstance {
    const field::FieldView* field = nullptr; ///< what its ResidentField was made of; after edits
                                             ///< the edited field
    std::shared_ptr<const std::vector<std::uint64_t>> ids{}; ///< ResidentField::layerIds()
};

/// The same of HostLayers. `instances`: as Grass::layerInstances() lists them; their numbers are
/// the fields of LayerId. Needed for blade and plant alone.
FrameLayers layersOf(const LayerWords& words, std::span<const LayerInstance> instances);

} // namespace sward::render
