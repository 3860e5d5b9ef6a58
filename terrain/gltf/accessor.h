#pragma once

#include "terrain/gltf/model.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace sward::terrain {

/// Reads accessors of a glTF model checked by checkGltf(): interleaved, normalised integers,
/// sparse. `place` names the accessor's use in messages.
class GltfAccessor {
public:
    GltfAccessor(const GltfModel& model, int index, std::string place);

    std::size_t count() const { return accessor_.count; }
    std::size_t components() const { return accessor_.components; }
    /// Difference of neighbouring numbers of integers, normalised or not; 0 of floats.
    double step() const;

    bool isFloat() const { return accessor_.type == 5126; }
    bool isWord() const { return accessor_.type == 5125; }

    /// The index that restarts a strip in graphics APIs, which no index may be: 255 of bytes.
    std::uint32_t restartIndex() const;

    /// Throws Error{input} unless there are `low` to `high` components.
    void requireComponents(std::size_t low, std::size_t high) const;

    /// Passes all elements to `take(first, count, numbers)`, in blocks and from several threads.
    /// `numbers` has count × components entries, normalised integers in [0, 1] or [−1, 1]. Elements
    /// replaced by a sparse accessor are passed again after all others.
    using TakeNumbers = std::function<void(std::size_t, std::size_t, const float*)>;
    void eachNumbers(const TakeNumbers& take) const;

    /// The same as one array.
    std::vector<float> numbers() const;

    /// Unsigned integers, in the same way; blocks begin at a multiple of 3. Throws Error{input} for
    /// another type.
    using TakeIndices = std::function<void(std::size_t, std::size_t, const std::uint32_t*)>;
    void eachIndices(const TakeIndices& take) const;
    std::vector<std::uint32_t> indices() const;

private:
    template <typename Value, typename Read, typename Take>
    void gather(const Read& read, const Take& take) const;

    /// Pointer to byte `offset` of a buffer view; requires `size` bytes from there.
    const unsigned char* bytes(int view, std::uint64_t offset, std::size_t size) const;

    const GltfModel& model_;
    const GltfElements& accessor_;
    std::string place_;
    std::size_t componentSize_ = 0;
};

} // namespace sward::terrain
