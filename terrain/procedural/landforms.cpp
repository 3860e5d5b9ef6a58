#include "terrain/procedural/landforms.h"

#include <cmath>

namespace sward::terrain {

GroundMesh makeHills(const HillsSettings& settings)
{
    GroundMesh mesh = heightfield(settings.grid, [&](double x, double z) {
        // Avoid the lattice plane y = 0, where gradient noise is flatter.
        const glm::dvec3 point(x / settings.width, 0.37, z / settings.width);
        return settings.height * fractalNoise(settings.seed, point, settings.octaves);
    });
    mesh.materials[0] = {.name = "soil", .baseColor = glm::vec4(0.085f, 0.078f, 0.036f, 1.0f)};
    mesh.nodes[0] = "hills";
    return mesh;
}

GroundMesh makeDunes(const DunesSettings& settings)
{
    // Share of the spacing on the windward side; the rest is the lee.
    constexpr double windward = 0.72;
    const Octaves broad{.count = 2, .lacunarity = 2.0, .gain = 0.5};
    GroundMesh mesh = heightfield(settings.grid, [&](double x, double z) {
        // Bend the crests and vary their height along their length.
        const glm::dvec3 place(x / (4.0 * settings.spacing), 0.37, z / (1.5 * settings.spacing));
        const double swing = settings.wander * fractalNoise(settings.seed, place, broad);
        const double size = 0.7 + 0.6 * fractalNoise(settings.seed + 1, place, broad);

        // Rise smoothly to the crest, then fall.
        const double position = (x + swing) / settings.spacing;
        const double phase = position - std::floor(position);
        const double share = phase < windward ? phase / windward : (1.0 - phase) / (1.0 - windward);
        return settings.height * size * share * share * (3.0 - 2.0 * share);
    });
    mesh.materials[0] = {.name = "sand", .baseColor = glm::vec4(0.48f, 0.37f, 0.21f, 1.0f)};
    mesh.nodes[0] = "dunes";
    return mesh;
}

} // namespace sward::terrain
