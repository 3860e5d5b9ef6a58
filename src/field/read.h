#pragma once

#include "field/field.h"

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace sward::field {

/// How readField() treats memory.
struct ReadOptions {
    bool withKeys = true;  ///< false: FieldView::keys is empty, and 8 bytes a blade are saved
    bool isFrugal = false; ///< while the file is verified, at most some 64 MB of it are in memory
};

/// A verified field file, mapped or held by the caller. Blades and patches are used in place.
class MappedField {
public:
    MappedField(MappedField&&) noexcept;            ///< views stay valid
    MappedField& operator=(MappedField&&) noexcept; ///< discards the former field
    ~MappedField();

    /// Valid as long as this object, or what it is moved to: not of a temporary. Throws
    /// Error{usage} if it has been moved away.
    FieldView view() const&;
    FieldView view() const&& = delete;
    std::uint64_t fileBytes() const; ///< of the whole file

    /// Takes the file's bytes out of the program's memory, as leaveOnDisk() does. Nothing of a
    /// field that is no mapped file.
    void leaveOnDisk() const noexcept;

private:
    friend MappedField readField(const std::filesystem::path& path, const ReadOptions& options);
    friend MappedField readField(std::span<const std::byte> bytes, const std::string& name);
    friend MappedField readField(std::vector<std::byte>&& bytes, const std::string& name);
    struct Contents;
    explicit MappedField(std::unique_ptr<Contents> contents);

    std::unique_ptr<Contents> contents_;
};

/// Maps `path` and verifies hashes, ranges, indices and all numbers before it returns a view.
/// Throws Error{io} if the file cannot be read, Error{input} naming the file and the fault if any
/// byte is missing or changed, Error{unsupported} with both versions if the file is newer.
MappedField readField(const std::filesystem::path& path, const ReadOptions& options = {});

/// The same for a file that the caller holds in memory. `bytes` start at a multiple of 4 and
/// outlive the result. Error messages call the file `name`.
MappedField readField(std::span<const std::byte> bytes, const std::string& name);

/// The same, and the result owns the bytes.
MappedField readField(std::vector<std::byte>&& bytes, const std::string& name);

} // namespace sward::field
