#pragma once

#include <glm/mat4x4.hpp>

#include <filesystem>
#include <string>
#include <string_view>

namespace sward::apps {

/// A rotation with uniform scale and a translation, from a JSON file in one of these forms:
///
///   {"matrix": M} or M alone, where M is
///       four rows of four numbers, or three rows of three (a rotation), or
///       sixteen numbers column by column, as glTF writes them;
///   {"rotation": [x, y, z, w], "translation": [x, y, z], "scale": s}, each may be left out.
///
/// Throws Error{io} if the file cannot be read, Error{input} if it is none of these, or shears,
/// mirrors, or scales unevenly.
glm::dmat4 readTransform(const std::filesystem::path& path);

/// The same from a text; messages name `place`.
glm::dmat4 parseTransform(std::string_view text, const std::string& place);

} // namespace sward::apps
