// Entry of the extension that reads fields. It needs no Vulkan, so that it works with each renderer
// of Godot.
#include "godot/abi/classes.h"
#include "godot/field/field_reader.h"

using namespace sward::godot;

namespace {

const Class& fieldClass()
{
    static const Class type = classOf<FieldReader>(
        "SwardFieldReader",
        {method<&FieldReader::open>("open"), method<&FieldReader::close>("close"),
         method<&FieldReader::bladeCount>("blade_count"), method<&FieldReader::origin>("origin"),
         method<&FieldReader::bounds>("bounds"), method<&FieldReader::breeze>("breeze"),
         method<&FieldReader::speciesCount>("species_count"),
         method<&FieldReader::speciesName>("species_name"), method<&FieldReader::gloss>("gloss"),
         method<&FieldReader::meshVertices>("mesh_vertices"),
         method<&FieldReader::meshIndices>("mesh_indices"),
         method<&FieldReader::groupCount>("group_count"),
         method<&FieldReader::groupPlace>("group_place"),
         method<&FieldReader::groupBounds>("group_bounds"),
         method<&FieldReader::bladeBuffer>("blade_buffer")});
    return type;
}

void initialize(void*, GodotLevel level)
{
    if (level == GodotLevel::scene)
        registerClass(fieldClass());
}

void deinitialize(void*, GodotLevel level)
{
    if (level == GodotLevel::scene)
        unregisterClass(fieldClass());
}

} // namespace

/// Called by Godot when it opens the library. False, and a line in its error panel, if this Godot
/// lacks a function.
extern "C" __attribute__((visibility("default"))) GodotBool
sward_field_entry(GodotGetFunction get, void* library, GodotInitialization* initialization)
{
    if (loadHost(get, library) != nullptr)
        return 0;
    initialization->minimumLevel = GodotLevel::scene;
    initialization->initialize = initialize;
    initialization->deinitialize = deinitialize;
    return 1;
}
