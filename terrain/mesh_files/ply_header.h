#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sward::terrain {

struct PlyType {
    std::string_view name;
    std::size_t size = 0; ///< bytes in a binary file
    bool isFloat = false;
    bool isSigned = false;
};

struct PlyProperty {
    std::string name;
    PlyType type{};
    std::optional<PlyType> length; ///< of a list

    /// The list of a face's corners.
    bool isCorners() const
    {
        return length && (name == "vertex_indices" || name == "vertex_index");
    }
};

struct PlyElement {
    std::string name;
    std::size_t count = 0;
    std::vector<PlyProperty> properties;
};

struct PlyHeader {
    enum class Format { text, littleEndian, bigEndian };

    Format format = Format::text;
    std::vector<PlyElement> elements;
    std::string_view rest; ///< the file after the header
};

/// Throws Error{input} naming the line that is wrong.
PlyHeader readPlyHeader(std::string_view file, const std::string& place);

/// Whether OpenMesh's reader is given a property; it fails at many others. scanPly() reads colours
/// and texture coordinates.
bool isNeeded(const PlyElement& element, const PlyProperty& property);

/// Whether a property is a coordinate x, y or z.
bool isCoordinate(const PlyProperty& property);

/// Whether OpenMesh's reader takes the order of the elements and the types of the needed properties
/// as they are. It wants vertices before faces, coordinates of floats and indices of 32 bits, and
/// knows no strips.
bool isPlain(const PlyHeader& header);

/// The header in standard keywords with the needed properties only; OpenMesh's reader loops forever
/// on some others.
std::string plainPlyHeader(const PlyHeader& header);

/// A header of a binary little-endian file with vertices, whose coordinates are doubles, then faces
/// whose lists have lengths and indices of int.
std::string orderlyPlyHeader(const PlyHeader& header, std::size_t faces);

} // namespace sward::terrain
