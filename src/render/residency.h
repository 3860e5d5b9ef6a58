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

/// Which pages of a field's blades are to be in memory, where there is room for some of them: a
/// survey walks down the patch tree, coarse to fine, and ranks pages by how much is seen of their
/// patches. Knows nothing of a device. Nothing is allocated after the construction.
class Residency {
public:
    /// Room for `places` pages, all free. What `field` views outlives it.
    Residency(const field::FieldView& field, std::uint32_t places);

    /// Looks at `most` nodes more. A survey has one eyepoint from begin to end; the next begins
    /// with the next call. `threshold` [pixels]: the width of a blade at which level of detail
    /// begins, as Eyepoint::lodThreshold would be with all blades in memory. Returns whether one
    /// has ended.
    bool survey(const shared::Eyepoint& view, float threshold, std::uint32_t most);

    /// The best page, of those that fit, that is not in memory and was not asked for since the last
    /// survey ended; and drops it from the list.
    std::optional<std::uint32_t> next();

    /// A free place for a page that is on its way from now on; none, if none is free.
    std::optional<std::uint32_t> take(std::uint32_t page);

    /// The page is there.
    shared::PageChange arrive(std::uint32_t page);

    /// A page that has left, and its place, which is not free before free().
    struct Gone {
        shared::PageChange change = {};
        std::uint32_t place = 0; ///< counted in pages
    };

    /// Takes away a page that is worth less than the one that comes `waiting` pages after next();
    /// nothing if there is none.
    std::optional<Gone> leave(std::uint32_t waiting);
    void free(const Gone& gone);

    /// By how much wider than the threshold blades are to be when level of detail begins, so that
    /// what is in memory is all that is drawn: 1 when all that is seen is there.
    float thinning() const;

    /// Whether there is nothing more to be done for the last survey.
    bool isAllThere() const { return !lacks() || (free_.empty() && fruitless_ >= pageAt_.size()); }

    std::uint32_t freePlaces() const { return static_cast<std::uint32_t>(free_.size()); }
    std::uint32_t placeOf(std::uint32_t page) const;   ///< of a page that is there; or noPlace
    std::uint64_t blades() const { return blades_; }   ///< of the patches that are there as a whole
    std::uint64_t patches() const { return patches_; } ///< as many of them, or some more
    std::uint32_t pageCount() const { return static_cast<std::uint32_t>(pages_.size()); }

private:
    enum class State : std::uint8_t { absent, coming, there, leaving };

    struct Page {
        std::uint32_t place = shared::noPlace;
        std::uint32_t survey = 0; ///< the last that wanted it
        std::uint8_t grade = 0;   ///< by that
        State state = State::absent;
        std::uint16_t low = 0;   ///< blades of a patch that began on the page before
        std::uint16_t high = 0;  ///< blades of a patch that ends on the page behind
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

    // The survey under way.
    shared::Eyepoint view_ = {};
    float threshold_ = 0.0f;
    std::vector<std::uint32_t> queue_; ///< nodes; a bit says that they are out of sight
    std::size_t visited_ = 0;
    std::uint32_t number_ = 0;
    std::vector<std::uint32_t> wanted_;  ///< pages by grade
    std::vector<std::uint32_t> missing_; ///< pages, in the order in which they were found

    // What the last one has found.
    std::uint32_t lastNumber_ = 0;
    std::uint8_t minGrade_ = 0;        ///< pages of it fit in part, those above as a whole
    std::vector<std::uint32_t> order_; ///< pages that were missing, the best first
    std::size_t requested_ = 0;        ///< so many of them have been handed out
    std::size_t firstMissing_ = 0;     ///< those before it are there
    std::uint32_t hand_ = 0;           ///< place at which the next one that leaves is looked for
    std::size_t fruitless_ = 0;        ///< places before it of which none may leave
    bool hasGivenUp_ = false;          ///< a wanted page has left since the survey began

    std::uint64_t blades_ = 0;
    std::uint64_t patches_ = 0;
};

} // namespace sward::render
