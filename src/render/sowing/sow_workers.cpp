#include "render/sowing/sow_workers.h"

#include "core/expect.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace sward::render {
namespace {

/// Cells that are kept unpacked: about 0.6 MB each on ground with triangles of a metre.
constexpr std::size_t keptCells = 256;

} // namespace

SowWorkers::SowWorkers(const field::FieldView& seeded, std::uint32_t threads)
    : seeds_(seeded.seeds)
    , species_(seeded.species.begin(), seeded.species.end())
    , sower_(*seeded.seeds->meadow, species_, seeded.origin)
{
    for (std::uint32_t i = 0; i < threads; ++i)
        threads_.emplace_back([this] { work(); });
}

SowWorkers::~SowWorkers()
{
    {
        const std::lock_guard lock(mutex_);
        ends_ = true;
        waiting_.clear();
    }
    changed_.notify_all();
    for (std::thread& thread : threads_)
        thread.join();
}

void SowWorkers::want(std::vector<Job> jobs)
{
    {
        const std::lock_guard lock(mutex_);
        waiting_.assign(jobs.begin(), jobs.end());
    }
    changed_.notify_all();
}

bool SowWorkers::run()
{
    Job job;
    {
        const std::lock_guard lock(mutex_);
        if (waiting_.empty())
            return false;
        job = waiting_.front();
        waiting_.pop_front();
        ++running_;
    }
    std::optional<Result> result;
    std::exception_ptr failure;
    try {
        result = done(job);
    } catch (...) {
        failure = std::current_exception();
    }
    {
        const std::lock_guard lock(mutex_);
        if (result)
            results_.push_back(std::move(*result));
        if (failure && !failure_)
            failure_ = failure;
        --running_;
    }
    changed_.notify_all();
    return true;
}

void SowWorkers::finish()
{
    while (run()) {
    }
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return waiting_.empty() && running_ == 0; });
}

std::vector<SowWorkers::Result> SowWorkers::take()
{
    const std::lock_guard lock(mutex_);
    if (failure_)
        std::rethrow_exception(std::exchange(failure_, nullptr));
    return std::exchange(results_, {});
}

void SowWorkers::work()
{
    for (;;) {
        {
            std::unique_lock lock(mutex_);
            changed_.wait(lock, [this] { return ends_ || !waiting_.empty(); });
            if (ends_)
                return;
        }
        run();
    }
}

SowWorkers::Result SowWorkers::done(const Job& job)
{
    if (!job.unit) {
        const field::SeedCell cell = field::readSeedCell(*seeds_, job.cell, "the field's seeds");
        return {.cell = cell.cell,
                .cubes = field::cubesOf(cell, sower_.meadow().unitBits),
                .unit = {},
                .order = {}};
    }
    std::shared_ptr<const field::UnitCell> cell = cellAt(job.cell);
    Result result{.cell = cell->seeds().cell, .cubes = cell->cubes(), .unit = {}, .order = {}};
    if (job.isForDevice) {
        result.order = orderOf(sower_, job.cell, std::move(cell), *job.unit);
        return result;
    }
    result.unit = field::growUnit(sower_, species_, *cell, *job.unit);
    result.unit->keys = {};
    return result;
}

field::GrownUnit SowWorkers::grow(const Job& job)
{
    expect(job.unit.has_value(), "a unit to grow");
    return field::growUnit(sower_, species_, *cellAt(job.cell), *job.unit);
}

/// One thread unpacks a cell; the others that want it wait.
std::shared_ptr<const field::UnitCell> SowWorkers::cellAt(std::size_t index)
{
    std::unique_lock lock(mutex_);
    for (;;) {
        const auto found = std::ranges::find(cached_, index, &Cached::cell);
        if (found != cached_.end()) {
            cached_.splice(cached_.begin(), cached_, found);
            return found->content;
        }
        if (!making_.contains(index))
            break;
        changed_.wait(lock);
    }
    making_.insert(index);
    lock.unlock();
    std::shared_ptr<const field::UnitCell> made;
    try {
        made = std::make_shared<const field::UnitCell>(
            field::readSeedCell(*seeds_, index, "the field's seeds"), sower_);
    } catch (...) {
        lock.lock();
        making_.erase(index);
        changed_.notify_all();
        throw;
    }
    lock.lock();
    making_.erase(index);
    cached_.push_front({index, made});
    if (cached_.size() > keptCells)
        cached_.pop_back();
    changed_.notify_all();
    return made;
}

} // namespace sward::render
