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

void SowWorkers::replace(std::size_t cell, std::shared_ptr<const field::SeedCell> content)
{
    const std::lock_guard lock(mutex_);
    Replaced& replaced = replaced_[cell];
    replaced.content = std::move(content);
    ++replaced.version;
    cached_.remove_if([&](const Cached& one) { return one.cell == cell; });
}

std::uint32_t SowWorkers::versionOf(std::size_t cell)
{
    const std::lock_guard lock(mutex_);
    const auto found = replaced_.find(cell);
    return found == replaced_.end() ? 0 : found->second.version;
}

std::shared_ptr<const field::SeedCell> SowWorkers::contentOf(std::size_t cell)
{
    {
        const std::lock_guard lock(mutex_);
        if (const auto found = replaced_.find(cell); found != replaced_.end())
            return found->second.content;
        if (const auto found = std::ranges::find(cached_, cell, &Cached::cell);
            found != cached_.end())
            return {found->content, &found->content->seeds()};
    }
    if (cell >= seeds_->cells.size())
        return std::make_shared<const field::SeedCell>();
    return std::make_shared<const field::SeedCell>(
        field::readSeedCell(*seeds_, cell, "the field's seeds"));
}

SowWorkers::Result SowWorkers::done(const Job& job)
{
    if (!job.unit) {
        const std::uint32_t version = versionOf(job.cell);
        const std::shared_ptr<const field::SeedCell> cell = contentOf(job.cell);
        return {.cell = cell->cell,
                .cubes = field::cubesOf(*cell, sower_.meadow().unitBits),
                .unit = {},
                .order = {},
                .version = version};
    }
    Cached cell = cellAt(job.cell);
    Result result{.cell = cell.content->seeds().cell,
                  .cubes = cell.content->cubes(),
                  .unit = {},
                  .order = {},
                  .version = cell.version};
    if (job.isForDevice) {
        result.order = orderOf(sower_, job.cell, std::move(cell.content), *job.unit);
        return result;
    }
    result.unit = field::growUnit(sower_, species_, *cell.content, *job.unit);
    result.unit->keys = {};
    return result;
}

field::GrownUnit SowWorkers::grow(const Job& job)
{
    expect(job.unit.has_value(), "a unit to grow");
    return field::growUnit(sower_, species_, *cellAt(job.cell).content, *job.unit);
}

/// One thread unpacks a cell; the others that want it wait.
SowWorkers::Cached SowWorkers::cellAt(std::size_t index)
{
    std::unique_lock lock(mutex_);
    for (;;) {
        const auto found = std::ranges::find(cached_, index, &Cached::cell);
        if (found != cached_.end()) {
            cached_.splice(cached_.begin(), cached_, found);
            return *found;
        }
        if (!making_.contains(index))
            break;
        changed_.wait(lock);
    }
    making_.insert(index);
    const auto replaced = replaced_.find(index);
    const Replaced now = replaced == replaced_.end() ? Replaced() : replaced->second;
    lock.unlock();
    Cached made{.cell = index, .version = now.version, .content = {}};
    try {
        made.content = std::make_shared<const field::UnitCell>(
            now.content ? field::SeedCell(*now.content)
                        : field::readSeedCell(*seeds_, index, "the field's seeds"),
            sower_);
    } catch (...) {
        lock.lock();
        making_.erase(index);
        changed_.notify_all();
        throw;
    }
    lock.lock();
    making_.erase(index);
    // It may have been replaced meanwhile.
    if (const auto found = replaced_.find(index);
        found == replaced_.end() || found->second.version == made.version)
        cached_.push_front(made);
    if (cached_.size() > keptCells)
        cached_.pop_back();
    changed_.notify_all();
    return made;
}

} // namespace sward::render
