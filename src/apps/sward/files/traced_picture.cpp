#include "apps/sward/files/traced_picture.h"

#include "apps/common/picture/exr_file.h"
#include "apps/common/picture/png_file.h"
#include "core/math/srgb.h"
#include "shaders/shared/look/film_curve.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace sward::apps {
namespace {

// Radiance times exposure that the film shows as 18 % grey.
constexpr double exposedGrey = 0.163;

void addColor(std::vector<ExrChannel>& channels, const std::string& prefix, const char* letters,
              const std::vector<glm::vec3>& values)
{
    for (std::size_t i = 0; i < 3; ++i)
        channels.push_back({.name = prefix + letters[i],
                            .first = reinterpret_cast<const float*>(values.data()) + i,
                            .step = sizeof(glm::vec3)});
}

} // namespace

void writeTracedExr(const trace::Layers& picture, glm::uvec2 size,
                    const std::vector<std::string>& layers, const std::string& path, bool overwrite)
{
    std::vector<ExrChannel> channels;
    addColor(channels, "", "RGB", picture.color);
    for (const std::string& layer : layers) {
        const std::string prefix = layer + ".";
        if (layer == "albedo")
            addColor(channels, prefix, "RGB", picture.albedo);
        else if (layer == "normal")
            addColor(channels, prefix, "XYZ", picture.normal);
        else if (layer == "depth")
            channels.push_back({.name = prefix + "Z", .first = picture.depth.data()});
        else if (layer == "blade")
            channels.push_back({.name = prefix + "id",
                                .type = ExrChannel::Type::whole,
                                .first = picture.surface.data()});
        else if (layer == "direct")
            addColor(channels, prefix, "RGB", picture.direct);
        else if (layer == "indirect")
            addColor(channels, prefix, "RGB", picture.indirect);
        else if (layer == "visibility")
            channels.push_back({.name = prefix + "Y", .first = picture.sunVisibility.data()});
        else if (layer == "sun")
            addColor(channels, prefix, "RGB", picture.sun);
        else if (layer == "sky")
            addColor(channels, prefix, "RGB", picture.sky);
    }
    writeExr(size, channels, path, overwrite);
}

void writeTracedPng(const trace::Layers& picture, glm::uvec2 size, double exposure,
                    const std::string& path, bool overwrite)
{
    std::vector<std::uint8_t> rgb;
    rgb.reserve(3 * picture.color.size());
    for (const glm::vec3& color : picture.color) {
        const glm::vec3 film = shared::filmOf(static_cast<float>(exposure) * color);
        for (glm::length_t i = 0; i < 3; ++i)
            rgb.push_back(static_cast<std::uint8_t>(255.0f * encodedOf(film[i]) + 0.5f));
    }
    writePng(size, rgb, path, overwrite);
}

double exposureOf(const trace::Layers& picture)
{
    double surfaces = 0.0;
    double all = 0.0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < picture.color.size(); ++i) {
        const double luminance =
            double(glm::dot(picture.color[i], glm::vec3(0.2126f, 0.7152f, 0.0722f)));
        all += luminance;
        if (picture.surface[i] == trace::noSurface)
            continue;
        surfaces += luminance;
        ++count;
    }
    const double mean = count > 0 ? surfaces / double(count)
                                  : all / double(std::max<std::size_t>(picture.color.size(), 1));
    return std::clamp(mean > 0.0 ? exposedGrey / mean : 1.0, 1e-4, 1e4);
}

} // namespace sward::apps
