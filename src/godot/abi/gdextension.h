#pragma once

// The part of Godot's extension interface that Sward uses, as `godot --dump-gdextension-interface`
// describes it (Godot 4.4 and later). Names are ours; layouts and the strings in host.cpp are
// Godot's.

#include <cstdint>

extern "C" {

/// A boolean as the interface passes it.
using GodotBool = std::uint8_t;

/// Types of values, by their numbers in Godot.
enum class GodotType : std::uint32_t {
    nil = 0,
    boolean = 1,
    integer = 2, ///< 64 bits, signed
    real = 3,    ///< double precision
    string = 4,
    packedInt32 = 30,
    packedFloat32 = 32,
    packedFloat64 = 33
};

/// When Godot calls an extension: before the servers (of which one makes the Vulkan device) and
/// after them, and again in reverse order at its end.
enum class GodotLevel : std::uint32_t { core = 0, servers = 1, scene = 2, editor = 3 };

/// What the entry function of an extension fills.
struct GodotInitialization {
    GodotLevel minimumLevel;
    void* userdata;
    void (*initialize)(void* userdata, GodotLevel level);
    void (*deinitialize)(void* userdata, GodotLevel level);
};

/// Any function of Godot, found by its name.
using GodotFunction = void (*)();
using GodotGetFunction = GodotFunction (*)(const char* name);

/// How a call by Variants ended.
enum class GodotCallStatus : std::uint32_t { ok = 0, tooManyArguments = 3, tooFewArguments = 4 };

struct GodotCallError {
    GodotCallStatus status;
    std::int32_t argument;
    std::int32_t expected;
};

/// An argument or a result of a method.
struct GodotProperty {
    GodotType type;
    void* name;      ///< StringName
    void* className; ///< StringName
    std::uint32_t hint;
    void* hintString; ///< String
    std::uint32_t usage;
};

/// A class, `GDExtensionClassCreationInfo4`. Callbacks that Sward does not use stay null.
struct GodotClass {
    GodotBool isVirtual, isAbstract, isExposed, isRuntime;
    const void* iconPath;
    void* unusedProperties[7];
    void* unusedNotifications[4];
    void* (*create)(void* userdata, GodotBool notifies); ///< returns the object
    void (*destroy)(void* userdata, void* instance);
    void* unusedVirtuals[4];
    void* userdata;
};

/// A method, `GDExtensionClassMethodInfo`.
struct GodotMethod {
    void* name; ///< StringName
    void* userdata;
    void (*call)(void* userdata, void* instance, const void* const* variants, std::int64_t count,
                 void* resultVariant, GodotCallError* error);
    void (*callTyped)(void* userdata, void* instance, const void* const* values, void* result);
    std::uint32_t flags; ///< 1: a plain method
    GodotBool hasResult;
    GodotProperty* result;
    std::uint32_t resultMetadata;
    std::uint32_t argumentCount;
    GodotProperty* arguments;
    std::uint32_t* argumentMetadata;
    std::uint32_t defaultCount;
    void** defaults;
};

/// Functions of Godot that are found by a type.
using GodotConstructor = void (*)(void* value, const void* const* arguments);
using GodotDestructor = void (*)(void* value);
using GodotConversion = void (*)(void* to, void* from);
using GodotTypeMethod = void (*)(void* value, const void* const* arguments, void* result,
                                 std::int32_t count);
}
