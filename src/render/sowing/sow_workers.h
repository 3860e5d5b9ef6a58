#pragma once

#include "field/field.h"
#include "field/seeds/seeds.h"
#include "field/seeds/sow_unit.h"
#include "field/seeds/sower.h"
#include "render/sowing/unit_order.h"

#include <array>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <exception>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <span>
#include <thread>
#include <vector>

namespace sward::render {

/// Grows units of a field's seeds on the CPU, in threads of its own or in the caller's.
class SowWorkers {
public:
    /// What the field's view shows must outlive it. `threads` 0: run() does all.
    SowWorkers(const field::FieldView& seeded, std::uint32_t threads);
    ~SowWorkers(); ///< waits for what the threads have begun
    SowWorkers(const SowWorkers&) = delete;
    SowWorkers& operator=(const SowWorkers&) = delete;

    /// A unit to grow, or a cell of which only the cubes are wanted.
    struct Job {
        std::size_t cell = 0; ///< of SeedsView::cells; those that edits have added follow
        std::optional<field::SowUnit> unit;
        bool isForDevice = false; ///< the unit's order is wanted, not its blades
    };

    /// What a job gave.
    struct Result {
        std::array<std::int32_t, 3> cell{};
        field::UnitCell::Cubes cubes; ///< of the cell
        std::optional<field::GrownUnit> unit;
        std::optional<UnitOrder> order;
        std::uint32_t version = 0; ///< of the cell that it was grown from
    };

    /// Replaces a cell. Results of the former one may still come.
    void replace(std::size_t cell, std::shared_ptr<const field::SeedCell> content);
    std::uint32_t versionOf(std::size_t cell); ///< counts how often it was replaced

    /// What a cell holds now. Throws Error{input} for damaged seeds.
    std::shared_ptr<const field::SeedCell> contentOf(std::size_t cell);

    /// Replaces the jobs that no thread has begun, and does those first that come first.
    void want(std::vector<Job> jobs);

    /// Does the next job in the caller's thread. Returns false if there was none.
    bool run();

    /// Waits until all jobs are done; helps.
    void finish();

    /// Results since the last call, in any order. Throws what a job threw: Error{input} for damaged
    /// seeds.
    std::vector<Result> take();

    /// Grows a unit in the caller's thread at once, with keys. Throws as take() does.
    field::GrownUnit grow(const Job& job);

    const field::Sower& sower() const { return sower_; }

private:
    struct Cached {
        std::size_t cell = 0;
        std::uint32_t version = 0;
        std::shared_ptr<const field::UnitCell> content;
    };
    struct Replaced {
        std::shared_ptr<const field::SeedCell> content;
        std::uint32_t version = 0;
    };
    void work();
    Result done(const Job& job);
    Cached cellAt(std::size_t index);

    const field::SeedsView* seeds_;
    std::vector<field::Species> species_;
    field::Sower sower_;

    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<Job> waiting_;
    std::uint32_t running_ = 0;
    bool ends_ = false;
    std::vector<Result> results_;
    std::exception_ptr failure_;
    std::list<Cached> cached_;     ///< cells, the last used first
    std::set<std::size_t> making_; ///< cells that are being unpacked
    std::map<std::size_t, Replaced> replaced_;

    std::vector<std::thread> threads_; ///< last: they use the others
};

} // namespace sward::render
