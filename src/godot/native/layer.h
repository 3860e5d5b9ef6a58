#pragma once

#include <vulkan/vulkan.h>

#include <optional>
#include <string>
#include <string_view>

namespace sward::godot {

// A Vulkan layer in this library. Godot 4.6 asks for Vulkan 1.2 at most and enables few features;
// the layer asks for 1.3 and for those that Sward needs. It also takes turns between threads that
// use a queue: Godot submits from its loaders too, by a mutex that an extension cannot lock.

/// What the layer knows of a device that passed through it.
struct LayeredDevice {
    std::string refusal;          ///< why Sward cannot draw with it; empty if it can
    bool has64BitAtomics = false; ///< shaderBufferInt64Atomics is enabled
};

/// Nothing if the device was not made through the layer.
std::optional<LayeredDevice> layeredDevice(VkDevice device);

/// Lets the Vulkan loader find this layer, for instances that are made until switchLayerOff().
/// Changes the process's environment: call it while there is one thread.
void switchLayerOn();

/// Gives the variables their former values, so that children do not inherit the layer.
void switchLayerOff();

/// Whether the environment variable SWARD_GODOT_WITHOUT, names separated by commas, says that a
/// feature of Vulkan, `vulkan1.3` or the `layer` counts as missing.
bool isLeftOut(std::string_view name);

} // namespace sward::godot
