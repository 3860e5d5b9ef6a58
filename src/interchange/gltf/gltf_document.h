#pragma once

#include "core/bounds.h"

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace sward::interchange {

/// Description of an accessor.
struct GltfAccessor {
    std::size_t view = 0;
    std::uint64_t offset = 0; ///< in the view [bytes]
    int componentType = 5126;
    std::string type = "SCALAR";
    std::uint64_t count = 0;
    bool normalized = false;
    std::optional<Aabb> bounds = std::nullopt; ///< least and largest of a VEC3
};

/// A view that meshoptimizer's attribute codec has compressed.
struct CompressedView {
    std::uint64_t stored = 0; ///< bytes in the file
    std::uint64_t count = 0;  ///< elements
    std::uint64_t stride = 0; ///< of a decoded element [bytes]
    std::string filter;       ///< EXPONENTIAL, QUATERNION, OCTAHEDRAL or NONE
};

/// The JSON of a glTF with one buffer, and the first part of that buffer. Large views are only
/// reserved; their bytes follow in the order of reservation. Compressed views stand for a second
/// buffer that no file holds.
class GltfDocument {
public:
    /// `copyright` may be empty.
    GltfDocument(const std::string& generator, const std::string& copyright);
    GltfDocument(const GltfDocument&) = delete;
    GltfDocument& operator=(const GltfDocument&) = delete;
    ~GltfDocument();

    /// A view of `bytes`, copied. `target`: 34962 vertices, 34963 indices, 0 anything else.
    std::size_t addView(std::span<const std::byte> bytes, int target);

    /// Reserves a view of `bytes` (a multiple of four) written later; no addView() after it.
    std::size_t reserveView(std::uint64_t bytes);

    /// Reserves the bytes of a compressed view, filled with zeros to a multiple of four.
    /// `extension`: EXT_meshopt_compression or KHR_meshopt_compression, the same for all views; the
    /// caller requires it.
    std::size_t reserveCompressedView(const CompressedView& view, const std::string& extension);

    std::size_t addAccessor(const GltfAccessor& accessor);

    /// Adds a vertex attribute or an index array in its own view.
    template <typename T>
    std::size_t addArray(std::span<const T> values, GltfAccessor accessor, int target)
    {
        accessor.view = addView(std::as_bytes(values), target);
        accessor.count = values.size();
        return addAccessor(accessor);
    }

    /// Appends to the top-level array `name` and returns the index.
    std::size_t add(const char* name, nlohmann::ordered_json element);

    /// Names an extension that a reader must know.
    void require(const std::string& extension);

    /// Makes the node the only one of the only scene.
    void setScene(std::size_t node);

    std::span<const std::byte> fixedBytes() const { return fixed_; }
    std::uint64_t binaryBytes() const { return binaryBytes_; }

    /// The JSON, filled with spaces to a multiple of four bytes.
    std::string text() const;

private:
    std::size_t placeView(std::uint64_t bytes, int target);

    std::unique_ptr<nlohmann::ordered_json> json_;
    std::vector<std::byte> fixed_;
    std::uint64_t binaryBytes_ = 0;
    std::uint64_t decodedBytes_ = 0;   ///< of the second buffer
    std::string compressionExtension_; ///< of compressed views; empty without any
};

inline constexpr int gltfVertices = 34962;
inline constexpr int gltfIndices = 34963;

} // namespace sward::interchange
