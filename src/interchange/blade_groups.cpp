#include "interchange/blade_groups.h"

#include <glm/common.hpp>

#include <limits>

namespace sward::interchange {
namespace {

constexpr std::uint32_t noGroup = std::numeric_limits<std::uint32_t>::max();

// A subtree with less than this share (1/32) of the largest group gets no draw of its own.
constexpr std::uint64_t minShare = 32;

// Number of blades of each patch and its subtree.
std::vector<std::uint64_t> subtreeCounts(std::span<const shared::Patch> patches)
{
    std::vector<std::uint64_t> counts(patches.size());
    for (std::size_t p = patches.size(); p-- > 0;) {
        counts[p] += patches[p].bladeCount;
        if (p > 0)
            counts[patches[p].parent] += counts[p];
    }
    return counts;
}

class Grouping {
public:
    Grouping(const field::FieldView& field, std::uint64_t largest)
        : patches_(field.patches)
        , largest_(largest)
        , counts_(subtreeCounts(field.patches))
        , groupOf_(field.patches.size(), noGroup)
    {
    }

    std::vector<BladeGroup> run()
    {
        // Parents precede children, so the parent's group is known.
        for (std::uint32_t p = 0; p < patches_.size(); ++p) {
            groupOf_[p] = choose(p);
            if (groupOf_[p] == noGroup || patches_[p].bladeCount == 0)
                continue;
            BladeGroup& group = groups_[groupOf_[p]];
            group.patches.push_back(p);
            group.bladeCount += patches_[p].bladeCount;
            group.bounds.add(patches_[p].boundsLow);
            group.bounds.add(patches_[p].boundsHigh);
        }
        for (BladeGroup& group : groups_)
            group.place = glm::round(glm::dvec3(group.bounds.centre()));
        return std::move(groups_);
    }

private:
    // Chooses the group of patch `p`; may create one.
    std::uint32_t choose(std::uint32_t p)
    {
        if (counts_[p] == 0)
            return noGroup;
        const std::uint32_t above = p == 0 ? noGroup : groupOf_[patches_[p].parent];
        const bool aboveIsWhole = above != noGroup && counts_[patches_[p].parent] <= largest_;
        if (aboveIsWhole)
            return above;
        // Cells too wide to own blades are in no group.
        const bool isWhole = counts_[p] <= largest_;
        if (!isWhole && patches_[p].bladeCount == 0)
            return noGroup;
        // Representatives and subtrees too small for a group join the parent's group while there is
        // room.
        const std::uint64_t joining = isWhole ? counts_[p] : patches_[p].bladeCount;
        const bool mayJoin = !isWhole || counts_[p] < largest_ / minShare;
        if (mayJoin && above != noGroup && reserved_[above] + joining <= largest_) {
            reserved_[above] += joining;
            return above;
        }
        reserved_.push_back(joining);
        groups_.emplace_back();
        return static_cast<std::uint32_t>(groups_.size() - 1);
    }

    std::span<const shared::Patch> patches_;
    std::uint64_t largest_;
    std::vector<std::uint64_t> counts_;
    std::vector<std::uint32_t> groupOf_;
    std::vector<BladeGroup> groups_;
    std::vector<std::uint64_t> reserved_; // blades per group, including later ones
};

} // namespace

std::vector<BladeGroup> groupBlades(const field::FieldView& field, std::uint64_t largest)
{
    return Grouping(field, largest).run();
}

} // namespace sward::interchange
