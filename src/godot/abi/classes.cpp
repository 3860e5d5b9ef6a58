#include "godot/abi/classes.h"

namespace sward::godot {
namespace {

constexpr std::size_t maxArguments = 8;

// Large enough for each type that is passed.
struct Place {
    alignas(8) unsigned char bytes[16] = {};
};

bool isOwning(GodotType type)
{
    return type == GodotType::string || type >= GodotType::packedInt32;
}

// Of a call by script: converts Variants, calls, and makes a Variant of the result.
void callByVariants(void* userdata, void* instance, const void* const* variants, std::int64_t count,
                    void* resultVariant, GodotCallError* error)
{
    const Method& method = *static_cast<const Method*>(userdata);
    const auto wanted = static_cast<std::int64_t>(method.arguments.size());
    if (count != wanted) {
        error->status =
            count < wanted ? GodotCallStatus::tooFewArguments : GodotCallStatus::tooManyArguments;
        error->expected = static_cast<std::int32_t>(wanted);
        return;
    }
    Place places[maxArguments];
    const void* arguments[maxArguments] = {};
    for (std::size_t i = 0; i < method.arguments.size(); ++i) {
        // NOLINTNEXTLINE(*-const-cast): Godot does not change what it converts.
        host().fromVariant(method.arguments[i])(places[i].bytes, const_cast<void*>(variants[i]));
        arguments[i] = places[i].bytes;
    }
    Place result;
    if (isOwning(method.result))
        host().constructor(method.result, 0)(result.bytes, nullptr);
    method.call(instance, arguments, result.bytes);
    if (method.result != GodotType::nil)
        host().toVariant(method.result)(resultVariant, result.bytes);
    if (isOwning(method.result))
        host().destructor(method.result)(result.bytes);
    for (std::size_t i = 0; i < method.arguments.size(); ++i)
        if (isOwning(method.arguments[i]))
            host().destructor(method.arguments[i])(places[i].bytes);
    error->status = GodotCallStatus::ok;
}

void callByPlaces(void* userdata, void* instance, const void* const* values, void* result)
{
    static_cast<const Method*>(userdata)->call(instance, values, result);
}

void* createObject(void* userdata, GodotBool)
{
    static const Name parent("RefCounted");
    const Class& type = *static_cast<const Class*>(userdata);
    const Name name(type.name);
    void* const object = host().constructObject(parent.bytes);
    host().setInstance(object, name.bytes, type.create());
    return object;
}

void destroyObject(void* userdata, void* instance)
{
    static_cast<const Class*>(userdata)->destroy(instance);
}

void registerMethod(const Name& className, const Method& method)
{
    const Name name(method.name);
    const Name none("");
    const Name argument("value");
    Place hint;
    host().makeString(hint.bytes, "");
    const auto property = [&](GodotType type, const Name& named) {
        constexpr std::uint32_t defaultUsage = 6; // stored, and shown by the editor
        return GodotProperty{type,
                             const_cast<unsigned char*>(named.bytes), // NOLINT(*-const-cast)
                             const_cast<unsigned char*>(none.bytes),  // NOLINT(*-const-cast)
                             0,
                             hint.bytes,
                             defaultUsage};
    };
    std::vector<GodotProperty> arguments;
    for (const GodotType type : method.arguments)
        arguments.push_back(property(type, argument));
    std::vector<std::uint32_t> metadata(arguments.size(), 0);
    GodotProperty result = property(method.result, none);
    GodotMethod info{};
    info.name = const_cast<unsigned char*>(name.bytes); // NOLINT(*-const-cast): Godot copies it
    info.userdata = const_cast<Method*>(&method);       // NOLINT(*-const-cast): read alone
    info.call = callByVariants;
    info.callTyped = callByPlaces;
    info.flags = 1;
    info.hasResult = method.result != GodotType::nil ? 1 : 0;
    info.result = &result;
    info.argumentCount = static_cast<std::uint32_t>(arguments.size());
    info.arguments = arguments.data();
    info.argumentMetadata = metadata.data();
    host().registerMethod(host().library, className.bytes, &info);
    host().destructor(GodotType::string)(hint.bytes);
}

} // namespace

void registerClass(const Class& type)
{
    const Name name(type.name);
    const Name parent("RefCounted");
    GodotClass info{};
    info.isExposed = 1;
    info.create = createObject;
    info.destroy = destroyObject;
    info.userdata = const_cast<Class*>(&type); // NOLINT(*-const-cast): read alone
    host().registerClass(host().library, name.bytes, parent.bytes, &info);
    for (const Method& method : type.methods)
        registerMethod(name, method);
}

void unregisterClass(const Class& type)
{
    const Name name(type.name);
    host().unregisterClass(host().library, name.bytes);
}

void reportException(const char* what) noexcept
{
    host().printError(what, "sward", "sward", 0, 1);
}

} // namespace sward::godot
