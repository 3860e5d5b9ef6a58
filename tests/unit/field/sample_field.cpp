#include "unit/field/sample_field.h"

#include "core/random.h"

#include <glm/geometric.hpp>
#include <unistd.h>

namespace sward::tests {
namespace {

float number(std::uint64_t index, std::uint32_t dimension)
{
    return static_cast<float>(uniform(11, index, dimension));
}

shared::Patch patchAt(glm::vec3 low, std::uint32_t first, std::uint32_t count)
{
    shared::Patch patch = {};
    patch.boundsLow = low - glm::vec3(1.0f);
    patch.boundsHigh = low + glm::vec3(5.0f);
    patch.firstBlade = first;
    patch.bladeCount = count;
    patch.rootLow = low;
    patch.rootStep = 4.0f / 65535.0f;
    patch.coneAxis = glm::vec3(0, 1, 0);
    patch.coneCosine = -1.0f;
    patch.heightLow = 0.2f;
    patch.heightStep = 0.4f / 255.0f;
    patch.widthLow = 0.005f;
    patch.widthStep = 0.01f / 63.0f;
    patch.parent = 0;
    patch.firstChild = shared::noPatch;
    patch.level = 1;
    patch.rankLow = 0.5f;
    patch.rankHigh = 1.0f;
    return patch;
}

shared::Blade bladeOf(std::uint64_t index, glm::vec3 low)
{
    shared::Blade blade = {};
    blade.root = low + 4.0f * glm::vec3(number(index, 0), number(index, 1), number(index, 2));
    blade.up = glm::normalize(glm::vec3(number(index, 3) - 0.5f, 0.6f, number(index, 4) - 0.5f));
    blade.facing = shared::twoPi * number(index, 5);
    blade.height = 0.2f + 0.4f * number(index, 6);
    blade.width = 0.005f + 0.01f * number(index, 7);
    blade.stiffness = number(index, 8);
    blade.exposure = number(index, 9);
    blade.species = static_cast<std::uint32_t>(index % 2);
    blade.tint = glm::vec3(0.4f, 0.5f, 0.2f);
    blade.clump = static_cast<std::uint32_t>(index % 256);
    return blade;
}

} // namespace

field::Field sampleField(std::uint32_t bladesPerPatch)
{
    field::Field field;
    field.origin = glm::dvec3(1e6, -64.0, 32.0);
    const glm::vec3 lows[] = {glm::vec3(0.0f), glm::vec3(0, 0, 0), glm::vec3(4, 0, 0)};
    for (std::uint32_t p = 0; p < 3; ++p) {
        field.patches.push_back(patchAt(lows[p], p * bladesPerPatch, bladesPerPatch));
        for (std::uint32_t i = 0; i < bladesPerPatch; ++i) {
            const std::uint32_t index = p * bladesPerPatch + i;
            field.blades.push_back(shared::packBlade(bladeOf(index, lows[p]), field.patches[p]));
            field.keys.push_back({index % 2, index});
        }
    }
    shared::Patch& root = field.patches[0];
    root.parent = shared::noPatch;
    root.level = 0;
    root.firstChild = 1;
    root.childCount = 2;
    root.rankLow = 0.0f;
    root.rankHigh = 0.5f;

    shared::Species look = {glm::vec3(0.1f),
                            0.5f,
                            glm::vec3(0.3f),
                            0.5f,
                            0.5f,
                            0.5f,
                            0.5f,
                            0.1f,
                            shared::shapeQuadratic,
                            0.25f,
                            0,
                            0};
    field.species = {{"grass", look}, {"clover", look}};
    const glm::vec3 corners[] = {{0, 0, 0}, {8, 0, 0}, {8, 0, 8}, {0, 0, 8}};
    for (const glm::vec3& corner : corners)
        field.ground.vertices.push_back({corner, shared::encodeNormal32(glm::vec3(0, 1, 0)),
                                         glm::vec2(corner.x, corner.z), 0xffffffffU});
    field.ground.indices = {0, 2, 1, 0, 3, 2};
    field.ground.ranges = {{0, 0, 0, 6}};
    field.ground.materials = {{glm::vec4(1.0f), 0.9f, 0.0f, 0, 0}};
    field.ground.images = {{2, 2, std::vector<std::uint8_t>(16, 128)}};
    field.defaults.cameras.push_back({"front", glm::dvec3(1e6, 2, 9), glm::dvec3(1e6, 0, 0)});
    field.provenance = R"({"tool":"test"})";
    field.copyright = "CC0";
    return field;
}

std::filesystem::path temporaryFile(const std::string& name)
{
    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("sward-field-" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder);
    return folder / name;
}

} // namespace sward::tests
