#pragma once

#include "field/field.h"
#include "shaders/shared/eyepoint.h"
#include "shaders/shared/pages.h"
#include "shaders/shared/patch_tree.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace sward::render {

/// Decides which pages of a field's blades are resident if not all fit. A survey walks down the
/// patch tree, coarse to fine, and ranks pages by the visible size of their patches' blades.
/// Independent of the device. Allocates only in the constructor.
class Residency {
public:
    /// Room for `places` pages, all free. The data viewed by `field` must outlive it.
    Residency(const field::FieldView& field, std::uint32_t places);

    /// Visits `most` nodes more, for at least one view; a patch is as wanted as by the view that
    /// wants it most. A survey keeps its views from begin to end; the call after its end begins the
    /// next one. `threshold` [pixels]: the blade width at which level of detail begins if all
    /// blades are resident (Eyepoint::lodThreshold). Returns whether a survey has ended.
    bool survey(std::span<const shared::Eyepoint> views, float threshold, std::uint32_t most);

    /// The best page that fits, is not resident and was not requested since the last survey ended.
    /// Removes it from the list.
    std::optional<std::uint32_t> next();

    /// Assigns a free place to a page that is being loaded; none if there is none.
    std::optional<std::uint32_t> take(std::uint32_t page);

    /// Marks the page as resident.
    shared::PageChange arrive(std::uint32_t page);

    /// A page that has left. Its place stays occupied until free().
    struct Gone {
        shared::PageChange change = {};
        std::uint32_t place = 0; ///< in pages
    };

    /// Evicts a page of lower grade than the page `waiting` pages after next(); nothing if there is
    /// none.
    std::optional<Gone> leave(std::uint32_t waiting);
    void free(const Gone& gone);

    /// Factor on the level-of-detail threshold at which only resident blades are drawn; 1 if all
    /// visible ones are resident.
    float thinning() const;

    /// Whether the last survey needs no further changes.
    bool isAllThere() const { return !lacks() || (free_.empty() && fruitless_ >= pageAt_.size()); }

    std::uint32_t freePlaces() const { return static_cast<std::uint32_t>(free_.size()); }
    std::uint32_t placeOf(std::uint32_t page) const;   ///< of a resident page; or noPlace
    std::uint64_t blades() const { return blades_; }   ///< of fully resident patches
    std::uint64_t patches() const { return patches_; } ///< number of those patches, or a few more
    std::uint32_t pageCount() const { return static_cast<std::uint32_t>(pages_.size()); }
    std::uint32_t residentPages() const { return residentPages_; }
    std::uint32_t seenPages() const { return seenPages_; } ///< a view draws of, by the last survey
    std::uint32_t missingPages() const; ///< of these, not resident; slow if many are

private:
    enum class State : std::uint8_t { absent, coming, there, leaving };

    struct Page {
        std::uint32_t place = shared::noPlace;
        std::uint32_t survey = 0; ///< the last one that wanted it
        std::uint8_t grade = 0;   ///< in that survey
        State state = State::absent;
        std::uint16_t low = 0;   ///< blades of a patch that begins on the page before
        std::uint16_t high = 0;  ///< blades of a patch that ends on the next page
        std::uint16_t begun = 0; ///< patches that begin on it
    };

    void visit(std::uint32_t entry);
    void want(const shared::Patch& cell, std::uint8_t grade);
    void finish();
    void skipPresent();
    shared::PageChange change(std::uint32_t page, bool comes);
    bool isThere(std::uint32_t page) const;
    bool lacks() const;

    field::FieldView field_;
    std::vector<shared::Subtree> subtrees_;
    std::vector<Page> pages_;
    std::vector<std::uint32_t> pageAt_; ///< by place; noPlace if none
    std::vector<std::uint32_t> free_;   ///< places

    // The current survey.
    std::vector<shared::Eyepoint> views_;
    float threshold_ = 0.0f;
    std::vector<std::uint32_t> queue_; ///< nodes; outsideBit marks invisible ones
    std::size_t visited_ = 0;
    std::uint32_t number_ = 0;
    std::vector<std::uint32_t> wanted_;  ///< number of pages by grade
    std::vector<std::uint32_t> missing_; ///< pages, in the order of visits

    // The result of the last survey.
    std::uint32_t lastNumber_ = 0;
    std::uint8_t minGrade_ = 0;        ///< lowest grade: fits in part; higher ones fit wholly
    std::vector<std::uint32_t> order_; ///< missing pages, best first
    std::size_t requested_ = 0;        ///< number of pages handed out
    std::size_t firstMissing_ = 0;     ///< all before it are resident
    std::uint32_t hand_ = 0;           ///< place where the next search for a victim starts
    std::size_t fruitless_ = 0;        ///< places before it without a victim
    bool hasGivenUp_ = false;          ///< a wanted page has left since the survey began

    std::uint64_t blades_ = 0;
    std::uint64_t patches_ = 0;
    std::uint32_t residentPages_ = 0;
    std::uint32_t seenPages_ = 0;
};

} // namespace sward::render
