#include "bake/filter/plain_masks.h"

#include "bake/mask/sample_places.h"

#include <algorithm>

namespace sward::bake {
namespace {

constexpr std::uint64_t plainPlaces = 16384;
constexpr double nearly = 1e-3; // of white and black

// The least and the greatest value of a mask that have been met.
struct MaskSpan {
    double low = 1.0;
    double high = 0.0;

    void add(double value)
    {
        low = std::min(low, value);
        high = std::max(high, value);
    }
    bool isWhite() const { return low >= 1.0 - nearly; }
    bool isBlack() const { return high <= nearly; }
    bool isPlain() const { return isWhite() || isBlack(); }
};

MaskSpan spanOf(const Mask& mask, const terrain::GroundMesh& ground)
{
    MaskSpan span;
    bool isEmpty = true;
    forEachPlace(ground, plainPlaces, [&](const RootSample& root) {
        span.add(mask.at(ground, root));
        isEmpty = false;
        return span.isPlain();
    });
    // Colours have their extremes at corners.
    for (std::uint32_t t = 0;
         mask.source == Mask::Source::vertexColor && span.isPlain() && t < ground.triangles.size();
         ++t)
        for (const glm::vec2 corner :
             {glm::vec2(0.0f, 0.0f), glm::vec2(1.0f, 0.0f), glm::vec2(0.0f, 1.0f)})
            if (ground.bears[t] != 0) {
                RootSample root{};
                root.triangle = t;
                root.barycentric = corner;
                span.add(mask.at(ground, root));
            }
    if (isEmpty)
        span = {0.0, 1.0};
    return span;
}

void warnOfPlain(const std::vector<Mask>& masks, const std::string& owner,
                 const terrain::GroundMesh& ground, Diagnostics& diagnostics)
{
    for (const Mask& mask : masks) {
        if (mask.source == Mask::Source::groundGreen)
            continue;
        if (mask.image != nullptr && mask.image->transparent > 0)
            diagnostics.warn("{} {}: {:.3g} % of its pixels are transparent and not black; alpha "
                             "hides nothing of another channel: make them black where no grass is "
                             "wanted, or add a mask of channel A",
                             owner, textOf(mask),
                             100.0 * double(mask.image->transparent) /
                                 double(mask.image->values.size()));
        const MaskSpan span = spanOf(mask, ground);
        if (span.isWhite())
            diagnostics.warn("{} {} rejects nothing: it is white on all ground that bears grass",
                             owner, textOf(mask));
        else if (span.isBlack())
            diagnostics.warn("{} {} rejects everything: it is black on all ground that bears grass",
                             owner, textOf(mask));
    }
}

} // namespace

void warnOfPlainMasks(const terrain::GroundMesh& ground, const BakeSettings& settings,
                      Diagnostics& diagnostics)
{
    warnOfPlain(settings.masks, "--mask", ground, diagnostics);
    for (const SpeciesTraits& species : settings.meadow.species)
        warnOfPlain(species.habitat.masks, fmt::format("species {}: mask", species.name), ground,
                    diagnostics);
}

} // namespace sward::bake
