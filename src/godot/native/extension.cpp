// Entry of the extension that draws grass on Godot's own device. Its layer must be known before
// Godot makes its Vulkan instance, between the levels core and scene.
#include "godot/abi/classes.h"
#include "godot/native/layer.h"
#include "godot/native/native_grass.h"

using namespace sward::godot;

namespace {

const Class& nativeClass()
{
    static const Class type = classOf<NativeGrass>(
        "SwardNative",
        {method<&NativeGrass::start>("start"), method<&NativeGrass::load>("load"),
         method<&NativeGrass::unload>("unload"), method<&NativeGrass::apply>("apply"),
         method<&NativeGrass::place>("place"), method<&NativeGrass::resize>("resize"),
         method<&NativeGrass::colorImage>("color_image"),
         method<&NativeGrass::depthImage>("depth_image"), method<&NativeGrass::draw>("draw"),
         method<&NativeGrass::drawnBlades>("drawn_blades"), method<&NativeGrass::stop>("stop")});
    return type;
}

void initialize(void*, GodotLevel level)
{
    if (level == GodotLevel::core)
        switchLayerOn();
    if (level == GodotLevel::scene) {
        switchLayerOff();
        registerClass(nativeClass());
    }
}

void deinitialize(void*, GodotLevel level)
{
    if (level == GodotLevel::scene)
        unregisterClass(nativeClass());
}

} // namespace

/// Called by Godot when it opens the library. False if this Godot lacks a function.
extern "C" __attribute__((visibility("default"))) GodotBool
sward_native_entry(GodotGetFunction get, void* library, GodotInitialization* initialization)
{
    if (loadHost(get, library) != nullptr)
        return 0;
    initialization->minimumLevel = GodotLevel::core;
    initialization->initialize = initialize;
    initialization->deinitialize = deinitialize;
    return 1;
}
