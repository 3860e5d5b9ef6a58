#include "field/owned_field.h"

#include "core/error.h"
#include "field/field.h"
#include "field/read.h"

#include <utility>

namespace sward::field {
namespace {

template <typename T>
const T& given(const std::shared_ptr<const T>& field)
{
    requireUsage(field != nullptr, "the field that is to be owned is null");
    return *field;
}

} // namespace

/// A view, and what it is of.
struct OwnedField::Contents {
    FieldView view;
    std::shared_ptr<const void> owner;
};

OwnedField::OwnedField(MappedField&& field)
    : OwnedField(std::make_shared<const MappedField>(std::move(field)))
{
}

OwnedField::OwnedField(Field&& field)
    : OwnedField(std::make_shared<const Field>(std::move(field)))
{
}

OwnedField::OwnedField(std::shared_ptr<const MappedField> field)
    : contents_(std::make_shared<const Contents>(Contents{given(field).view(), field}))
{
}

OwnedField::OwnedField(std::shared_ptr<const Field> field)
    : contents_(std::make_shared<const Contents>(Contents{viewOf(given(field)), field}))
{
}

const FieldView& OwnedField::view() const&
{
    return contents_->view;
}

} // namespace sward::field
