#include "godot/abi/host.h"

#include <cstring>

namespace sward::godot {
namespace {

// Hashes of two methods of all packed arrays: of their signatures, so they are the same since 4.0.
constexpr std::int64_t sizeHash = 3173160232;
constexpr std::int64_t resizeHash = 848867239;

template <class Function>
const char* find(GodotGetFunction get, const char* name, Function& to)
{
    to = reinterpret_cast<Function>(get(name));
    return to == nullptr ? name : nullptr;
}

// Resizes the array at `to` and copies `value` there.
template <class Element>
void assignArray(GodotType type, void* to, const std::vector<Element>& value,
                 Element* (*at)(void*, std::int64_t))
{
    static const Name name("resize");
    const GodotTypeMethod resize = host().typeMethod(type, name.bytes, resizeHash);
    const auto size = static_cast<std::int64_t>(value.size());
    const void* const arguments[] = {&size};
    std::int64_t result = 0;
    resize(to, arguments, &result, 1);
    if (size > 0)
        std::memcpy(at(to, 0), value.data(), value.size() * sizeof(Element));
}

} // namespace

Host& host()
{
    static Host table;
    return table;
}

const char* loadHost(GodotGetFunction get, void* library)
{
    Host& table = host();
    table.library = library;
    const char* const missing[] = {
        find(get, "classdb_register_extension_class4", table.registerClass),
        find(get, "classdb_unregister_extension_class", table.unregisterClass),
        find(get, "classdb_register_extension_class_method", table.registerMethod),
        find(get, "classdb_construct_object2", table.constructObject),
        find(get, "object_set_instance", table.setInstance),
        find(get, "string_name_new_with_latin1_chars", table.makeName),
        find(get, "string_new_with_utf8_chars", table.makeString),
        find(get, "string_to_utf8_chars", table.readString),
        find(get, "get_variant_from_type_constructor", table.toVariant),
        find(get, "get_variant_to_type_constructor", table.fromVariant),
        find(get, "variant_get_ptr_constructor", table.constructor),
        find(get, "variant_get_ptr_destructor", table.destructor),
        find(get, "variant_get_ptr_builtin_method", table.typeMethod),
        find(get, "packed_float32_array_operator_index", table.float32At),
        find(get, "packed_float64_array_operator_index", table.float64At),
        find(get, "packed_int32_array_operator_index", table.int32At),
        find(get, "print_error", table.printError)};
    for (const char* name : missing)
        if (name != nullptr)
            return name;
    return nullptr;
}

std::int64_t Passed<std::int64_t>::read(const void* from)
{
    return *static_cast<const std::int64_t*>(from);
}

void Passed<std::int64_t>::assign(void* to, std::int64_t value)
{
    *static_cast<std::int64_t*>(to) = value;
}

double Passed<double>::read(const void* from)
{
    return *static_cast<const double*>(from);
}

void Passed<double>::assign(void* to, double value)
{
    *static_cast<double*>(to) = value;
}

std::string Passed<std::string>::read(const void* from)
{
    const std::int64_t size = host().readString(from, nullptr, 0);
    std::string text(static_cast<std::size_t>(size), '\0');
    host().readString(from, text.data(), size);
    return text;
}

void Passed<std::string>::assign(void* to, const std::string& value)
{
    host().destructor(GodotType::string)(to);
    host().makeString(to, value.c_str());
}

void Passed<std::vector<float>>::assign(void* to, const std::vector<float>& value)
{
    assignArray(type, to, value, host().float32At);
}

void Passed<std::vector<std::int32_t>>::assign(void* to, const std::vector<std::int32_t>& value)
{
    assignArray(type, to, value, host().int32At);
}

std::vector<double> Passed<std::vector<double>>::read(const void* from)
{
    static const Name name("size");
    void* const array = const_cast<void*>(from); // NOLINT(*-const-cast): neither call changes it
    std::int64_t size = 0;
    host().typeMethod(type, name.bytes, sizeHash)(array, nullptr, &size, 0);
    std::vector<double> values(static_cast<std::size_t>(size));
    if (size > 0)
        std::memcpy(values.data(), host().float64At(array, 0), values.size() * sizeof(double));
    return values;
}

void Passed<std::vector<double>>::assign(void* to, const std::vector<double>& value)
{
    assignArray(type, to, value, host().float64At);
}

} // namespace sward::godot
