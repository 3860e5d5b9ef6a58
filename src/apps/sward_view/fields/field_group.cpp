#include "apps/sward_view/fields/field_group.h"

#include "core/expect.h"

#include <utility>

namespace sward::view {

FieldGroup::FieldGroup(std::vector<field::Member> members)
    : members_(std::move(members))
{
    expect(!members_.empty(), "a group has a member");
    if (members_.size() > 1)
        joined_ = field::join(members_);
    view_ = members_.size() > 1 ? field::viewOf(joined_.field) : members_[0].view;
}

field::PatchSource FieldGroup::sourceOf(std::uint32_t patch) const
{
    return members_.size() > 1 ? joined_.sources[patch] : field::PatchSource{0, patch};
}

std::vector<std::uint32_t> FieldGroup::memberOfPatches() const
{
    std::vector<std::uint32_t> numbers;
    for (std::uint32_t patch = 0; patch < view_.patches.size(); ++patch)
        numbers.push_back(view_.patches[patch].bladeCount > 0 ? sourceOf(patch).member : 0);
    return numbers;
}

} // namespace sward::view
