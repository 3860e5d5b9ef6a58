#pragma once

#include <memory>

namespace sward::field {

class MappedField;
struct Field;
struct FieldView;

/// A field together with what keeps it alive: for whoever reads from it later, such as a renderer
/// that streams its blades. Copies share the field.
class OwnedField {
public:
    OwnedField(MappedField&& field); ///< of readField(); bytes of the caller still outlive this
    OwnedField(Field&& field);       ///< of a bake

    OwnedField(std::shared_ptr<const MappedField> field); ///< Error{usage} if it is null
    OwnedField(std::shared_ptr<const Field> field);       ///< the same

    const FieldView& view() const&;           ///< valid as long as this or a copy of it
    const FieldView& view() const&& = delete; ///< nothing would own it

private:
    struct Contents;
    std::shared_ptr<const Contents> contents_;
};

} // namespace sward::field
