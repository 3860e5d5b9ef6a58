// Names the layer to the Vulkan loader by its environment variables.
#include "godot/native/layer.h"

#include <dlfcn.h>

#include <array>
#include <cstdlib>
#include <sstream>

namespace sward::godot {
namespace {

struct Variable {
    const char* name;
    bool isFolder;   // else the layer's name
    bool isOptional; // is extended only where the user has set it
};

// A set VK_LAYER_PATH makes the loader ignore VK_ADD_LAYER_PATH.
constexpr std::array<Variable, 3> variables{{{"VK_LAYER_PATH", true, true},
                                             {"VK_ADD_LAYER_PATH", true, false},
                                             {"VK_INSTANCE_LAYERS", false, false}}};

std::array<std::optional<std::string>, variables.size()> former;
bool isOn = false;

std::string libraryFolder()
{
    Dl_info found{};
    if (dladdr(reinterpret_cast<const void*>(&switchLayerOn), &found) == 0)
        return {};
    const std::string path = found.dli_fname;
    const std::size_t slash = path.rfind('/');
    return slash == std::string::npos ? "." : path.substr(0, slash);
}

} // namespace

bool isLeftOut(std::string_view name)
{
    const char* const value = std::getenv("SWARD_GODOT_WITHOUT");
    std::stringstream names(value != nullptr ? value : "");
    for (std::string one; std::getline(names, one, ',');)
        if (one == name)
            return true;
    return false;
}

void switchLayerOn()
{
    const std::string folder = libraryFolder();
    if (folder.empty() || isOn || isLeftOut("layer"))
        return;
    isOn = true;
    for (std::size_t i = 0; i < variables.size(); ++i) {
        const char* const old = std::getenv(variables[i].name);
        former[i] = old != nullptr ? std::optional<std::string>(old) : std::nullopt;
        if (old == nullptr && variables[i].isOptional)
            continue;
        // First in the list is next to the application: a validation layer below sees the features
        // that ours adds.
        std::string value = variables[i].isFolder ? folder : "VK_LAYER_SWARD_features";
        if (old != nullptr && *old != '\0')
            value += ":" + *former[i];
        setenv(variables[i].name, value.c_str(), 1);
    }
}

void switchLayerOff()
{
    if (!isOn)
        return;
    isOn = false;
    for (std::size_t i = 0; i < variables.size(); ++i)
        if (former[i])
            setenv(variables[i].name, former[i]->c_str(), 1);
        else
            unsetenv(variables[i].name);
}

} // namespace sward::godot
