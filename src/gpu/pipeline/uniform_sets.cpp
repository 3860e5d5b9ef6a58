#include "gpu/pipeline/uniform_sets.h"

#include "core/expect.h"
#include "gpu/context/check.h"
#include "gpu/context/debug.h"

namespace sward::gpu {

UniformSetLayout::UniformSetLayout(const DeviceContext& context, const std::string& name)
{
    layout_ = sharedSetLayout(
        context, name,
        {{0, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr}});
}

UniformSets::UniformSets(const DeviceContext& context, const UniformSetLayout& layout,
                         const UniformSetsSettings& settings)
    : sets_(settings.count, VK_NULL_HANDLE)
{
    expect(settings.count > 0, "there are sets");
    expect(settings.offset % uniformAlignment == 0 &&
               (settings.count == 1 || settings.bytes % uniformAlignment == 0),
           "every part lies where a device takes it");

    const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, settings.count};
    VkDescriptorPoolCreateInfo create{};
    create.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
    create.maxSets = settings.count;
    create.poolSizeCount = 1;
    create.pPoolSizes = &size;
    VkDescriptorPool pool = VK_NULL_HANDLE;
    check(context.vk.CreateDescriptorPool(context.device, &create, context.allocation, &pool),
          "vkCreateDescriptorPool");
    pool_ = {context, pool};

    const std::vector<VkDescriptorSetLayout> layouts(settings.count, layout.get());
    VkDescriptorSetAllocateInfo allocate{};
    allocate.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
    allocate.descriptorPool = pool;
    allocate.descriptorSetCount = settings.count;
    allocate.pSetLayouts = layouts.data();
    check(context.vk.AllocateDescriptorSets(context.device, &allocate, sets_.data()),
          "vkAllocateDescriptorSets");

    for (std::uint32_t i = 0; i < settings.count; ++i) {
        setName(context, sets_[i], settings.name);
        const VkDescriptorBufferInfo part{settings.buffer, settings.offset + i * settings.bytes,
                                          settings.bytes};
        VkWriteDescriptorSet change{};
        change.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
        change.dstSet = sets_[i];
        change.descriptorCount = 1;
        change.descriptorType = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
        change.pBufferInfo = &part;
        context.vk.UpdateDescriptorSets(context.device, 1, &change, 0, nullptr);
    }
}

} // namespace sward::gpu
