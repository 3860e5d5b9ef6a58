#include "gpu/pipeline/shared_objects.h"

#include "gpu/context/check.h"
#include "gpu/context/debug.h"

namespace sward::gpu {

std::shared_ptr<const SetLayout>
sharedSetLayout(const DeviceContext& context, const std::string& name,
                const std::vector<VkDescriptorSetLayoutBinding>& bindings)
{
    ObjectKey key;
    for (const VkDescriptorSetLayoutBinding& binding : bindings)
        key.add(binding.binding)
            .add(binding.descriptorType)
            .add(binding.descriptorCount)
            .add(binding.stageFlags);
    return madeOnce<SetLayout>(context, key, [&](const DeviceContext& owner) {
        VkDescriptorSetLayoutCreateInfo create{};
        create.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
        create.bindingCount = static_cast<std::uint32_t>(bindings.size());
        create.pBindings = bindings.data();
        VkDescriptorSetLayout layout = VK_NULL_HANDLE;
        check(owner.vk.CreateDescriptorSetLayout(owner.device, &create, owner.allocation, &layout),
              "vkCreateDescriptorSetLayout");
        setName(owner, layout, name);
        return SetLayout(owner, layout);
    });
}

} // namespace sward::gpu
