#pragma once

#include <glm/vec4.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace sward::terrain {

/// Name, among attributes, of the coordinates at which a material shows its own image: those of
/// GroundMesh::uvs.
inline constexpr const char* materialCoordinates = "MATERIAL_TEXCOORD";

/// What the masks of a bake read of the ground.
struct MaskInputs {
    std::vector<std::string> attributes{}; ///< by their names in glTF, and materialCoordinates
    std::uint32_t imageChannels = 0;       ///< bit c: channel c of the materials' own images
};

/// A vertex attribute that a mask reads and that is not in GroundMesh::uvs or colors.
struct VertexAttribute {
    std::string name;              ///< as in glTF: TEXCOORD_1, COLOR_1, _MASK
    std::uint32_t components = 4;  ///< the fewest that a part of the file gives, 1 to 4
    std::vector<glm::vec4> values; ///< per vertex; 1 where there is none
};

/// Consecutive triangles of a part of the file that lacks an attribute which a mask reads.
struct AttributeGap {
    std::string attribute;
    std::uint32_t first = 0; ///< triangle
    std::uint32_t end = 0;   ///< behind the last
    std::uint32_t part = 0;  ///< index into VertexAttributes::parts
};

/// Vertex attributes for masks, and where the file has none.
struct VertexAttributes {
    std::vector<VertexAttribute> list;
    std::vector<AttributeGap> gaps;
    std::vector<std::string> parts; ///< of the file, named for messages

    /// The attribute of this name; null if the ground keeps it in uvs or colors, or has none.
    const VertexAttribute* find(const std::string& name) const;

    /// The entry of this name; a new one has 4 components and no values.
    VertexAttribute& entry(const std::string& name);

    /// Adds a gap, or extends the one that ends at `first`.
    void addGap(const std::string& attribute, std::size_t first, std::size_t end,
                const std::string& part);

    /// Adds gaps over all triangles of generated ground, which has texture coordinates alone.
    void addGeneratedGaps(const MaskInputs& read, std::size_t triangles, const std::string& part);

    /// Appends the gaps of `other`, whose triangles begin at `firstTriangle` here.
    void appendGaps(const VertexAttributes& other, std::size_t firstTriangle);

    /// Gives every attribute a value for each of `count` vertices, 1 for new ones.
    void resize(std::size_t count);

    /// Appends a copy of a vertex.
    void copyVertex(std::size_t vertex);

    /// Keeps vertex i if `newIndex[i]` is not `dropped`; the order stays.
    void keep(const std::vector<std::uint32_t>& newIndex, std::uint32_t dropped);
};

} // namespace sward::terrain
