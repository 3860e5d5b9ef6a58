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

/// Throws Error{input} naming the line that is wrong, or what is missing: vertices with x, y and z,
/// faces or strips with a list of corners.
PlyHeader readPlyHeader(std::string_view file, const std::string& place);

} // namespace sward::terrain
