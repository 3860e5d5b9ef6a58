#pragma once

#include "field/field.h"

#include <filesystem>
#include <memory>

namespace sward::field {

/// A field file, mapped and verified; blades and patches are used where they lie.
class MappedField {
public:
    MappedField(MappedField&&) noexcept;
    MappedField& operator=(MappedField&&) noexcept;
    ~MappedField();

    /// Valid as long as this object.
    FieldView view() const;
    std::uint64_t fileBytes() const;

private:
    friend MappedField readField(const std::filesystem::path& path);
    struct Contents;
    explicit MappedField(std::unique_ptr<Contents> contents);

    std::unique_ptr<Contents> contents_;
};

/// Maps `path` and verifies everything (hashes, ranges, indices, every number) before it hands out
/// a view. Throws Error{io} if it cannot be read, Error{input} naming the file and what is wrong
/// with it if any byte is missing or changed, Error{unsupported} with both versions if the file is
/// newer.
MappedField readField(const std::filesystem::path& path);

} // namespace sward::field
