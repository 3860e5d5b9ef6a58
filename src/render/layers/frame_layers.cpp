#include "render/layers/frame_layers.h"

#include "render/layers/layer_regions.h"
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
    return words.words.subspan(region.first,
                               region.each * std::size_t(words.size.x) * words.size.y);
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

/// A blade as words have it.
struct WordedBlade {
    std::uint32_t blade;  ///< resident id
    std::uint32_t number; ///< of its field, or instance
    auto operator<=>(const WordedBlade&) const = default;
};

/// Puts the ids of blades, or of the plants that they are parts of. `numberOf` tells the number of
/// the field of a pixel, `idOf` the id of a blade.
template <typename NumberOf, typename IdOf>
void putIds(FrameLayers& layers, Layer layer, const LayerWords& words, const LayerRegions& regions,
            const NumberOf& numberOf, const IdOf& idOf)
{
    const auto blades = regionOf(words, regions, LayerWord::blade);
    const auto surfaces = regionOf(words, regions, LayerWord::surface);
    std::vector<std::byte>& bytes = layers.arrays[static_cast<std::size_t>(layer)];
    bytes.resize(blades.size() * sizeof(std::uint64_t));
    // Neighbouring pixels mostly show one blade.
    WordedBlade last{~0U, ~0U};
    std::uint64_t lastId = 0;
    for (std::size_t i = 0; i < blades.size(); ++i) {
        std::uint64_t id = 0;
        if (blades[i] != 0) {
            // Ribbons are stored right after their stalk.
            const std::uint32_t part =
                layer == Layer::plant ? shared::surfaceNumber(surfaces[i]) : 0;
            const WordedBlade blade{blades[i] - 1 - part, numberOf(i)};
            if (blade != last) {
                last = blade;
                lastId = LayerId::of(idOf(blade), blade.number);
            }
            id = lastId;
        }
        std::memcpy(bytes.data() + i * sizeof id, &id, sizeof id);
    }
}

/// The id of a blade in its field; 0: of none.
std::uint64_t idIn(const field::FieldView& field,
                   const std::shared_ptr<const std::vector<std::uint64_t>>& ids,
                   std::uint32_t blade)
{
    if (ids != nullptr)
        return blade < ids->size() ? (*ids)[blade] : 0;
    return blade < field.blades.size() ? field.idOf(blade) : 0;
}

/// All layers but those of ids.
FrameLayers plainLayersOf(const LayerWords& words, const LayerRegions& regions)
{
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
        put(layers, Layer::kind, surfaces, [](std::uint32_t word) {
            return static_cast<std::uint8_t>(shared::surfaceKind(word));
        });
    if (isWanted(Layer::species))
        put(layers, Layer::species, surfaces, [](std::uint32_t word) {
            const bool isBlade = shared::surfaceKind(word) == shared::kindBlade;
            return static_cast<std::uint8_t>(isBlade ? shared::surfaceSpecies(word) + 1 : 0);
        });
    const auto shares = regionOf(words, regions, LayerWord::share);
    if (isWanted(Layer::coverage))
        put(layers, Layer::coverage, shares,
            [](std::uint32_t word) { return static_cast<std::uint16_t>(word); });
    if (isWanted(Layer::sun))
        put(layers, Layer::sun, shares,
            [](std::uint32_t word) { return static_cast<std::uint16_t>(word >> halfBits); });
    return layers;
}

} // namespace

LayerRegions layerRegions(LayerMask wanted, std::size_t pixels, bool ofInstances)
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
    if (ofInstances)
        add(LayerWord::surface, 1, {kind, species, plant, blade});
    else
        add(LayerWord::surface, 1, {kind, species, plant});
    add(LayerWord::blade, 1, {blade, plant});
    if (ofInstances)
        add(LayerWord::patch, 1, {patch});
    else
        add(LayerWord::patch, 1, {patch, blade, plant});
    add(LayerWord::flow, 2, {flowBackward});
    add(LayerWord::share, 1, {coverage, sun});
    // The last, because it may be missing: see LayersPass::record().
    add(LayerWord::flowAhead, 2, {flowForward});
    return regions;
}

std::size_t layerBytes(LayerMask wanted, glm::uvec2 size, bool ofInstances)
{
    return layerRegions(wanted, std::size_t(size.x) * size.y, ofInstances).words *
           sizeof(std::uint32_t);
}

FrameLayers layersOf(const LayerWords& words, const field::FieldView& field,
                     std::span<const std::uint32_t> numberOfPatch)
{
    const LayerRegions regions =
        layerRegions(words.wanted, std::size_t(words.size.x) * words.size.y);
    FrameLayers layers = plainLayersOf(words, regions);
    const auto patches = regionOf(words, regions, LayerWord::patch);
    const auto numberOf = [&](std::size_t pixel) {
        const std::uint32_t patch = patches[pixel] - 1;
        return patch < numberOfPatch.size() ? numberOfPatch[patch] : 0;
    };
    const auto idOf = [&](WordedBlade blade) { return idIn(field, words.ids, blade.blade); };
    for (const Layer layer : {Layer::blade, Layer::plant})
        if ((words.wanted & bitOf(layer)) != 0)
            putIds(layers, layer, words, regions, numberOf, idOf);
    return layers;
}

FrameLayers layersOf(const LayerWords& words, std::span<const LayerInstance> instances)
{
    const LayerRegions regions =
        layerRegions(words.wanted, std::size_t(words.size.x) * words.size.y, true);
    FrameLayers layers = plainLayersOf(words, regions);
    const auto surfaces = regionOf(words, regions, LayerWord::surface);
    const auto numberOf = [&](std::size_t pixel) {
        return shared::surfaceInstance(surfaces[pixel]);
    };
    const auto idOf = [&](WordedBlade blade) -> std::uint64_t {
        if (blade.number >= instances.size() || instances[blade.number].field == nullptr)
            return 0;
        const LayerInstance& instance = instances[blade.number];
        return idIn(*instance.field, instance.ids, blade.blade);
    };
    for (const Layer layer : {Layer::blade, Layer::plant})
        if ((words.wanted & bitOf(layer)) != 0)
            putIds(layers, layer, words, regions, numberOf, idOf);
    return layers;
}

} // namespace sward::render
