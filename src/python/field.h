#pragma once

#include "field/field.h"
#include "field/owned_field.h"

#include <pybind11/pybind11.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace sward::python {

/// A field in Python: a mapped file, or one in memory. Arrays over it hold a reference to its
/// Python object, so that it lives as long as any of them.
class Field {
public:
    /// Maps and verifies a file. Throws as field::readField() does.
    explicit Field(const std::filesystem::path& path);

    /// The bytes of a file in memory, verified. Throws as field::readField() does.
    Field(std::vector<std::byte>&& file, std::string name);

    /// A field in memory. `report`: of its bake, as JSON, or empty.
    Field(field::Field&& field, std::string name, std::string report = {});

    const field::FieldView& view() const { return owned_.view(); }
    const field::OwnedField& owned() const { return owned_; }
    const std::string& name() const { return name_; } ///< in messages: the file
    bool isMapped() const { return memory_ == nullptr && file_.empty(); }
    std::uint64_t bytes() const { return bytes_; } ///< of the file that it is, or would be

    std::string report; ///< of the bake that made it, as JSON; empty if it was read

    /// Writes the field, in memory, as a file. Throws as field::writeField() does.
    void save(const std::filesystem::path& path, bool overwrite) const;

private:
    std::string name_;
    std::shared_ptr<const field::Field> memory_; ///< of a bake; else null
    std::vector<std::byte> file_;                ///< of a file that was read; else empty
    std::uint64_t bytes_ = 0;
    field::OwnedField owned_;
};

/// Read-only numpy array of dtype PackedBlade over the field's memory, without a copy; likewise of
/// patches and keys. `self` is the field's Python object.
pybind11::object packedBlades(const pybind11::object& self);
pybind11::object patches(const pybind11::object& self);
pybind11::object keys(const pybind11::object& self);

/// A new array of unpacked blades `first` to `first + count`, in file order; see Field.blades().
pybind11::object unpackedBlades(const Field& field, std::uint64_t first, std::uint64_t count);

/// A new (count, 3, 3) array: v0, v1 and v2 of blades at rest in still air, in the world [m].
pybind11::object restingCurves(const Field& field, std::uint64_t first, std::uint64_t count);

} // namespace sward::python
