#include "gpu/memory/copy_ring.h"

#include "core/expect.h"
#include "gpu/context/check.h"
#include "gpu/context/debug.h"

namespace sward::gpu {
namespace {

/// Maximum copies of one batch: the list is allocated once.
constexpr std::size_t maxCopies = 4096;

Semaphore createCounter(const DeviceContext& context, const char* name)
{
    VkSemaphoreTypeCreateInfo type{};
    type.sType = VK_STRUCTURE_TYPE_SEMAPHORE_TYPE_CREATE_INFO;
    type.semaphoreType = VK_SEMAPHORE_TYPE_TIMELINE;
    VkSemaphoreCreateInfo create{};
    create.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO;
    create.pNext = &type;
    VkSemaphore semaphore = VK_NULL_HANDLE;
    check(context.vk.CreateSemaphore(context.device, &create, context.allocation, &semaphore),
          "vkCreateSemaphore");
    setName(context, semaphore, name);
    return {context, semaphore};
}

VkSemaphoreSubmitInfo at(VkSemaphore semaphore, std::uint64_t value)
{
    VkSemaphoreSubmitInfo submit{};
    submit.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO;
    submit.semaphore = semaphore;
    submit.value = value;
    submit.stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    return submit;
}

} // namespace

CopyRing::CopyRing(const DeviceContext& context, const Buffer& target, VkDeviceSize batchBytes,
                   std::uint32_t batches, bool usesQueue)
    : context_(context)
    , target_(target)
    , batchBytes_(batchBytes)
    , hasQueue_(usesQueue && context.copyQueue != VK_NULL_HANDLE)
    , pool_(context, hasQueue_ ? context.copyQueueFamily : context.queueFamily)
{
    expect(batches >= 1, "there is a batch");
    for (std::uint32_t i = 0; i < batches; ++i) {
        Batch& batch = batches_.emplace_back();
        batch.staging = Buffer(context, {.name = "copies/staging",
                                         .bytes = batchBytes,
                                         .usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                                         .memory = MemoryUse::upload});
        batch.copies.reserve(maxCopies);
        if (hasQueue())
            batch.commands = pool_.allocate("copies");
    }
    if (hasQueue())
        done_ = createCounter(context, "copies");
}

CopyRing::~CopyRing()
{
    if (submitted_ == 0)
        return;
    // A lost device performs no copies.
    VkSemaphore semaphore = done_.get();
    VkSemaphoreWaitInfo wait{};
    wait.sType = VK_STRUCTURE_TYPE_SEMAPHORE_WAIT_INFO;
    wait.semaphoreCount = 1;
    wait.pSemaphores = &semaphore;
    wait.pValues = &submitted_;
    context_.vk.WaitSemaphores(context_.device, &wait, UINT64_MAX);
}

bool CopyRing::isDone(std::uint32_t batch)
{
    const std::uint64_t number = batches_[batch].number;
    if (number > seen_)
        check(context_.vk.GetSemaphoreCounterValue(context_.device, done_.get(), &seen_),
              "vkGetSemaphoreCounterValue");
    return number <= seen_;
}

void CopyRing::begin(std::uint32_t batch)
{
    batches_[batch].copies.clear();
    batches_[batch].used = 0;
}

std::span<std::byte> CopyRing::add(std::uint32_t index, VkDeviceSize offset, VkDeviceSize bytes)
{
    Batch& batch = batches_[index];
    if (bytes > batchBytes_ - batch.used || batch.copies.size() == maxCopies)
        return {};
    expect(offset + bytes <= target_.bytes(), "the bytes fit into the buffer");
    batch.copies.push_back({batch.used, offset, bytes});
    const auto room = batch.staging.mapped().subspan(batch.used, bytes);
    batch.used += bytes;
    return room;
}

void CopyRing::record(const Recording& commands, std::uint32_t index) const noexcept
{
    const Batch& batch = batches_[index];
    if (!batch.copies.empty())
        commands.vk->CmdCopyBuffer(commands, batch.staging.get(), target_.get(),
                                   static_cast<std::uint32_t>(batch.copies.size()),
                                   batch.copies.data());
}

void CopyRing::submit(std::uint32_t index)
{
    Batch& batch = batches_[index];
    const DeviceFunctions& vk = context_.vk;
    check(vk.ResetCommandBuffer(batch.commands, 0), "vkResetCommandBuffer");
    VkCommandBufferBeginInfo beginning{};
    beginning.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
    beginning.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    check(vk.BeginCommandBuffer(batch.commands, &beginning), "vkBeginCommandBuffer");
    record({context_, batch.commands}, index);
    check(vk.EndCommandBuffer(batch.commands), "vkEndCommandBuffer");
    VkCommandBufferSubmitInfo recorded{};
    recorded.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO;
    recorded.commandBuffer = batch.commands;
    batch.number = ++submitted_;
    const VkSemaphoreSubmitInfo signal = at(done_.get(), batch.number);
    VkSubmitInfo2 submit{};
    submit.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2;
    submit.commandBufferInfoCount = 1;
    submit.pCommandBufferInfos = &recorded;
    submit.signalSemaphoreInfoCount = 1;
    submit.pSignalSemaphoreInfos = &signal;
    check(vk.QueueSubmit2(context_.copyQueue, 1, &submit, VK_NULL_HANDLE), "vkQueueSubmit2");
}

VkSemaphoreSubmitInfo CopyRing::copied() const
{
    return at(done_.get(), seen_);
}

} // namespace sward::gpu
