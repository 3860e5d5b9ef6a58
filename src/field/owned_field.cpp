#include "field/owned_field.h"

#include "core/error.h"

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

OwnedField::OwnedField(MappedField&& field)
    : OwnedField(std::make_shared<const MappedField>(std::move(field)))
{
}

OwnedField::OwnedField(Field&& field)
    : OwnedField(std::make_shared<const Field>(std::move(field)))
{
}

OwnedField::OwnedField(std::shared_ptr<const MappedField> field)
    : view_(given(field).view())
{
    owner_ = std::move(field);
}

OwnedField::OwnedField(std::shared_ptr<const Field> field)
    : view_(viewOf(given(field)))
{
    owner_ = std::move(field);
}

} // namespace sward::field
