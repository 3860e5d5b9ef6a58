#pragma once

#include "field/join.h"

#include <cstdint>
#include <span>
#include <vector>

namespace sward::view {

/// Fields that are drawn together; several are joined to one.
class FieldGroup {
public:
    /// One or more members, which must outlive this. Throws as field::join() does.
    explicit FieldGroup(std::vector<field::Member> members);
    FieldGroup(const FieldGroup&) = delete;
    FieldGroup& operator=(const FieldGroup&) = delete;

    /// Valid as long as this object.
    const field::FieldView& view() const { return view_; }
    std::span<const field::Member> members() const { return members_; }

    /// The member and patch that a view's patch comes from. Requires own blades or a single member.
    field::PatchSource sourceOf(std::uint32_t patch) const;

    /// The member that each patch of the view comes from; 0 for patches without own blades.
    std::vector<std::uint32_t> memberOfPatches() const;

private:
    std::vector<field::Member> members_;
    field::JoinedFields joined_; ///< empty for a single field
    field::FieldView view_;
};

} // namespace sward::view
