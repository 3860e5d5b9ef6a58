#pragma once

#include "field/field.h"

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

namespace sward::field {

/// A field file, mapped or held by the caller, and verified; blades and patches are used where they
/// lie.
class MappedField {
public:
    MappedField(MappedField&&) noexcept;            ///< views stay valid
    MappedField& operator=(MappedField&&) noexcept; ///< the field before is gone
    ~MappedField();

    /// Valid as long as this object.
    FieldView view() const;
    std::uint64_t fileBytes() const; ///< of the whole file

private:
    friend MappedField readField(const std::filesystem::path& path);
    friend MappedField readField(std::span<const std::byte> bytes, const std::string& name);
    struct Contents;
    explicit MappedField(std::unique_ptr<Contents> contents);

    std::unique_ptr<Contents> contents_;
};

/// Maps `path` and verifies everything (hashes, ranges, indices, every number) before it hands out
/// a view. Throws Error{io} if it cannot be read, Error{input} naming the file and what is wrong
/// with it if any byte is missing or changed, Error{unsupported} with both versions if the file is
/// newer.
MappedField readField(const std::filesystem::path& path);

/// The same for a file that the caller holds in memory, perhaps out of an archive of its own:
/// `bytes` begin at a multiple of 4 and outlive the result. Errors call it `name`.
MappedField readField(std::span<const std::byte> bytes, const std::string& name);

} // namespace sward::field
