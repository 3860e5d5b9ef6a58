#include "terrain/gltf_accessor.h"

#include "core/error.h"

#include <algorithm>
#include <cstring>

namespace sward::terrain {
namespace {

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

template <typename Value, typename Read>
std::vector<Value> GltfAccessor::gather(Read&& read) const
{
    const std::size_t elementSize = components_ * componentSize_;
    std::vector<Value> values(accessor_.count * components_, Value(0));
    const auto take = [&](std::size_t element, const unsigned char* source) {
        for (std::size_t c = 0; c < components_; ++c)
            values[element * components_ + c] = read(source + c * componentSize_);
    };

    // The elements as they lie in the buffer.
    if (accessor_.bufferView >= 0) {
        const auto view = static_cast<std::size_t>(accessor_.bufferView);
        const std::size_t given = model_.structure.bufferViews.at(view).byteStride;
        const std::size_t stride = given == 0 ? elementSize : given;
        const unsigned char* const first = bytes(accessor_.bufferView, accessor_.byteOffset,
                                                 (accessor_.count - 1) * stride + elementSize);
        for (std::size_t i = 0; i < accessor_.count; ++i)
            take(i, first + i * stride);
    }

    // The elements that a sparse accessor puts in their place.
    if (accessor_.sparse.isSparse) {
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
            take(element, value + i * elementSize);
        }
    }
    return values;
}

std::vector<float> GltfAccessor::numbers() const
{
    const int type = accessor_.componentType;
    const bool normalized = accessor_.normalized;
    return gather<float>([type, normalized](const unsigned char* source) {
        return readNumber(source, type, normalized);
    });
}

std::vector<std::uint32_t> GltfAccessor::indices() const
{
    requireComponents(1, 1);
    const int type = accessor_.componentType;
    if (type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE &&
        type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
        type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT)
        fail(ErrorKind::input, "{}: component type {} is not an unsigned integer", place_, type);
    return gather<std::uint32_t>(
        [type](const unsigned char* source) { return readIndex(source, type); });
}

} // namespace sward::terrain
