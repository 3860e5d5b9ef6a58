#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace sward::apps {

/// An array as NumPy has it: little endian, the last index fastest.
struct NumberArray {
    std::string name;                 ///< in the archive; letters, digits, "-" and "_"
    std::string type;                 ///< NumPy's, such as "<f4", "<u8" or "|u1"
    std::vector<std::size_t> shape;   ///< the product is the number of elements
    std::span<const std::byte> bytes; ///< of all elements
};

/// The bytes of an .npy file, version 1.0.
std::vector<std::byte> npyBytes(const NumberArray& array);

/// Writes arrays into an .npz archive, stored without compression, whole or not at all. The bytes
/// depend on nothing else. Throws Error{io}; Error{runtime} if the archive would exceed 4 GiB.
void writeNpz(std::span<const NumberArray> arrays, const std::filesystem::path& path,
              bool overwrite);

} // namespace sward::apps
