#include "render/layers/frame_layers.h"

#include "shaders/shared/layers/layers_table.h"

#include <algorithm>
#include <cstring>
#include <initializer_list>
#include <span>

namespace sward::render {
namespace {

constexpr std::uint32_t halfBits = 16;

bool isAnyOf(LayerMask wanted, std::initializer_list<Layer> layers)
{
    return std::ranges::any_of(layers, [&](Layer layer) { return (wanted & bitOf(layer)) != 0; });
}

std::span<const std::uint32_t> regionOf(const LayerWords& words, const LayerRegions& regions,
                                        LayerWord which)
{
    const LayerRegion& region = regions.of[static_cast<std::size_t>(which)];
    return std::span(words.words)
        .subspan(region.first, region.each * std::size_t(words.size.x) * words.size.y);
}

template <typename T>
void put(FrameLayers& layers, Layer layer, std::span<const std::uint32_t> words, const T& numberOf)
{
    using Number = decltype(numberOf(std::uint32_t()));
    std::vector<std::byte>& bytes = layers.arrays[static_cast<std::size_t>(layer)];
    bytes.resize(words.size() * sizeof(Number));
    for (std::size_t i = 0; i < words.size(); ++i) {
        const Number number = numberOf(words[i]);
        std::memcpy(bytes.data() + i * sizeof number, &number, sizeof number);
    }
}

/// Three halves of each two words.
void putHalves(FrameLayers& layers, Layer layer, std::span<const std::uint32_t> words)
{
    constexpr std::size_t each = 3 * sizeof(std::uint16_t);
    std::vector<std::byte>& bytes = layers.arrays[static_cast<std::size_t>(layer)];
    bytes.resize(words.size() / 2 * each);
    for (std::size_t i = 0; i < words.size() / 2; ++i)
        std::memcpy(bytes.data() + i * each, &words[2 * i], each);
}

void putWords(FrameLayers& layers, Layer layer, std::span<const std::uint32_t> words)
{
    std::vector<std::byte>& bytes = layers.arrays[static_cast<std::size_t>(layer)];
    bytes.resize(words.size_bytes());
    if (!bytes.empty())
        std::memcpy(bytes.data(), words.data(), bytes.size());
}

/// Ids of blades by resident id. Neighbouring pixels mostly show one blade.
class Ids {
public:
    Ids(const LayerWords& words, const field::FieldView& field)
        : words_(words)
        , field_(field)
    {
    }

    std::uint64_t of(std::uint32_t blade, std::uint32_t number)
    {
        if (blade != blade_ || number != number_) {
            blade_ = blade;
            number_ = number;
            id_ = LayerId::of(known(blade), number);
        }
        return id_;
    }

private:
    std::uint64_t known(std::uint32_t blade) const
    {
        if (words_.ids != nullptr)
            return blade < words_.ids->size() ? (*words_.ids)[blade] : 0;
        return blade < field_.blades.size() ? field_.idOf(blade) : 0;
    }

