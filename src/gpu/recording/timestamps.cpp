#include "gpu/recording/timestamps.h"

#include "core/expect.h"
#include "gpu/context/check.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <utility>

namespace sward::gpu {
namespace {

constexpr std::uint32_t notMeasured = std::numeric_limits<std::uint32_t>::max();

// A query's result with its availability.
struct Query {
    std::uint64_t ticks;
    std::uint64_t isAvailable;
};

} // namespace

Timestamps::Timestamps(const DeviceContext& context, const TimestampSettings& settings)
    : context_(context)
    , settings_(settings)
    , pending_(settings.slots)
{
    expect(settings.slots > 0 && settings.scopes > 0, "there is something to measure");
    if (context.timestampValidBits == 0)
        return;
    VkQueryPoolCreateInfo create{};
    create.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO;
    create.queryType = VK_QUERY_TYPE_TIMESTAMP;
    create.queryCount = settings.slots * settings.scopes * 2;
    VkQueryPool queries = VK_NULL_HANDLE;
    check(context.vk.CreateQueryPool(context.device, &create, context.allocation, &queries),
          "vkCreateQueryPool");
    queries_ = {context, queries};
    setName(context, queries, "timestamps");
}

void Timestamps::beginFrame(VkCommandBuffer commands, std::uint32_t slot)
{
    expect(slot < settings_.slots, "the slot exists");
    collectSlot(slot);
    slot_ = slot;
    if (queries_)
        context_.vk.CmdResetQueryPool(commands, queries_.get(), firstQuery(slot),
                                      settings_.scopes * 2);
}

std::uint32_t Timestamps::begin(VkCommandBuffer commands, std::string_view name)
{
    std::vector<std::string>& names = pending_[slot_];
    if (!queries_ || names.size() == settings_.scopes)
        return notMeasured;
    const auto scope = static_cast<std::uint32_t>(names.size());
    names.emplace_back(name);
    context_.vk.CmdWriteTimestamp2(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, queries_.get(),
                                   firstQuery(slot_) + 2 * scope);
    return scope;
}

void Timestamps::end(VkCommandBuffer commands, std::uint32_t scope)
{
    if (scope != notMeasured)
        context_.vk.CmdWriteTimestamp2(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                                       queries_.get(), firstQuery(slot_) + 2 * scope + 1);
}

void Timestamps::collect()
{
    for (std::uint32_t slot = 0; slot < settings_.slots; ++slot)
        collectSlot(slot);
}

std::vector<std::string> Timestamps::names() const
{
    std::vector<std::string> names;
    names.reserve(series_.size());
    for (const Series& series : series_)
        names.push_back(series.name);
    return names;
}

std::vector<double> Timestamps::history(std::string_view name) const
{
    const auto found = std::ranges::find(series_, name, &Series::name);
    if (found == series_.end())
        return {};
    // Rotate the ring so that the latest comes last.
    std::vector<double> values = found->milliseconds;
    std::ranges::rotate(values, values.begin() + static_cast<std::ptrdiff_t>(found->next));
    return values;
}

void Timestamps::collectSlot(std::uint32_t slot)
{
    const std::vector<std::string> names = std::exchange(pending_[slot], {});
    const std::uint64_t validBits = context_.timestampValidBits >= 64
                                        ? ~std::uint64_t(0)
                                        : (std::uint64_t(1) << context_.timestampValidBits) - 1;
    using Sum = std::pair<std::string, double>;
    std::vector<Sum> sums;
    for (std::uint32_t scope = 0; scope < names.size(); ++scope) {
        // Without a result the scope is not measured; waiting for one could block forever.
        std::array<Query, 2> queries{};
        const VkResult result = context_.vk.GetQueryPoolResults(
            context_.device, queries_.get(), firstQuery(slot) + 2 * scope, 2, sizeof queries,
            queries.data(), sizeof(Query),
            VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WITH_AVAILABILITY_BIT);
        if (result == VK_NOT_READY)
            continue;
        check(result, "vkGetQueryPoolResults");
        if (queries[0].isAvailable == 0 || queries[1].isAvailable == 0)
            continue;

        // Subtract within the valid bits, so that one wrap of the counter is harmless.
        const std::uint64_t ticks = (queries[1].ticks - queries[0].ticks) & validBits;
        const double milliseconds =
            static_cast<double>(ticks) * double(context_.limits.timestampPeriod) * 1e-6;
        const auto same = std::ranges::find(sums, names[scope], &Sum::first);
        if (same == sums.end())
            sums.emplace_back(names[scope], milliseconds);
        else
            same->second += milliseconds;
    }
    for (const auto& [name, milliseconds] : sums)
        append(name, milliseconds);
}

void Timestamps::append(const std::string& name, double milliseconds)
{
    auto found = std::ranges::find(series_, name, &Series::name);
    if (found == series_.end())
        found = series_.insert(series_.end(), {.name = name, .milliseconds = {}, .next = 0});
    if (found->milliseconds.size() < settings_.historyFrames) {
        found->milliseconds.push_back(milliseconds);
        return;
    }
    found->milliseconds[found->next] = milliseconds;
    found->next = (found->next + 1) % settings_.historyFrames;
}

} // namespace sward::gpu
