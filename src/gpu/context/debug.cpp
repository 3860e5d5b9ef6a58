#include "gpu/context/debug.h"

namespace sward::gpu {

void setName(const DeviceContext& context, VkObjectType type, std::uint64_t object,
             const std::string& name)
{
    if (context.debug.setObjectName == nullptr)
        return;
    VkDebugUtilsObjectNameInfoEXT naming{};
    naming.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT;
    naming.objectType = type;
    naming.objectHandle = object;
    naming.pObjectName = name.c_str();
    // A failure to store a name is ignored.
    context.debug.setObjectName(context.device, &naming);
}

LabelScope::LabelScope(const DeviceContext& context, VkCommandBuffer commands, const char* label)
    : context_(context)
    , commands_(commands)
{
    if (context_.debug.beginLabel == nullptr)
        return;
    VkDebugUtilsLabelEXT naming{};
    naming.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT;
    naming.pLabelName = label;
    context_.debug.beginLabel(commands_, &naming);
}

LabelScope::~LabelScope()
{
    if (context_.debug.endLabel != nullptr)
        context_.debug.endLabel(commands_);
}

} // namespace sward::gpu
