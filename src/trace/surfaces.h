#pragma once

#include "field/field.h"
#include "field/poses/blade_poses.h"
#include "field/poses/blade_rows.h"
#include "shaders/shared/cover.h"
#include "shaders/shared/look/leaf_finish.h"
#include "trace/leaf.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cstdint>
#include <optional>
#include <vector>

namespace sward::trace {

/// What a ray may meet.
enum class Part : std::uint32_t { blades = 0, ground = 1 };

/// The number that a picture shows where it shows no blade; blade n of the field is firstBlade + n.
inline constexpr std::uint32_t noSurface = 0;
inline constexpr std::uint32_t groundSurface = 1; ///< likewise
inline constexpr std::uint32_t firstBlade = 2;    ///< likewise

/// The blades and the ground of a field as geometry with colours. Places are relative to the
/// field's origin.
struct Surfaces {
    /// The strip of a blade.
    struct Strip {
        std::uint32_t firstQuad = 0;
        std::uint32_t firstRow = 0;                 ///< of `along`
        std::uint32_t blade = 0;                    ///< index in the field
        std::uint32_t columns = 1;                  ///< quads of a row: 2 if the blade is folded
        std::uint32_t finish = shared::finishPlain; ///< shared::finishOf() its look
        std::uint32_t seed = 0;                     ///< of the blade
        glm::vec3 root{0.0f};                       ///< colours, linear
        glm::vec3 tip{0.0f};                        ///< likewise
        float translucency = 0.0f;                  ///< [0, 1]
        float gloss = 0.0f;                         ///< [0, 1]
    };

    Surfaces() = default;
    Surfaces(Surfaces&&) noexcept = default;            ///< `cover` stays valid
    Surfaces& operator=(Surfaces&&) noexcept = default; ///< likewise

    std::vector<glm::vec3> points;        ///< of blades; one more at the end, for Embree
    std::vector<glm::uvec4> quads;        ///< left, right, right and left one row on
    std::vector<std::uint32_t> quadStrip; ///< strip of each quad
    std::vector<Strip> strips;            ///< one for each blade with an area
    std::vector<float> along;             ///< [0, 1] of each row

    std::vector<glm::vec3> groundPoints;           ///< one more at the end, for Embree
    std::vector<glm::uvec3> groundTriangles;       ///< corners
    std::vector<glm::vec3> groundColors;           ///< linear albedo, one for each point
    std::vector<glm::vec2> groundUvs;              ///< one for each point
    std::vector<std::uint32_t> groundMaterials;    ///< of each triangle
    std::vector<shared::GroundMaterial> materials; ///< as DisplayGround::materials
    std::vector<field::Image> images;              ///< as DisplayGround::images
    shared::Cover cover = {};                      ///< undergrowth on the ground …
    std::vector<std::uint32_t> grass;              ///< … with its table
};

/// From where a picture is taken. Outline and curve of a blade may stray by pixelShare of a pixel,
/// if that is more than SurfaceSettings::errors.
struct Seen {
    glm::vec3 eye{0.0f}; ///< [m] relative to the field's origin
    float pixel = 0.0f;  ///< [m] of a pixel at 1 m distance, ≥ 0
};
inline constexpr float pixelShare = 0.1f; ///< see Seen

/// How exact the geometry is, and which factors of a field's look a picture has.
struct SurfaceSettings {
    float gloss = 1.0f;         ///< [0, 1] factor of the species' gloss
    float translucency = 1.0f;  ///< [0, 1] factor of the species' translucency
    float thatch = 1.0f;        ///< [0, 1] as render::FrameSettings::thatch
    field::RowErrors errors{};  ///< of strips; more where far away
    std::optional<Seen> seen{}; ///< from where; unset: nothing is far away
};

/// `poses`: one for each blade. Throws Error{runtime} if the field has too many quads for one
/// scene.
Surfaces surfacesOf(const field::FieldView& field, const std::vector<field::BladePose>& poses,
                    const SurfaceSettings& settings);

/// The ground alone, without undergrowth: for rays.
Surfaces groundOf(const field::FieldView& field);

/// The scattering of a place of a blade, `place` −1 … 1 across and 0 … 1 along it, with its veins.
Leaf leafAt(const Surfaces::Strip& strip, glm::vec2 place);

/// Albedo of the ground: of its material, image and vertices, with undergrowth on it.
glm::vec3 groundAlbedo(const Surfaces& surfaces, std::uint32_t triangle, glm::vec3 shares);

} // namespace sward::trace
