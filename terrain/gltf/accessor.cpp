#include "terrain/gltf/accessor.h"

#include "core/error.h"
#include "terrain/blocks.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace sward::terrain {
namespace {

constexpr std::size_t maxComponents = 4;   // of any attribute used
constexpr std::size_t blockSize = 3 * 512; // elements that a thread reads at a time

template <typename Value>
using Block = std::array<Value, blockSize * maxComponents>;

template <typename Value>
Value load(const unsigned char* bytes)
{
    Value value;
    std::memcpy(&value, bytes, sizeof value);
    return value;
}

// glTF 2.0, 3.6.2.2: how a normalised integer becomes a number.
float readNumber(const unsigned char* bytes, int type, bool normalized)
{
    switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE: {
        const auto value = static_cast<float>(load<std::int8_t>(bytes));
        return normalized ? std::max(value / 127.0f, -1.0f) : value;
    }
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: {
        const auto value = static_cast<float>(load<std::uint8_t>(bytes));
        return normalized ? value / 255.0f : value;
    }
    case TINYGLTF_COMPONENT_TYPE_SHORT: {
        const auto value = static_cast<float>(load<std::int16_t>(bytes));
        return normalized ? std::max(value / 32767.0f, -1.0f) : value;
    }
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: {
        const auto value = static_cast<float>(load<std::uint16_t>(bytes));
        return normalized ? value / 65535.0f : value;
    }
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return static_cast<float>(load<std::uint32_t>(bytes));
    default:
        return load<float>(bytes);
    }
}

std::uint32_t readIndex(const unsigned char* bytes, int type)
{
    switch (type) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return load<std::uint8_t>(bytes);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return load<std::uint16_t>(bytes);
    default:
        return load<std::uint32_t>(bytes);
    }
}

std::size_t sizeOf(int type)
{
    return static_cast<std::size_t>(
        std::max(tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(type)), 0));
}

} // namespace

GltfAccessor::GltfAccessor(const GltfModel& model, int index, std::string place)
    : model_(model)
    , accessor_(model.structure.accessors.at(static_cast<std::size_t>(index)))
    , place_(std::move(place))
    , components_(static_cast<std::size_t>(std::max(
          tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor_.type)), 0)))
    , componentSize_(sizeOf(accessor_.componentType))
{
}

double GltfAccessor::step() const
{
    if (isFloat() || !accessor_.normalized)
        return isFloat() ? 0.0 : 1.0;
    switch (accessor_.componentType) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
        return 1.0 / 127.0;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return 1.0 / 255.0;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
        return 1.0 / 32767.0;
    default:
        return 1.0 / 65535.0;
    }
}

void GltfAccessor::requireComponents(std::size_t low, std::size_t high) const
{
    if (components_ < low || components_ > high)
        fail(ErrorKind::input, "{}: {} components per element, outside [{}, {}]", place_,
             components_, low, high);
}

const unsigned char* GltfAccessor::bytes(int view, std::size_t offset, std::size_t size) const
{
    const auto own = model_.view(static_cast<std::size_t>(view));
    if (offset > own.size() || size > own.size() - offset)
        fail(ErrorKind::input, "{}: bytes behind the end of bufferView {}", place_, view);
    return reinterpret_cast<const unsigned char*>(own.data()) + offset;
}

template <typename Value, typename Read, typename Take>
void GltfAccessor::gather(const Read& read, const Take& take) const
{
    const std::size_t elementSize = components_ * componentSize_;

    // Read the elements from the buffer, or zeros.
    const unsigned char* first = nullptr;
    std::size_t stride = 0;
    if (accessor_.bufferView >= 0) {
        const auto view = static_cast<std::size_t>(accessor_.bufferView);
        const std::size_t given = model_.structure.bufferViews.at(view).byteStride;
        stride = given == 0 ? elementSize : given;
        first = bytes(accessor_.bufferView, accessor_.byteOffset,
                      (accessor_.count - 1) * stride + elementSize);
    }
    forEachBlock(accessor_.count, blockSize, [&](std::size_t begin, std::size_t end) {
        Block<Value> values{};
        for (std::size_t i = begin; first != nullptr && i < end; ++i)
            for (std::size_t c = 0; c < components_; ++c)
                values[(i - begin) * components_ + c] =
                    read(first + i * stride + c * componentSize_);
        take(begin, end - begin, values.data());
    });

    // Read the replacements of a sparse accessor.
    if (!accessor_.sparse.isSparse)
        return;
    const auto& sparse = accessor_.sparse;
    const auto changed = static_cast<std::size_t>(sparse.count);
    const std::size_t indexSize = sizeOf(sparse.indices.componentType);
    const unsigned char* const index =
        bytes(sparse.indices.bufferView, static_cast<std::size_t>(sparse.indices.byteOffset),
              changed * indexSize);
    const unsigned char* const value =
        bytes(sparse.values.bufferView, static_cast<std::size_t>(sparse.values.byteOffset),
              changed * elementSize);
    for (std::size_t i = 0; i < changed; ++i) {
        const std::uint32_t element =
            readIndex(index + i * indexSize, sparse.indices.componentType);
        if (element >= accessor_.count)
            fail(ErrorKind::input, "{}: sparse index {} of {} elements", place_, element,
                 accessor_.count);
        std::array<Value, maxComponents> values{};
        for (std::size_t c = 0; c < components_; ++c)
            values[c] = read(value + i * elementSize + c * componentSize_);
        take(std::size_t(element), std::size_t(1), values.data());
    }
}

void GltfAccessor::eachNumbers(const TakeNumbers& take) const
{
    requireComponents(1, maxComponents);
    const int type = accessor_.componentType;
    const bool normalized = accessor_.normalized;
    if (isFloat())
        return gather<float>(load<float>, take);
    gather<float>([type, normalized](
                      const unsigned char* source) { return readNumber(source, type, normalized); },
                  take);
}

std::vector<float> GltfAccessor::numbers() const
{
    std::vector<float> numbers(accessor_.count * components_);
    eachNumbers([&](std::size_t first, std::size_t count, const float* block) {
        std::copy_n(block, count * components_,
                    numbers.begin() + static_cast<std::ptrdiff_t>(first * components_));
    });
    return numbers;
}

void GltfAccessor::eachIndices(const TakeIndices& take) const
{
    requireComponents(1, 1);
    const int type = accessor_.componentType;
    if (type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE &&
        type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
        type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT)
        fail(ErrorKind::input, "{}: component type {} is not an unsigned integer", place_, type);
    gather<std::uint32_t>([type](const unsigned char* source) { return readIndex(source, type); },
                          take);
}

std::vector<std::uint32_t> GltfAccessor::indices() const
{
    std::vector<std::uint32_t> indices(accessor_.count);
    eachIndices([&](std::size_t first, std::size_t count, const std::uint32_t* block) {
        std::copy_n(block, count, indices.begin() + static_cast<std::ptrdiff_t>(first));
    });
    return indices;
}

} // namespace sward::terrain
