#pragma once

#include "core/bounds.h"
#include "terrain/vertex_attributes.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace sward::terrain {

struct ChannelImage;

/// An image for display: 8 bits, red, green, blue, alpha, sRGB colour, rows from the top.
struct GroundImage {
    std::string name;
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<std::uint8_t> rgba; ///< 4·width·height

    /// Channels as the file has them, for masks: of more pixels or bits than `rgba`, else null.
    std::array<std::shared_ptr<const ChannelImage>, 4> stored{};
};

/// What an image shows outside [0, 1].
enum class ImageWrap : std::uint8_t {
    repeat, ///< repeated
    clamp,  ///< its edge
    mirror  ///< repeated, every other copy mirrored
};

struct GroundMaterial {
    static constexpr std::uint32_t noImage = 0xffffffffU;

    std::string name;
    glm::vec4 baseColor{0.085f, 0.078f, 0.036f, 1.0f}; ///< linear, multiplies the image; earth
    float roughness = 1.0f;                            ///< [0, 1]
    float metallic = 0.0f;                             ///< [0, 1]
    std::uint32_t image = noImage;                     ///< base colour image
    ImageWrap wrapU = ImageWrap::repeat;               ///< along u
    ImageWrap wrapV = ImageWrap::repeat;               ///< along v
    bool doubleSided = false;                          ///< the back is drawn too
    bool srgbColors = false;   ///< vertex colours are stored as images are, else linear
    float alphaCutoff = -1.0f; ///< no ground where its alpha is below; −1: no cut-outs
};

/// The cells of ground that is a grid of heights, with which rays are cheap. Their corners lie
/// where lines of equal x and of equal z meet. A cell has an upper triangle, whose corners are its
/// north-west (least x and z), south-west and north-east, and a lower one: north-east, south-west,
/// south-east; one or both may be missing.
struct HeightCells {
    static constexpr std::uint32_t upper = 1; ///< flags of a cell
    static constexpr std::uint32_t lower = 2;

    glm::dvec2 first{0.0}; ///< [m] x and z of the first corner from the ground's origin
    glm::dvec2 step{1.0};  ///< [m] between lines
    glm::uvec2 count{0U};  ///< along x and z

    /// Of each cell, by rows along x: 4 times its first triangle, plus flags. A lower triangle
    /// follows an upper one. All triangles of the ground are here.
    std::vector<std::uint32_t> triangles;
};

/// The ground: an indexed triangle soup in world space, Y up, metres. It need not be manifold,
/// closed or connected. Corners of a triangle turn anti-clockwise seen from its front.
///
/// World position = `origin` + position. The origin is a multiple of 32 m near the centre of the
/// bounds (0 for ground around the world's origin). So positions keep millimetre precision in
/// single precision everywhere, and cells of a world grid of 32·2ⁿ m share the same planes.
struct GroundMesh {
    glm::dvec3 origin{0.0};

    // Per vertex; `normals` (unit), `uvs` and `colors` have one entry per position.
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<glm::vec2> uvs;    ///< (0, 0) at the image's upper left corner
    std::vector<glm::vec4> colors; ///< as stored, [0, 1]; (1, 1, 1, 1) where the file has none

    VertexAttributes attributes; ///< further ones, only those that masks read

    // Per triangle.
    std::vector<glm::uvec3> triangles;
    std::vector<std::uint32_t> materialOf; ///< index into `materials`
    std::vector<std::uint32_t> nodeOf;     ///< index into `nodes`
    std::vector<std::uint8_t> bears;       ///< 1: may bear grass; 0: blocks rays and is shown only
    std::vector<std::uint32_t> sourceOf;   ///< number in the whole ground, rising; empty: equal

    std::vector<GroundMaterial> materials; ///< at least one
    std::vector<GroundImage> images;
    std::vector<std::string> nodes; ///< names; the path "parent/child" for nested nodes
    std::string mapSystem; ///< coordinate system of the world as WKT: x east, z south; or empty
    std::string copyright; ///< glTF asset.copyright, passed on to exports

    std::shared_ptr<const HeightCells> heightCells; ///< null: not known to be a grid

    /// Step of the points taken of a finer ground, which it stands for (MapSurvey). 1: the ground
    /// itself.
    std::uint32_t overview = 1;

    double precision = 0.0; ///< [m] to which vertices of open edges are taken for one; 0: exact
    bool hasPlace = false;  ///< of a map that says where it lies: nothing may move it
    bool hasColors = false; ///< some vertex has a colour in the file
    bool hasNormals =
        false; ///< every vertex had a usable normal in the file; else topology makes them

    Aabb bounds() const;

    /// Number of a triangle in the whole ground; equals the index unless this is a part.
    std::uint32_t source(std::size_t triangle) const
    {
        return sourceOf.empty() ? static_cast<std::uint32_t>(triangle) : sourceOf[triangle];
    }

    /// Area of triangle `index` in double precision [m²].
    double area(std::size_t index) const;

    /// Unit normal of triangle `index` from its corners; 0 if it has no area.
    glm::dvec3 faceNormal(std::size_t index) const;
};

/// Throws Error{input} naming `place` if arrays differ in length, an index is out of range, a
/// number is not finite, a coordinate is out of reach (reach.h), or no triangle has an area. Every
/// importer and generator calls it last.
void validate(const GroundMesh& mesh, const std::string& place);

/// Appends `other`, shifted to the origin of `mesh`. Both must be of one coordinate system, or one
/// of none: then the other's holds.
void append(GroundMesh& mesh, const GroundMesh& other);

/// The origin for ground with these bounds in world space: their centre, rounded to 32 m.
glm::dvec3 originFor(const DAabb& worldBounds);

} // namespace sward::terrain
