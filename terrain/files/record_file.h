#pragma once

#include "core/files/atomic_file.h"
#include "core/files/mapped_file.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string_view>
#include <type_traits>
#include <vector>

namespace sward::terrain {

/// Writes arrays of plain data in sequence, for programs of the same build: intermediate results of
/// a distributed bake. The file appears whole or not at all and ends with a hash of its content.
class RecordWriter {
public:
    /// `kind` (eight letters) names the content. Throws Error{io}.
    RecordWriter(const std::filesystem::path& path, std::string_view kind, bool overwrite);
    ~RecordWriter();

    template <typename T>
    void add(std::span<const T> values)
    {
        static_assert(std::is_trivially_copyable_v<T>);
        addBytes(std::as_bytes(values), sizeof(T));
    }
    template <typename T, typename A>
    void add(const std::vector<T, A>& values)
    {
        add(std::span<const T>(values.data(), values.size()));
    }
    void add(std::string_view text) { add(std::span<const char>(text.data(), text.size())); }
    template <typename T>
        requires std::is_trivially_copyable_v<T>
    void addOne(const T& value)
    {
        add(std::span<const T>(&value, 1));
    }

    /// Begins an array of `count` elements whose bytes addPart() then adds, all of them.
    void begin(std::uint64_t count, std::uint64_t elementBytes);
    /// The next bytes of that array.
    void addPart(std::span<const std::byte> bytes);

    /// Writes the hash and renames the file to its final name. Throws Error{io}.
    void commit();

private:
    void addBytes(std::span<const std::byte> bytes, std::size_t elementBytes);

    struct Hash;
    AtomicFile file_;
    std::unique_ptr<Hash> hash_;
};

/// Reads the arrays of a RecordWriter in the same order. Verifies the whole file first. Throws
/// Error{io} if the file cannot be read, Error{input} if it is truncated, changed or of another
/// kind.
class RecordReader {
public:
    RecordReader(const std::filesystem::path& path, std::string_view kind);

    template <typename T, typename A>
    void read(std::vector<T, A>& values)
    {
        const std::span<const std::byte> bytes = next(sizeof(T));
        values.resize(bytes.size() / sizeof(T));
        copy(bytes, values.data());
    }
    void read(std::string& text);
    /// Place of the next array in a file.
    struct ArrayPlace {
        std::uint64_t at;    ///< [bytes] of its first element, from the file's beginning
        std::uint64_t count; ///< of elements
    };
    /// Passes over an array.
    ArrayPlace skip(std::size_t elementBytes);
    /// The bytes of an array that skip() has passed over, as long as this lives.
    std::span<const std::byte> bytesOf(const ArrayPlace& place, std::size_t elementBytes) const
    {
        return file_.bytes().subspan(place.at, place.count * elementBytes);
    }
    template <typename T>
    void readOne(T& value)
    {
        std::vector<T> one;
        read(one);
        requireOne(one.size());
        value = one[0];
    }

private:
    std::span<const std::byte> next(std::size_t elementBytes);
    void requireOne(std::size_t count) const;
    static void copy(std::span<const std::byte> from, void* to);

    std::string name_;
    MappedFile file_;
    std::size_t at_ = 0;
    std::size_t end_ = 0;
};

} // namespace sward::terrain
