// What is streamed is owned: by type, neither a temporary nor a mere view can be streamed from.

#include "core/error.h"
#include "field/field.h"
#include "field/owned_field.h"
#include "field/read.h"
#include "render/resident/resident_field.h"
#include "support/fields/fields.h"

#include <gtest/gtest.h>

#include <memory>
#include <type_traits>
#include <utility>

namespace sward::render {
namespace {

template <typename Owner>
concept HasView = requires(Owner&& owner)
{
    std::forward<Owner>(owner).view();
};

static_assert(HasView<field::MappedField&> && HasView<const field::MappedField&>);
static_assert(!HasView<field::MappedField> && !HasView<const field::MappedField>);
static_assert(HasView<const field::OwnedField&> && !HasView<field::OwnedField>);
template <typename... Field>
constexpr bool makesResident =
    std::is_constructible_v<ResidentField, const gpu::DeviceContext&, Field...>;
static_assert(makesResident<field::FieldView> && !makesResident<field::FieldView, FieldBudget>);
static_assert(makesResident<field::MappedField, FieldBudget>);
static_assert(makesResident<field::Field, FieldBudget>);
static_assert(!makesResident<field::MappedField&, FieldBudget>, "moved or shared");

TEST(OwnedField, KeepsWhatItViews)
{
    auto field = std::make_shared<const field::Field>(
        test::makeField({.blades = 100, .extent = 4.0f, .seed = 3}));
    const std::weak_ptr<const field::Field> kept = field;
    {
        const field::OwnedField owner(std::move(field));
        EXPECT_EQ(owner.view().blades.size(), 100u);
        EXPECT_FALSE(kept.expired());
        const field::OwnedField copy = owner; // NOLINT(performance-unnecessary-copy-initialization)
        EXPECT_EQ(copy.view().blades.data(), owner.view().blades.data());
    }
    EXPECT_TRUE(kept.expired());
    EXPECT_THROW(field::OwnedField(std::shared_ptr<const field::Field>()), Error);
    EXPECT_THROW(field::OwnedField(std::shared_ptr<const field::MappedField>()), Error);
}

} // namespace
} // namespace sward::render
