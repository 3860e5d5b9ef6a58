#pragma once

#include "field/join.h"

#include <cstdint>
#include <span>
#include <vector>

namespace sward::view {

/// Fields that are drawn together: one as it lies in its file, several joined.
class FieldGroup {
public:
    /// One or more, which outlive it. Throws what field::join() throws.
    explicit FieldGroup(std::vector<field::Member> members);
    FieldGroup(const FieldGroup&) = delete;
    FieldGroup& operator=(const FieldGroup&) = delete;

    /// Valid as long as this object.
    const field::FieldView& view() const { return view_; }
    std::span<const field::Member> members() const { return members_; }

    /// Whose a patch of the view is. It owns blades, or there is one member.
    field::PatchSource sourceOf(std::uint32_t patch) const;

private:
    std::vector<field::Member> members_;
    field::JoinedFields joined_; ///< nothing for one alone
    field::FieldView view_;
};

} // namespace sward::view
