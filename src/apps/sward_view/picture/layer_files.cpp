#include "apps/sward_view/picture/layer_files.h"

#include "apps/common/picture/npz_file.h"
#include "apps/common/picture/png_file.h"

#include <glm/gtc/packing.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>

namespace sward::view {
namespace {

using render::Layer;
using render::LayerForm;
using render::LayerNumber;

constexpr float fullWord = 65535.0f;   ///< largest value of a PNG
constexpr float depthSteps = 1000.0f;  ///< per metre
constexpr float flowSteps = 64.0f;     ///< per pixel, as in KITTI's files
constexpr float flowMiddle = 32768.0f; ///< no motion

template <typename Use>
void forEachLayer(const render::FrameLayers& layers, const Use& use)
{
    for (std::uint32_t i = 0; i < render::layerCount; ++i)
        if (const auto layer = static_cast<Layer>(i); layers.has(layer))
            use(layer, render::formOf(layer));
}

const std::byte* firstByteOf(const render::FrameLayers& layers, Layer layer)
{
    return layers.arrays[static_cast<std::size_t>(layer)].data();
}

/// Names of a layer's channels in OpenEXR.
std::vector<std::string> channelsOf(Layer layer)
{
    switch (layer) {
    case Layer::depth:
    case Layer::planarDepth:
        return {"Z"};
    case Layer::normal:
        return {"X", "Y", "Z"};
    case Layer::albedo:
        return {"R", "G", "B"};
    case Layer::blade:
    case Layer::plant:
        return {"low", "high"};
    case Layer::flowBackward:
    case Layer::flowForward:
        return {"X", "Y"};
    case Layer::species:
    case Layer::patch:
    case Layer::kind:
    case Layer::coverage:
    case Layer::sun:
        break;
    }
    return {"Y"};
}

/// The part of a layer; `widened` keeps its bytes as numbers that OpenEXR has.
apps::ExrPart partOf(const render::FrameLayers& layers, Layer layer, const LayerForm& form,
                     std::vector<std::vector<std::uint32_t>>& widened)
{
    apps::ExrPart part{std::string(form.name), {}};
    const std::byte* first = firstByteOf(layers, layer);
    std::size_t each = render::sizeOf(form.number);
    std::size_t step = form.channels * each;
    auto type = apps::ExrChannel::Type::real;
    if (form.number == LayerNumber::half)
        type = apps::ExrChannel::Type::half;
    if (form.number == LayerNumber::whole || form.number == LayerNumber::wide)
        type = apps::ExrChannel::Type::whole;
    if (form.number == LayerNumber::wide)
        each = sizeof(std::uint32_t); // the lower half first
    if (form.number == LayerNumber::byte) {
        const auto bytes = layers.as<std::uint8_t>(layer);
        const auto& words = widened.emplace_back(bytes.begin(), bytes.end());
        first = reinterpret_cast<const std::byte*>(words.data());
        each = step = sizeof(std::uint32_t);
        type = apps::ExrChannel::Type::whole;
    }
    for (const std::string& name : channelsOf(layer)) {
        part.channels.push_back({.name = name, .type = type, .first = first, .step = step});
        first += each;
    }
    return part;
}

const char* numpyType(LayerNumber number)
{
    switch (number) {
    case LayerNumber::half:
        return "<f2";
    case LayerNumber::byte:
        return "|u1";
    case LayerNumber::whole:
        return "<u4";
    case LayerNumber::wide:
        return "<u8";
    case LayerNumber::real:
        break;
    }
    return "<f4";
}

std::uint16_t wordOf(float value)
{
    return static_cast<std::uint16_t>(std::clamp(std::round(value), 0.0f, fullWord));
}

/// A picture of 16 bits.
struct Words {
    std::uint32_t channels = 1;
    std::vector<std::uint16_t> values;
};

Words depthWords(std::span<const float> depths)
{
    Words words;
    for (const float depth : depths)
        words.values.push_back(std::isfinite(depth) ? wordOf(depth * depthSteps)
                                                    : std::uint16_t(fullWord));
    return words;
}

/// Halves as value · scale + shift.
Words halfWords(std::span<const std::uint16_t> halves, std::uint32_t channels, float scale,
                float shift)
{
    Words words{channels, {}};
    for (const std::uint16_t half : halves)
        words.values.push_back(wordOf(glm::unpackHalf1x16(half) * scale + shift));
    return words;
}

/// The lowest 16 bits are red.
Words idWords(std::span<const std::uint64_t> ids)
{
    Words words{4, {}};
    for (const std::uint64_t id : ids)
        for (std::uint32_t i = 0; i < 4; ++i)
            words.values.push_back(static_cast<std::uint16_t>(id >> (16 * i)));
    return words;
}

Words flowWords(std::span<const glm::vec2> flows)
{
    Words words{3, {}};
    for (const glm::vec2 flow : flows) {
        const bool isKnown = std::isfinite(flow.x) && std::isfinite(flow.y);
        for (const float way : {flow.x, flow.y})
            words.values.push_back(isKnown ? wordOf(way * flowSteps + flowMiddle) : 0);
        words.values.push_back(isKnown ? 1 : 0);
    }
    return words;
}

Words wordsOf(const render::FrameLayers& layers, Layer layer)
{
    switch (layer) {
    case Layer::depth:
    case Layer::planarDepth:
        return depthWords(layers.as<float>(layer));
    case Layer::normal:
        return halfWords(layers.as<std::uint16_t>(layer), 3, 0.5f * fullWord, 0.5f * fullWord);
    case Layer::albedo:
        return halfWords(layers.as<std::uint16_t>(layer), 3, fullWord, 0.0f);
    case Layer::coverage:
    case Layer::sun:
        return halfWords(layers.as<std::uint16_t>(layer), 1, fullWord, 0.0f);
    case Layer::blade:
    case Layer::plant:
        return idWords(layers.as<std::uint64_t>(layer));
    case Layer::patch: {
        const auto patches = layers.as<std::uint32_t>(layer);
        return idWords(std::vector<std::uint64_t>(patches.begin(), patches.end()));
    }
    case Layer::flowBackward:
    case Layer::flowForward:
        return flowWords(layers.as<glm::vec2>(layer));
    case Layer::species:
    case Layer::kind:
        break;
    }
    const auto bytes = layers.as<std::uint8_t>(layer);
    return {1, {bytes.begin(), bytes.end()}};
}

} // namespace

void writeLayersExr(const Radiance& picture, const render::FrameLayers& layers,
                    apps::ExrCompression compression, const std::filesystem::path& path,
                    bool overwrite)
{
    using apps::ExrChannel;
    std::vector<apps::ExrPart> parts{{"color", {}}};
    for (std::size_t i = 0; i < 3; ++i)
        parts[0].channels.push_back({.name = std::string(1, "RGB"[i]),
                                     .type = ExrChannel::Type::half,
                                     .first = picture.rgba.data() + i,
                                     .step = 4 * sizeof(std::uint16_t)});
    std::vector<std::vector<std::uint32_t>> widened;
    forEachLayer(layers, [&](Layer layer, const LayerForm& form) {
        parts.push_back(partOf(layers, layer, form, widened));
    });
    apps::writeExrParts(picture.size, parts, compression, path, overwrite);
}

void writeLayersNpz(const Radiance& picture, const render::FrameLayers& layers,
                    const std::filesystem::path& path, bool overwrite)
{
    const std::size_t width = picture.size.x;
    const std::size_t height = picture.size.y;
    std::vector<std::uint16_t> color(3 * width * height);
    for (std::size_t i = 0; i < width * height; ++i)
        std::memcpy(&color[3 * i], &picture.rgba[4 * i], 3 * sizeof(std::uint16_t));
    std::vector<apps::NumberArray> arrays{
        {"color", "<f2", {height, width, 3}, std::as_bytes(std::span(color))}};
    forEachLayer(layers, [&](Layer layer, const LayerForm& form) {
        std::vector<std::size_t> shape{height, width};
        if (form.channels > 1)
            shape.push_back(form.channels);
        arrays.push_back({std::string(form.name), numpyType(form.number), shape,
                          layers.arrays[static_cast<std::size_t>(layer)]});
    });
    apps::writeNpz(arrays, path, overwrite);
}

std::filesystem::path layerPath(const std::filesystem::path& path, render::Layer layer)
{
    std::filesystem::path own = path;
    return own.replace_extension("." + std::string(render::formOf(layer).name) + ".png");
}

void writeLayerPngs(const render::FrameLayers& layers, const std::filesystem::path& path,
                    bool overwrite)
{
    forEachLayer(layers, [&](Layer layer, const LayerForm&) {
        const Words words = wordsOf(layers, layer);
        apps::writePng16(layers.size, words.channels, words.values, layerPath(path, layer),
                         overwrite);
    });
}

} // namespace sward::view
