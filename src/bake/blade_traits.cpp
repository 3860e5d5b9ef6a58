#include "bake/blade_traits.h"

#include "bake/ground_color.h"
#include "bake/up_vector.h"
#include "core/exact_math.h"
#include "core/random.h"

#include <glm/geometric.hpp>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace sward::bake {
namespace {

constexpr double twoPi = 6.28318530717958648;

// The random numbers of one blade, its own and its clump's.
class Dice {
public:
    Dice(std::uint64_t seed, field::BladeKey key, const Clumps::Clump* clump)
        : seed_(seed)
        , own_(keyBits(key))
        , clump_(clump != nullptr ? clump->key : hashBits(seed, own_))
    {
    }

    double own(Dimension dimension) const
    {
        return uniform(seed_, own_, static_cast<std::uint32_t>(dimension));
    }

    double clump(Dimension dimension) const
    {
        return uniform(clump_, 0, static_cast<std::uint32_t>(dimension));
    }

    // Between the blade's own number and its clump's.
    double blended(Dimension dimension, double share) const
    {
        return own(dimension) + share * (clump(dimension) - own(dimension));
    }

    std::uint32_t clumpNumber() const
    {
        return static_cast<std::uint32_t>(hashBits(clump_, 1) & 255U);
    }
    std::uint32_t hash() const
    {
        return static_cast<std::uint32_t>(hashBits(seed_ + 1, own_) & 15U);
    }

private:
    std::uint64_t seed_;
    std::uint64_t own_;
    std::uint64_t clump_;
};

// Species by share: neighbours in a clump are mostly of one kind.
std::uint32_t chooseSpecies(const Meadow& meadow, const Dice& dice)
{
    double total = 0.0;
    for (const SpeciesTraits& species : meadow.species)
        total += species.share;
    const bool followsClump = dice.own(Dimension::clump) < meadow.species[0].clumping;
    double left =
        total * (followsClump ? dice.clump(Dimension::species) : dice.own(Dimension::species));
    for (std::size_t i = 0; i < meadow.species.size(); ++i) {
        left -= meadow.species[i].share;
        if (left < 0.0)
            return static_cast<std::uint32_t>(i);
    }
    return static_cast<std::uint32_t>(meadow.species.size() - 1);
}

double within(glm::dvec2 range, double share)
{
    return range.x + share * (range.y - range.x);
}

// Direction the blade leans to: outward from its clump's middle, more or less, else anywhere.
glm::dvec3 chooseFront(glm::dvec3 up, glm::dvec3 tangent, glm::dvec3 outward, double clumping,
                       const Dice& dice)
{
    glm::dvec3 middle = tangent;
    double spread = twoPi;
    const glm::dvec3 flat = outward - up * glm::dot(up, outward);
    const double squared = glm::dot(flat, flat);
    if (squared > 1e-12 * glm::dot(outward, outward) && squared > 0.0) {
        middle = flat / std::sqrt(squared);
        spread = twoPi * (1.0 - 0.6 * clumping);
    }
    const SinCos turn = exactSinCos((dice.own(Dimension::facing) - 0.5) * spread);
    return turn.cos * middle + turn.sin * glm::cross(up, middle);
}

// Turn of `axis` about `up` from the tangent frame that the decoder will use, in [0, 2π).
float facingOf(glm::vec3 up, glm::dvec3 axis)
{
    const glm::vec3 decoded = shared::decodeOctahedral(shared::encodeOctahedral(up));
    const double angle = exactAtan2(glm::dot(axis, glm::dvec3(shared::bitangentOf(decoded))),
                                    glm::dot(axis, glm::dvec3(shared::tangentOf(decoded))));
    return static_cast<float>(angle < 0.0 ? angle + twoPi : angle);
}

shared::Blade growBlade(const RootSample& root, float exposure, const terrain::GroundMesh& ground,
                        const BakeSettings& settings, double scale, const Clumps& clumps)
{
    const Clumps::Clump* clump = clumps.nearest(root.position);
    const Dice dice(settings.seed, keyOf(ground, root), clump);
    const std::uint32_t slot = chooseSpecies(settings.meadow, dice);
    const SpeciesTraits& species = settings.meadow.species[slot];

    const glm::uvec3 corners = ground.triangles[root.triangle];
    const glm::dvec3 place = ground.origin + glm::dvec3(root.position);
    const glm::dvec3 up =
        upVector(glm::dvec3(root.normal), settings.groundUp.at(place), settings.align);
    const glm::dvec3 tangent = surfaceTangent(up, glm::dvec3(ground.positions[corners.x]),
                                              glm::dvec3(ground.positions[corners.y]),
                                              glm::dvec3(ground.positions[corners.z]));
    const glm::dvec3 outward =
        clump != nullptr ? glm::dvec3(root.position) - glm::dvec3(clump->centre) : glm::dvec3(0.0);
    const glm::dvec3 front = chooseFront(up, tangent, outward, species.clumping, dice);

    shared::Blade blade;
    blade.root = root.position;
    blade.up = glm::vec3(up);
    blade.facing = facingOf(blade.up, glm::cross(front, up));
    blade.height = static_cast<float>(
        scale * within(species.height, dice.blended(Dimension::height, 0.7 * species.clumping)));
    blade.width = static_cast<float>(scale * within(species.width, dice.own(Dimension::width)));
    blade.stiffness = static_cast<float>(
        within(species.stiffness, dice.blended(Dimension::stiffness, 0.5 * species.clumping)));
    blade.exposure = exposure;
    blade.species = slot;
    blade.tint = groundColor(ground, root, !settings.masks.empty());
    blade.clump = dice.clumpNumber();
    blade.hash = dice.hash();
    return blade;
}

} // namespace

std::vector<shared::Blade> growBlades(const Roots& roots, const std::vector<float>& exposure,
                                      const terrain::GroundMesh& ground,
                                      const BakeSettings& settings, double scale,
                                      Progress& progress)
{
    const Clumps clumps(ground, settings.meadow.clumpSize * scale, settings.seed);
    std::vector<shared::Blade> blades(roots.size());
    progress.begin("traits", roots.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, roots.size(), 4096),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                          for (std::size_t i = range.begin(); i < range.end(); ++i)
                              blades[i] = growBlade(roots[i], exposure.empty() ? 1.0f : exposure[i],
                                                    ground, settings, scale, clumps);
                          progress.advance(range.size());
                      });
    return blades;
}

} // namespace sward::bake