    const LayerWords& words_;
    const field::FieldView& field_;
    std::uint32_t blade_ = ~0U;
    std::uint32_t number_ = ~0U;
    std::uint64_t id_ = 0;
};

/// Puts the ids of blades, or of the plants that they are parts of.
void putIds(FrameLayers& layers, Layer layer, const LayerWords& words, const LayerRegions& regions,
            const field::FieldView& field, std::span<const std::uint32_t> numberOfPatch)
{
    const auto blades = regionOf(words, regions, LayerWord::blade);
    const auto patches = regionOf(words, regions, LayerWord::patch);
    const auto surfaces = regionOf(words, regions, LayerWord::surface);
    Ids ids(words, field);
    std::vector<std::byte>& bytes = layers.arrays[static_cast<std::size_t>(layer)];
    bytes.resize(blades.size() * sizeof(std::uint64_t));
    for (std::size_t i = 0; i < blades.size(); ++i) {
        std::uint64_t id = 0;
        if (blades[i] != 0) {
            const std::uint32_t part = layer == Layer::plant ? surfaces[i] >> halfBits & 255U : 0;
            const std::uint32_t patch = patches[i] - 1;
            const std::uint32_t number = patch < numberOfPatch.size() ? numberOfPatch[patch] : 0;
            // Ribbons are stored right after their stalk.
            id = ids.of(blades[i] - 1 - part, number);
        }
        std::memcpy(bytes.data() + i * sizeof id, &id, sizeof id);
    }
}

} // namespace

LayerRegions layerRegions(LayerMask wanted, std::size_t pixels)
{
    using enum Layer;
    LayerRegions regions;
    const auto add = [&](LayerWord word, std::uint32_t each, std::initializer_list<Layer> layers) {
        if (!isAnyOf(wanted, layers))
            return;
        regions.of[static_cast<std::size_t>(word)] = {regions.words, each};
        // The next one begins at a multiple of 16 bytes.
        regions.words += (each * pixels + 3) / 4 * 4;
    };
    add(LayerWord::depth, 1, {depth});
    add(LayerWord::plane, 1, {planarDepth});
    add(LayerWord::normal, 2, {normal});
    add(LayerWord::albedo, 2, {albedo});
    add(LayerWord::surface, 1, {kind, species, plant});
    add(LayerWord::blade, 1, {blade, plant});
    add(LayerWord::patch, 1, {patch, blade, plant});
    add(LayerWord::flow, 2, {flowBackward});
    add(LayerWord::share, 1, {coverage, sun});
    // The last, because it may be missing: see LayersPass::record().
    add(LayerWord::flowAhead, 2, {flowForward});
    return regions;
}

FrameLayers layersOf(const LayerWords& words, const field::FieldView& field,
                     std::span<const std::uint32_t> numberOfPatch)
{
    const LayerRegions regions =
        layerRegions(words.wanted, std::size_t(words.size.x) * words.size.y);
    expect(words.words.size() >= regions.words, "the words hold all layers");
    FrameLayers layers;
    layers.size = words.size;
    const auto isWanted = [&](Layer layer) { return (words.wanted & bitOf(layer)) != 0; };
    const auto copy = [&](Layer layer, LayerWord word) {
        if (isWanted(layer))
            putWords(layers, layer, regionOf(words, regions, word));
    };
    copy(Layer::depth, LayerWord::depth);
    copy(Layer::planarDepth, LayerWord::plane);
    copy(Layer::patch, LayerWord::patch);
    copy(Layer::flowBackward, LayerWord::flow);
    copy(Layer::flowForward, LayerWord::flowAhead);
    if (isWanted(Layer::normal))
        putHalves(layers, Layer::normal, regionOf(words, regions, LayerWord::normal));
    if (isWanted(Layer::albedo))
        putHalves(layers, Layer::albedo, regionOf(words, regions, LayerWord::albedo));
    const auto surfaces = regionOf(words, regions, LayerWord::surface);
    if (isWanted(Layer::kind))
        put(layers, Layer::kind, surfaces,
            [](std::uint32_t word) { return static_cast<std::uint8_t>(word); });
    if (isWanted(Layer::species))
        put(layers, Layer::species, surfaces, [](std::uint32_t word) {
            const bool isBlade = (word & 255U) == shared::kindBlade;
            return static_cast<std::uint8_t>(isBlade ? (word >> 8U & 255U) + 1 : 0);
        });
    const auto shares = regionOf(words, regions, LayerWord::share);
    if (isWanted(Layer::coverage))
        put(layers, Layer::coverage, shares,
            [](std::uint32_t word) { return static_cast<std::uint16_t>(word); });
    if (isWanted(Layer::sun))
        put(layers, Layer::sun, shares,
            [](std::uint32_t word) { return static_cast<std::uint16_t>(word >> halfBits); });
    for (const Layer layer : {Layer::blade, Layer::plant})
        if (isWanted(layer))
            putIds(layers, layer, words, regions, field, numberOfPatch);
    return layers;
}

} // namespace sward::render
