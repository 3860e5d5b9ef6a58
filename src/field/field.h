#pragma once

#include "core/bounds.h"
#include "core/uninitialized.h"
#include "field/wind.h"
#include "shaders/shared/blade.h"
#include "shaders/shared/ground.h"
#include "shaders/shared/patch.h"
#include "shaders/shared/physics.h"
#include "shaders/shared/species.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sward::field {

/// Where a blade comes from: the triangle of the input and the number of the try on it.
struct BladeKey {
    std::uint32_t triangle = 0;
    std::uint32_t candidate = 0;
};

/// The blade's name outside the field, the same for the same triangle and try whatever else
/// changes: a hash of both, below 2⁵³ so that every program can read it as a number.
std::uint64_t bladeId(BladeKey key);

/// Names of the shapes of a blade, shared::shapeTriangleTip … shapeDandelion.
inline constexpr std::array<std::string_view, shared::shapeCount> shapeNames{
    "triangle-tip", "quad", "triangle", "quadratic", "dandelion"};

struct Species {
    std::string name;
    shared::Species look = {};
};

struct Camera {
    std::string name = "camera";
    glm::dvec3 eye{0.0};    ///< world [m]
    glm::dvec3 target{0.0}; ///< world [m]
    glm::vec3 up{0.0f, 1.0f, 0.0f};
    float fovY = 45.0f; ///< [degrees]
};

/// What a viewer starts with. Directions and attractor are in world space.
struct Defaults {
    Wind wind;
    glm::vec3 gravityDirection{0.0f, -1.0f, 0.0f};
    glm::dvec3 attractor{0.0};    ///< world [m]
    float gravityStrength = 6.5f; ///< [1/s] heights per second
    float attractorBlend = 0.0f;  ///< [0, 1]
    float recovery = 6.0f;        ///< [1/s]
    float drawDistance = 1e9f;    ///< [m]
    std::vector<Camera> cameras;
};

struct Image {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<std::uint8_t> rgba; ///< 4·width·height, sRGB, rows from the top
};

/// Triangles of one material at one level of detail (0 is the finest).
struct GroundRange {
    std::uint32_t level = 0;
    std::uint32_t material = 0;
    std::uint32_t firstIndex = 0;
    std::uint32_t indexCount = 0;
};

/// The ground as it is drawn; it bears nothing any more.
struct DisplayGround {
    std::vector<shared::GroundVertex> vertices;
    std::vector<std::uint32_t> indices;
    std::vector<GroundRange> ranges;
    std::vector<shared::GroundMaterial> materials;
    std::vector<Image> images;
};

/// A meadow, baked: the only bridge between the offline half and the running half.
struct Field {
    glm::dvec3 origin{0.0};             ///< world = origin + position
    std::vector<shared::Patch> patches; ///< [0] is the root of the tree; parents before children
    UninitializedVector<shared::PackedBlade> blades; ///< patch after patch, in progressive order
    UninitializedVector<BladeKey> keys;              ///< one per blade
    std::vector<Species> species;                    ///< 1 to 8
    DisplayGround ground;
    Defaults defaults;
    std::string provenance = "{}"; ///< JSON: tool version, input hash, settings, seed
    std::string copyright;
};

/// A verified field that lies elsewhere, usually in a mapped file.
struct FieldView {
    glm::dvec3 origin{0.0};
    std::span<const shared::Patch> patches;
    std::span<const shared::PackedBlade> blades;
    std::span<const BladeKey> keys;
    std::span<const Species> species;
    const DisplayGround* ground = nullptr;   ///< never null
    const Defaults* defaults = nullptr;      ///< never null
    const std::string* provenance = nullptr; ///< never null
    const std::string* copyright = nullptr;  ///< never null

    /// Box of everything that can be seen, relative to the origin; empty if there is nothing.
    Aabb bounds() const;
};

FieldView viewOf(const Field& field);

/// Patch index of each blade.
std::vector<std::uint32_t> patchOfBlades(const FieldView& field);

} // namespace sward::field
