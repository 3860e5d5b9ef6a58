#include "terrain/gltf/accessor.h"

#include "core/error.h"
#include "terrain/blocks.h"
#include "terrain/gltf/file/layout.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace sward::terrain {
namespace {

// Component types of glTF 2.0, 3.6.2.2.
constexpr std::uint32_t signedByte = 5120;
constexpr std::uint32_t unsignedByte = 5121;
constexpr std::uint32_t signedShort = 5122;
constexpr std::uint32_t unsignedShort = 5123;
constexpr std::uint32_t unsignedInt = 5125;

constexpr std::size_t maxComponents = 16;  // of a matrix
constexpr std::size_t fewComponents = 4;   // of an attribute
constexpr std::size_t blockSize = 3 * 512; // elements of an attribute that a thread reads at a time

template <typename Value>
using Block = std::array<Value, blockSize * fewComponents>;

template <typename Value>
Value load(const unsigned char* bytes)
{
    Value value;
    std::memcpy(&value, bytes, sizeof value);
    return value;
}

// glTF 2.0, 3.6.2.2: how a normalised integer becomes a number.
float readNumber(const unsigned char* bytes, std::uint32_t type, bool normalized)
{
    switch (type) {
    case signedByte: {
        const auto value = static_cast<float>(load<std::int8_t>(bytes));
        return normalized ? std::max(value / 127.0f, -1.0f) : value;
    }
    case unsignedByte: {
        const auto value = static_cast<float>(load<std::uint8_t>(bytes));
        return normalized ? value / 255.0f : value;
    }
    case signedShort: {
        const auto value = static_cast<float>(load<std::int16_t>(bytes));
        return normalized ? std::max(value / 32767.0f, -1.0f) : value;
    }
    case unsignedShort: {
        const auto value = static_cast<float>(load<std::uint16_t>(bytes));
        return normalized ? value / 65535.0f : value;
    }
    case unsignedInt:
        return static_cast<float>(load<std::uint32_t>(bytes));
    default:
        return load<float>(bytes);
    }
}

std::uint32_t readIndex(const unsigned char* bytes, std::uint32_t type)
{
    switch (type) {
    case unsignedByte:
        return load<std::uint8_t>(bytes);
    case unsignedShort:
        return load<std::uint16_t>(bytes);
    default:
        return load<std::uint32_t>(bytes);
    }
}

std::size_t sizeOf(std::uint32_t type)
{
    return static_cast<std::size_t>(gltfComponentSize(type));
}

} // namespace

GltfAccessor::GltfAccessor(const GltfModel& model, int index, std::string place)
    : model_(model)
    , accessor_(model.structure.accessors.at(static_cast<std::size_t>(index)))
    , place_(std::move(place))
    , componentSize_(sizeOf(accessor_.type))
{
}

std::uint32_t GltfAccessor::restartIndex() const
{
    return accessor_.type == unsignedByte    ? 0xffU
           : accessor_.type == unsignedShort ? 0xffffU
                                             : 0xffffffffU;
}

double GltfAccessor::step() const
{
    if (isFloat() || !accessor_.isNormalized)
        return isFloat() ? 0.0 : 1.0;
    switch (accessor_.type) {
    case signedByte:
        return 1.0 / 127.0;
    case unsignedByte:
        return 1.0 / 255.0;
    case signedShort:
        return 1.0 / 32767.0;
    default:
        return 1.0 / 65535.0;
    }
}

void GltfAccessor::requireComponents(std::size_t low, std::size_t high) const
{
    if (components() >= low && components() <= high)
        return;
    fail(ErrorKind::input, "{}: its elements have {} numbers, not {}", place_, components(),
         low == high ? std::to_string(low) : fmt::format("{} to {}", low, high));
}

const unsigned char* GltfAccessor::bytes(int view, std::uint64_t offset, std::size_t size) const
{
    const auto own = model_.view(static_cast<std::size_t>(view));
    if (offset > own.size() || size > own.size() - offset)
        fail(ErrorKind::input, "{}: bytes behind the end of bufferView {}", place_, view);
    return reinterpret_cast<const unsigned char*>(own.data()) + offset;
}

template <typename Value, typename Read, typename Take>
void GltfAccessor::gather(const Read& read, const Take& take) const
{
    const std::size_t width = components();
    const std::size_t elementSize = width * componentSize_;

    // Read the elements from the buffer, or zeros.
    const unsigned char* first = nullptr;
    std::size_t stride = 0;
    if (accessor_.view != noEntry) {
        const std::size_t given =
            model_.structure.views.at(static_cast<std::size_t>(accessor_.view)).stride;
        stride = given == 0 ? elementSize : given;
        first =
            bytes(accessor_.view, accessor_.offset, (accessor_.count - 1) * stride + elementSize);
    }
    const std::size_t size = width <= fewComponents ? blockSize : blockSize / fewComponents;
    forEachBlock(accessor_.count, size, [&](std::size_t begin, std::size_t end) {
        Block<Value> values{};
        for (std::size_t i = begin; first != nullptr && i < end; ++i)
            for (std::size_t c = 0; c < width; ++c)
                values[(i - begin) * width + c] = read(first + i * stride + c * componentSize_);
        take(begin, end - begin, values.data());
    });

    // Read the replacements of a sparse accessor.
    if (!accessor_.sparse)
        return;
    const GltfSparse& sparse = *accessor_.sparse;
    const std::size_t indexSize = sizeOf(sparse.indexType);
    const unsigned char* const index =
        bytes(sparse.indexView, sparse.indexOffset, sparse.count * indexSize);
    const unsigned char* const value =
        bytes(sparse.valueView, sparse.valueOffset, sparse.count * elementSize);
    for (std::size_t i = 0; i < sparse.count; ++i) {
        const std::uint32_t element = readIndex(index + i * indexSize, sparse.indexType);
        if (element >= accessor_.count)
            fail(ErrorKind::input, "{}: sparse index {} of {} elements", place_, element,
                 accessor_.count);
        std::array<Value, maxComponents> values{};
        for (std::size_t c = 0; c < width; ++c)
            values[c] = read(value + i * elementSize + c * componentSize_);
        take(std::size_t(element), std::size_t(1), values.data());
    }
}

void GltfAccessor::eachNumbers(const TakeNumbers& take) const
{
    requireComponents(1, maxComponents);
    const std::uint32_t type = accessor_.type;
    const bool normalized = accessor_.isNormalized;
    if (isFloat())
        return gather<float>(load<float>, take);
    gather<float>([type, normalized](
                      const unsigned char* source) { return readNumber(source, type, normalized); },
                  take);
}

std::vector<float> GltfAccessor::numbers() const
{
    std::vector<float> numbers(accessor_.count * components());
    eachNumbers([&](std::size_t first, std::size_t count, const float* block) {
        std::copy_n(block, count * components(),
                    numbers.begin() + static_cast<std::ptrdiff_t>(first * components()));
    });
    return numbers;
}

void GltfAccessor::eachIndices(const TakeIndices& take) const
{
    requireComponents(1, 1);
    const std::uint32_t type = accessor_.type;
    if (type != unsignedByte && type != unsignedShort && type != unsignedInt)
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
