#include "gpu/godot/played_godot.h"

#include <dlfcn.h>

#include <algorithm>
#include <cstring>
#include <set>
#include <stdexcept>

namespace sward::played {
namespace {

// A String and a StringName are a pointer, an array two, of which the second is used, and a Variant
// its type and 16 bytes.
template <class Content>
struct Pointer {
    Content* content;
};

template <class Element>
struct Array {
    void* unused;
    std::vector<Element>* content;
};

struct Variant {
    GodotType type;
    alignas(8) unsigned char bytes[16];
};

struct KnownMethod {
    GodotMethod info;
    GodotType result;
    std::vector<GodotType> arguments;
};

struct KnownClass {
    GodotClass info;
    std::map<std::string, KnownMethod> methods;
};

std::map<std::string, KnownClass> classes;
std::vector<std::string> said;
std::set<std::string> hidden;
void* lastInstance = nullptr;

const std::string& nameAt(const void* name)
{
    return *static_cast<const Pointer<std::string>*>(name)->content;
}

std::string textAt(const void* string)
{
    const std::string* const content = static_cast<const Pointer<std::string>*>(string)->content;
    return content != nullptr ? *content : std::string{};
}

template <class Element>
std::vector<Element>& arrayAt(void* array)
{
    auto* const typed = static_cast<Array<Element>*>(array);
    if (typed->content == nullptr)
        typed->content = new std::vector<Element>;
    return *typed->content;
}

// Writes a value into the place of an uninitialised one.
void make(GodotType type, void* to, const Value& value)
{
    std::memset(to, 0, 16);
    switch (type) {
    case GodotType::integer:
        *static_cast<std::int64_t*>(to) = std::get<std::int64_t>(value);
        break;
    case GodotType::real:
        *static_cast<double*>(to) = std::get<double>(value);
        break;
    case GodotType::string:
        static_cast<Pointer<std::string>*>(to)->content =
            new std::string(std::get<std::string>(value));
        break;
    case GodotType::packedInt32:
        arrayAt<std::int32_t>(to) = std::get<Integers>(value);
        break;
    case GodotType::packedFloat32:
        arrayAt<float>(to) = std::get<Floats>(value);
        break;
    case GodotType::packedFloat64:
        arrayAt<double>(to) = std::get<Doubles>(value);
        break;
    default:
        break;
    }
}

Value read(GodotType type, void* from)
{
    switch (type) {
    case GodotType::integer:
        return *static_cast<std::int64_t*>(from);
    case GodotType::real:
        return *static_cast<double*>(from);
    case GodotType::string:
        return textAt(from);
    case GodotType::packedInt32:
        return arrayAt<std::int32_t>(from);
    case GodotType::packedFloat32:
        return arrayAt<float>(from);
    case GodotType::packedFloat64:
        return arrayAt<double>(from);
    default:
        return {};
    }
}

template <GodotType type>
void destroy(void* value)
{
    if constexpr (type == GodotType::string)
        delete static_cast<Pointer<std::string>*>(value)->content;
    else if constexpr (type == GodotType::packedInt32)
        delete static_cast<Array<std::int32_t>*>(value)->content;
    else if constexpr (type == GodotType::packedFloat32)
        delete static_cast<Array<float>*>(value)->content;
    else if constexpr (type == GodotType::packedFloat64)
        delete static_cast<Array<double>*>(value)->content;
}

GodotDestructor destructor(GodotType type)
{
    switch (type) {
    case GodotType::string:
        return destroy<GodotType::string>;
    case GodotType::packedInt32:
        return destroy<GodotType::packedInt32>;
    case GodotType::packedFloat32:
        return destroy<GodotType::packedFloat32>;
    case GodotType::packedFloat64:
        return destroy<GodotType::packedFloat64>;
    default:
        return nullptr;
    }
}

Value nothing(GodotType type)
{
    switch (type) {
    case GodotType::integer:
        return std::int64_t(0);
    case GodotType::real:
        return 0.0;
    case GodotType::string:
        return std::string{};
    case GodotType::packedInt32:
        return Integers{};
    case GodotType::packedFloat32:
        return Floats{};
    case GodotType::packedFloat64:
        return Doubles{};
    default:
        return {};
    }
}

template <GodotType type>
void construct(void* to, const void* const*)
{
    make(type, to, nothing(type));
}

GodotConstructor constructor(GodotType type, std::int32_t number)
{
    if (number != 0)
        return nullptr;
    switch (type) {
    case GodotType::string:
        return construct<GodotType::string>;
    case GodotType::packedInt32:
        return construct<GodotType::packedInt32>;
    case GodotType::packedFloat32:
        return construct<GodotType::packedFloat32>;
    case GodotType::packedFloat64:
        return construct<GodotType::packedFloat64>;
    default:
        return nullptr;
    }
}

template <GodotType type>
void toVariantOf(void* to, void* from)
{
    auto* const variant = static_cast<Variant*>(to);
    variant->type = type;
    make(type, variant->bytes, read(type, from));
}

template <GodotType type>
void fromVariantOf(void* to, void* from)
{
    auto* const variant = static_cast<Variant*>(from);
    make(type, to, variant->type == type ? read(type, variant->bytes) : nothing(type));
}

GodotConversion toVariant(GodotType type)
{
    switch (type) {
    case GodotType::integer:
        return toVariantOf<GodotType::integer>;
    case GodotType::real:
        return toVariantOf<GodotType::real>;
    case GodotType::string:
        return toVariantOf<GodotType::string>;
    case GodotType::packedInt32:
        return toVariantOf<GodotType::packedInt32>;
    case GodotType::packedFloat32:
        return toVariantOf<GodotType::packedFloat32>;
    case GodotType::packedFloat64:
        return toVariantOf<GodotType::packedFloat64>;
    default:
        return nullptr;
    }
}

GodotConversion fromVariant(GodotType type)
{
    switch (type) {
    case GodotType::integer:
        return fromVariantOf<GodotType::integer>;
    case GodotType::real:
        return fromVariantOf<GodotType::real>;
    case GodotType::string:
        return fromVariantOf<GodotType::string>;
    case GodotType::packedFloat64:
        return fromVariantOf<GodotType::packedFloat64>;
    default:
        return nullptr;
    }
}

template <class Element>
void resize(void* array, const void* const* arguments, void* result, std::int32_t)
{
    arrayAt<Element>(array).resize(
        static_cast<std::size_t>(*static_cast<const std::int64_t*>(arguments[0])));
    *static_cast<std::int64_t*>(result) = 0;
}

void sizeOfDoubles(void* array, const void* const*, void* result, std::int32_t)
{
    *static_cast<std::int64_t*>(result) = static_cast<std::int64_t>(arrayAt<double>(array).size());
}

GodotTypeMethod typeMethod(GodotType type, const void* name, std::int64_t hash)
{
    // The hashes of Godot 4.0 to 4.6 (godot --dump-extension-api).
    if (nameAt(name) == "size" && hash == 3173160232)
        return type == GodotType::packedFloat64 ? sizeOfDoubles : nullptr;
    if (nameAt(name) != "resize" || hash != 848867239)
        return nullptr;
    return type == GodotType::packedInt32     ? resize<std::int32_t>
           : type == GodotType::packedFloat32 ? resize<float>
                                              : resize<double>;
}

template <class Element>
Element* elementAt(void* array, std::int64_t index)
{
    return &arrayAt<Element>(array).at(static_cast<std::size_t>(index));
}

void makeName(void* to, const char* text, GodotBool)
{
    static std::set<std::string> names;
    static_cast<Pointer<const std::string>*>(to)->content = &*names.insert(text).first;
}

void makeString(void* to, const char* text)
{
    make(GodotType::string, to, std::string(text));
}

std::int64_t readString(const void* string, char* to, std::int64_t size)
{
    const std::string text = textAt(string);
    if (to != nullptr)
        std::copy_n(text.begin(), std::min<std::int64_t>(size, std::ssize(text)), to);
    return std::ssize(text);
}

void registerClass(void*, const void* name, const void* parent, const GodotClass* info)
{
    if (nameAt(parent) != "RefCounted")
        throw std::runtime_error("an unknown parent " + nameAt(parent));
    classes[nameAt(name)].info = *info;
}

void unregisterClass(void*, const void* name)
{
    classes.erase(nameAt(name));
}

void registerMethod(void*, const void* className, const GodotMethod* info)
{
    KnownMethod method{*info, info->hasResult != 0 ? info->result->type : GodotType::nil, {}};
    for (std::uint32_t i = 0; i < info->argumentCount; ++i)
        method.arguments.push_back(info->arguments[i].type);
    classes.at(nameAt(className)).methods[nameAt(info->name)] = method;
}

void* constructObject(const void*)
{
    static int object;
    return &object;
}

void setInstance(void*, const void*, void* instance)
{
    lastInstance = instance;
}

void printError(const char* message, const char*, const char*, std::int32_t, GodotBool)
{
    said.emplace_back(message);
}

template <class Function>
GodotFunction plain(Function function)
{
    return reinterpret_cast<GodotFunction>(function);
}

GodotFunction find(const char* name)
{
    static const std::map<std::string, GodotFunction> functions{
        {"classdb_register_extension_class4", plain(registerClass)},
        {"classdb_unregister_extension_class", plain(unregisterClass)},
        {"classdb_register_extension_class_method", plain(registerMethod)},
        {"classdb_construct_object2", plain(constructObject)},
        {"object_set_instance", plain(setInstance)},
        {"string_name_new_with_latin1_chars", plain(makeName)},
        {"string_new_with_utf8_chars", plain(makeString)},
        {"string_to_utf8_chars", plain(readString)},
        {"get_variant_from_type_constructor", plain(toVariant)},
        {"get_variant_to_type_constructor", plain(fromVariant)},
        {"variant_get_ptr_constructor", plain(constructor)},
        {"variant_get_ptr_destructor", plain(destructor)},
        {"variant_get_ptr_builtin_method", plain(typeMethod)},
        {"packed_float32_array_operator_index", plain(elementAt<float>)},
        {"packed_float64_array_operator_index", plain(elementAt<double>)},
        {"packed_int32_array_operator_index", plain(elementAt<std::int32_t>)},
        {"print_error", plain(printError)}};
    const auto found = functions.find(name);
    return found == functions.end() || hidden.contains(name) ? nullptr : found->second;
}

GodotType typeOf(const Value& value)
{
    constexpr GodotType types[] = {GodotType::nil,          GodotType::integer,
                                   GodotType::real,         GodotType::string,
                                   GodotType::packedInt32,  GodotType::packedFloat32,
                                   GodotType::packedFloat64};
    return types[value.index()];
}

void destroyAt(GodotType type, void* value)
{
    if (const GodotDestructor function = destructor(type))
        function(value);
}

Value callByVariants(const KnownMethod& method, void* instance, const std::vector<Value>& values)
{
    std::vector<Variant> variants(values.size());
    std::vector<const void*> pointers;
    for (std::size_t i = 0; i < values.size(); ++i) {
        variants[i].type = typeOf(values[i]);
        make(variants[i].type, variants[i].bytes, values[i]);
        pointers.push_back(&variants[i]);
    }
    Variant result{};
    GodotCallError error{};
    method.info.call(method.info.userdata, instance, pointers.data(), std::ssize(values), &result,
                     &error);
    for (Variant& variant : variants)
        destroyAt(variant.type, variant.bytes);
    if (error.status != GodotCallStatus::ok)
        throw std::runtime_error("the call has a wrong number of arguments");
    const Value value = read(result.type, result.bytes);
    destroyAt(result.type, result.bytes);
    return value;
}

Value callByPlaces(const KnownMethod& method, void* instance, const std::vector<Value>& values)
{
    std::vector<Variant> places(values.size());
    std::vector<const void*> pointers;
    for (std::size_t i = 0; i < values.size(); ++i) {
        make(method.arguments[i], places[i].bytes, values[i]);
        pointers.push_back(places[i].bytes);
    }
    Variant result{};
    make(method.result, result.bytes, nothing(method.result));
    method.info.callTyped(method.info.userdata, instance, pointers.data(), result.bytes);
    for (std::size_t i = 0; i < values.size(); ++i)
        destroyAt(method.arguments[i], places[i].bytes);
    const Value value = read(method.result, result.bytes);
    destroyAt(method.result, result.bytes);
    return value;
}

} // namespace

Extension::Extension(const std::string& library, const std::string& entry)
{
    void* const opened = dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (opened == nullptr)
        throw std::runtime_error(dlerror());
    using Entry = GodotBool (*)(GodotGetFunction, void*, GodotInitialization*);
    const auto function = reinterpret_cast<Entry>(dlsym(opened, entry.c_str()));
    if (function == nullptr)
        throw std::runtime_error("there is no " + entry);
    if (function(find, this, &initialization_) == 0)
        throw std::runtime_error(entry + " has refused");
}

void Extension::reach(GodotLevel level)
{
    initialization_.initialize(initialization_.userdata, level);
}

void Extension::leave(GodotLevel level)
{
    initialization_.deinitialize(initialization_.userdata, level);
}

Object::Object(const std::string& className)
    : class_(className)
{
    const GodotClass& info = classes.at(className).info;
    info.create(info.userdata, 1);
    instance_ = lastInstance;
}

Object::~Object()
{
    const GodotClass& info = classes.at(class_).info;
    info.destroy(info.userdata, instance_);
}

Value Object::call(const std::string& method, std::vector<Value> arguments, bool hasEffects)
{
    const auto& methods = classes.at(class_).methods;
    const auto found = methods.find(method);
    if (found == methods.end())
        throw std::runtime_error(class_ + " has no method " + method);
    const Value result = callByVariants(found->second, instance_, arguments);
    if (!hasEffects && result != callByPlaces(found->second, instance_, arguments))
        throw std::runtime_error(method + " differs between the two ways to call it");
    return result;
}

std::string Object::text(const std::string& method, std::vector<Value> arguments)
{
    return std::get<std::string>(call(method, std::move(arguments), true));
}

std::int64_t Object::number(const std::string& method, std::vector<Value> arguments)
{
    return std::get<std::int64_t>(call(method, std::move(arguments), true));
}

std::map<std::string, std::size_t> methodsOf(const std::string& className)
{
    std::map<std::string, std::size_t> found;
    if (const auto known = classes.find(className); known != classes.end())
        for (const auto& [name, method] : known->second.methods)
            found[name] = method.arguments.size();
    return found;
}

const std::vector<std::string>& errors()
{
    return said;
}

void hide(const std::string& function)
{
    hidden.insert(function);
}

} // namespace sward::played
