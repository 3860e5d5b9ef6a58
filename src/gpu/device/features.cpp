#include "gpu/device/features.h"

namespace sward::gpu {
namespace {

using Member = VkBool32& (*)(FeatureChain&);

struct Required {
    const char* name;
    Member member;
};

struct Optional {
    bool OptionalFeatures::*flag;
    Member member;
};

constexpr Required required[] = {
    {"shaderInt64",
     [](FeatureChain& chain) -> VkBool32& { return chain.core.features.shaderInt64; }},
    {"tessellationShader",
     [](FeatureChain& chain) -> VkBool32& { return chain.core.features.tessellationShader; }},
    {"bufferDeviceAddress",
     [](FeatureChain& chain) -> VkBool32& { return chain.vulkan12.bufferDeviceAddress; }},
    {"scalarBlockLayout",
     [](FeatureChain& chain) -> VkBool32& { return chain.vulkan12.scalarBlockLayout; }},
    {"dynamicRendering",
     [](FeatureChain& chain) -> VkBool32& { return chain.vulkan13.dynamicRendering; }},
    {"synchronization2",
     [](FeatureChain& chain) -> VkBool32& { return chain.vulkan13.synchronization2; }},
    // glslang emits LocalSizeId for Vulkan 1.3, which requires this feature.
    {"maintenance4", [](FeatureChain& chain) -> VkBool32& { return chain.vulkan13.maintenance4; }},
};

constexpr Optional optional[] = {
    {&OptionalFeatures::wireframe,
     [](FeatureChain& chain) -> VkBool32& { return chain.core.features.fillModeNonSolid; }},
    {&OptionalFeatures::bufferInt64Atomics,
     [](FeatureChain& chain) -> VkBool32& { return chain.vulkan12.shaderBufferInt64Atomics; }},
    {&OptionalFeatures::multiDrawIndirect,
     [](FeatureChain& chain) -> VkBool32& { return chain.core.features.multiDrawIndirect; }},
    {&OptionalFeatures::drawIndirectFirstInstance,
     [](FeatureChain& chain) -> VkBool32& {
         return chain.core.features.drawIndirectFirstInstance;
     }},
    {&OptionalFeatures::drawIndirectCount,
     [](FeatureChain& chain) -> VkBool32& { return chain.vulkan12.drawIndirectCount; }},
    {&OptionalFeatures::drawParameters,
     [](FeatureChain& chain) -> VkBool32& { return chain.vulkan11.shaderDrawParameters; }},
    {&OptionalFeatures::vertexStores,
     [](FeatureChain& chain) -> VkBool32& {
         return chain.core.features.vertexPipelineStoresAndAtomics;
     }},
    {&OptionalFeatures::sampleRateShading,
     [](FeatureChain& chain) -> VkBool32& { return chain.core.features.sampleRateShading; }},
};

} // namespace

FeatureChain::FeatureChain()
{
    core.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
    vulkan11.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_FEATURES;
    vulkan12.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES;
    vulkan13.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES;
    core.pNext = &vulkan11;
    vulkan11.pNext = &vulkan12;
    vulkan12.pNext = &vulkan13;
}

std::vector<std::string> requiredFeatureNames()
{
    std::vector<std::string> names;
    for (const Required& feature : required)
        names.emplace_back(feature.name);
    return names;
}

std::vector<std::string> missingFeatures(FeatureChain& supported)
{
    std::vector<std::string> names;
    for (const Required& feature : required)
        if (feature.member(supported) == VK_FALSE)
            names.emplace_back(feature.name);
    return names;
}

OptionalFeatures enableFeatures(FeatureChain& supported, FeatureChain& wanted)
{
    OptionalFeatures enabled;
    for (const Required& feature : required)
        feature.member(wanted) = VK_TRUE;
    for (const Optional& feature : optional) {
        feature.member(wanted) = feature.member(supported);
        enabled.*feature.flag = feature.member(supported) == VK_TRUE;
    }
    return enabled;
}

} // namespace sward::gpu
