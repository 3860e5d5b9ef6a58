#pragma once

#include "core/expect.h"
#include "field/field.h"
#include "render/layers/layer.h"

#include <glm/vec2.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace sward::render {

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

/// Layers as a device wrote them: a copy that any thread may convert while the next frame is drawn.
struct LayerWords {
    glm::uvec2 size{0};               ///< [pixels]
    LayerMask wanted = 0;             ///< flowForward is of the frame before
    std::vector<std::uint32_t> words; ///< regions of shared::LayersTable, see layerRegions()
    /// LayerId of blades by resident id; null: those of the field's blades, in file order.
    std::shared_ptr<const std::vector<std::uint64_t>> ids;
};

/// A region of LayerWords::words.
struct LayerRegion {
    std::size_t first = 0;  ///< [words]
    std::uint32_t each = 0; ///< words of a pixel; 0: none is wanted
};

/// What a device writes, in the order of shared::LayersTable from `depths` on.
enum class LayerWord : std::uint32_t {
    depth,     ///< LayersTable::depths …
    plane,     ///< likewise planes
    normal,    ///< likewise normals
    albedo,    ///< likewise albedos
    surface,   ///< likewise surfaces
    blade,     ///< likewise blades
    patch,     ///< likewise patches
    flow,      ///< likewise flows
    flowAhead, ///< likewise flowsAhead
    share,     ///< likewise shares
};

constexpr std::size_t layerWordCount = 10; ///< of LayerWord

/// Regions of the layers of `pixels`, and their words together.
struct LayerRegions {
    std::array<LayerRegion, layerWordCount> of{}; ///< by LayerWord
    std::size_t words = 0;                        ///< of all
};

/// The regions that some layers take.
LayerRegions layerRegions(LayerMask wanted, std::size_t pixels);

/// The layers as arrays. `field` is the renderer's. `numberOfPatch`: for LayerId, number of the
/// field that each patch comes from; empty: there is one.
FrameLayers layersOf(const LayerWords& words, const field::FieldView& field,
                     std::span<const std::uint32_t> numberOfPatch = {});

} // namespace sward::render
