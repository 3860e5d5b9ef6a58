#pragma once

#include "field/field.h"
#include "shaders/shared/pages.h"

#include <cstdint>
#include <vector>

namespace sward::render {

/// Which pages of a field's blades are resident, with a summary of each node of the patch tree that
/// lets searches skip what is complete or empty.
class PageTree {
public:
    /// Nothing is resident. The data viewed by `field` must outlive it.
    explicit PageTree(const field::FieldView& field);

    enum class State : std::uint8_t {
        absent,
        coming,  ///< has a place, is being copied
        there,   ///< resident
        leaving, ///< not resident; its place is still occupied
    };

    static constexpr float noRank = -1.0f;

    /// What lies at and below a node.
    struct Node {
        float missing;  ///< lowest rankLow of a patch that is not complete; noRank if there is none
        float resident; ///< highest rankLow of a patch with a resident page; noRank if none
        float widest;   ///< [m] Subtree::widest
    };

    std::uint32_t patchCount() const { return static_cast<std::uint32_t>(nodes_.size()); }
    std::uint32_t pageCount() const { return static_cast<std::uint32_t>(pages_.size()); }
    const shared::Patch& patch(std::uint32_t patch) const { return field_.patches[patch]; }
    const Node& node(std::uint32_t patch) const { return nodes_[patch]; }

    /// Node::missing of the children of a node together.
    float missingBelow(std::uint32_t patch) const;

    State state(std::uint32_t page) const { return pages_[page].state; }
    std::uint32_t placeOf(std::uint32_t page) const; ///< of a resident page, in pages; or noPlace

    static std::uint32_t firstPage(const shared::Patch& cell);
    static std::uint32_t lastPage(const shared::Patch& cell);

    /// Whether a patch owns blades of which some are neither resident nor coming.
    bool isMissing(std::uint32_t patch) const;

    /// Whether a patch has blades on a resident page.
    bool isResident(std::uint32_t patch) const;

    /// Calls `visit` with each patch that has blades on the page.
    template <typename Visit>
    void forPatchesOf(std::uint32_t page, const Visit& visit) const
    {
        const std::uint64_t end = (std::uint64_t(page) + 1) * shared::pageBlades;
        for (std::uint32_t p = pages_[page].firstPatch;
             p < patchCount() && field_.patches[p].firstBlade < end; ++p)
            if (field_.patches[p].bladeCount > 0)
                visit(p);
    }

    // absent → coming → there → leaving → absent
    void take(std::uint32_t page, std::uint32_t place);
    shared::PageChange arrive(std::uint32_t page);
    shared::PageChange leave(std::uint32_t page);
    void free(std::uint32_t page);

    std::uint64_t blades() const { return blades_; }   ///< of completely resident patches
    std::uint64_t patches() const { return patches_; } ///< number of those patches, or a few more
    std::uint32_t residentPages() const { return residentPages_; }

private:
    struct Page {
        std::uint32_t place = shared::noPlace;
        std::uint32_t firstPatch = shared::noPatch; ///< with blades on it
        std::uint16_t low = 0;   ///< blades of a patch that begins on the page before
        std::uint16_t high = 0;  ///< blades of a patch that ends on the next page
        std::uint16_t begun = 0; ///< patches that begin on it
        State state = State::absent;
    };

    bool isThere(std::uint32_t page) const;
    shared::PageChange change(std::uint32_t page, bool comes);
    void findMissing(std::uint32_t patch);
    void addMissing(std::uint32_t patch);
    void findResident(std::uint32_t patch);
    void addResident(std::uint32_t patch);

    field::FieldView field_;
    std::vector<Node> nodes_; ///< by patch
    std::vector<Page> pages_;
    std::uint64_t blades_ = 0;
    std::uint64_t patches_ = 0;
    std::uint32_t residentPages_ = 0;
};

} // namespace sward::render
