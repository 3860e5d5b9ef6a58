#pragma once

#include "field/field.h"
#include "render/streaming/missing_search.h"
#include "render/streaming/page_scores.h"
#include "render/streaming/page_tree.h"
#include "render/streaming/resident_search.h"
#include "shaders/shared/eyepoint.h"
#include "shaders/shared/pages.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace sward::render {

/// Decides which pages of a field's blades are resident if not all fit (decision 0026): in each
/// frame the missing pages with the highest scores replace resident ones with lower scores, see
/// PageScores. A frame's work is bounded, whatever the field's size. Independent of the device.
class Residency {
public:
    /// A page scores so many times more than the one that it replaces: small moves change little.
    static constexpr float margin = 1.19f;

    /// Room for `places` pages, all free. The data viewed by `field` must outlive it.
    Residency(const field::FieldView& field, std::uint32_t places);
    Residency(const Residency&) = delete;

    /// Begins a frame with at least one view; `ahead` are eyepoints expected later. `threshold`:
    /// see PageScores::look(). Until the next frame `visits` nodes are visited, and those that
    /// VisitBudget grants besides.
    void look(std::span<const shared::Eyepoint> views, std::span<const shared::Eyepoint> ahead,
              float threshold, std::uint32_t visits);

    /// An absent page that is wanted.
    struct Wanted {
        std::uint32_t page = 0;
        float score = 0.0f;
        float drawn = 0.0f; ///< score in this frame's views
    };

    /// The best page that this search has not returned; none if what is resident is better, or if
    /// the frame's visits are spent. take() it or postpone() it.
    std::optional<Wanted> next();

    /// Assigns a free place to a page that is being loaded; none if there is none.
    std::optional<std::uint32_t> take(std::uint32_t page);

    /// The page cannot come in this frame. A later search finds it again.
    void postpone(const Wanted& wanted);

    /// Marks the page as resident.
    shared::PageChange arrive(std::uint32_t page);

    /// A page that has left. Its place stays occupied until free(); the page itself may come again
    /// from the next frame on.
    struct Gone {
        shared::PageChange change = {};
        std::uint32_t place = 0; ///< in pages
    };

    /// Evicts a page of about the lowest score for a wanted one, if that is lower by the margin.
    /// Else nothing: `wanted` stays missing, or is returned again in the next frame.
    std::optional<Gone> leave(const Wanted& wanted);
    void free(const Gone& gone);

    /// Whether this frame's views are others than those before, by more than a flight.
    bool isAfterCut() const { return isAfterCut_; }

    /// Ends a frame, after the last page has come or gone.
    void finish();

    /// Factor on the level-of-detail threshold at which all that is drawn is resident or coming.
    float thinning() const { return thinning_; }

    /// Whether further frames with the same views would change nothing.
    bool isAllThere() const { return isSearched_ && !hasPostponed_ && hasBegunStill_; }

    std::uint32_t freePlaces() const { return static_cast<std::uint32_t>(free_.size()); }
    std::uint32_t placeOf(std::uint32_t page) const; ///< first blade of a resident page; or noPlace
    std::uint32_t visited() const { return visits_.used; } ///< nodes, in this frame

    const PageTree& tree() const { return tree_; }
    const PageScores& scores() const { return scores_; }

private:
    bool hasCut(std::span<const shared::Eyepoint> views) const;
    void beginSearch(bool isMoving);
    MissingSearch::Floor floor() const;
    void rank(bool isExact);
    bool findVictim();

    PageTree tree_;
    PageScores scores_;
    MissingSearch missing_;
    ResidentSearch resident_;
    std::vector<std::uint32_t> free_; ///< places
    std::vector<std::uint32_t> left_; ///< pages whose places were freed in this frame
    VisitBudget visits_;              ///< of this frame
    bool isAfterCut_ = false;
    bool isStill_ = false; ///< the eyes and their directions are those of the frame before

    // The search for missing pages.
    std::vector<shared::Eyepoint> begunWith_; ///< its views
    bool hasBegunMoving_ = false;             ///< some eye moved
    bool hasBegunStill_ = false;              ///< see isStill_
    std::uint32_t frames_ = 0;
    std::optional<Wanted> second_;    ///< the other page of a patch that was found
    std::optional<Wanted> held_;      ///< found when the visits were spent
    bool isSearched_ = false;         ///< it has ended
    bool hasPostponed_ = false;       ///< pages that it has found
    std::uint32_t unknownFrames_ = 0; ///< since one has told how thin the field is
    float thinning_ = 1.0f;

    // The search for pages to leave.
    std::optional<ResidentSearch::Found> victim_; ///< the next one
    std::uint32_t rankedFrames_ = 0;
    bool isRankExact_ = false;   ///< see ResidentSearch::begin()
    bool hasRestarted_ = false;  ///< in this frame
    bool hasMoreVisits_ = false; ///< likewise
};

} // namespace sward::render
