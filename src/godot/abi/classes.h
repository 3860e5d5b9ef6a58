#pragma once

#include "godot/abi/host.h"

#include <array>
#include <cstddef>
#include <exception>
#include <span>
#include <tuple>
#include <utility>

namespace sward::godot {

/// A method as Godot sees it. `call` gets the places of arguments of the given types, and that of a
/// result, which holds a valid value.
struct Method {
    const char* name;
    GodotType result; ///< nil: none
    std::vector<GodotType> arguments;
    void (*call)(void* instance, const void* const* arguments, void* result);
};

/// A class without properties, derived from RefCounted.
struct Class {
    const char* name;
    std::vector<Method> methods;
    void* (*create)();
    void (*destroy)(void* instance);
};

/// Registers a class; `type` outlives the extension.
void registerClass(const Class& type);
void unregisterClass(const Class& type);

/// Puts the message of an exception that no method expects into Godot's error panel.
void reportException(const char* what) noexcept;

namespace detail {

template <class Function>
struct MethodOf;

template <class Object, class Result, class... Arguments>
struct MethodOf<Result (Object::*)(Arguments...)> {
    static std::vector<GodotType> argumentTypes()
    {
        return {Passed<std::remove_cvref_t<Arguments>>::type...};
    }
    static constexpr GodotType resultType()
    {
        if constexpr (std::is_void_v<Result>)
            return GodotType::nil;
        else
            return Passed<Result>::type;
    }
    template <Result (Object::*function)(Arguments...)>
    static void call(void* instance, const void* const* arguments, void* result)
    {
        // No exception may reach Godot.
        try {
            [&]<std::size_t... I>(std::index_sequence<I...>)
            {
                auto* const object = static_cast<Object*>(instance);
                if constexpr (std::is_void_v<Result>)
                    (object->*function)(
                        Passed<std::remove_cvref_t<Arguments>>::read(arguments[I])...);
                else
                    Passed<Result>::assign(
                        result, (object->*function)(
                                    Passed<std::remove_cvref_t<Arguments>>::read(arguments[I])...));
            }
            (std::index_sequence_for<Arguments...>());
        } catch (const std::exception& error) {
            reportException(error.what());
        } catch (...) {
            reportException("an unknown exception");
        }
    }
};

} // namespace detail

/// The member function `function` under the name `name`.
template <auto function>
Method method(const char* name)
{
    using Of = detail::MethodOf<decltype(function)>;
    return {name, Of::resultType(), Of::argumentTypes(), &Of::template call<function>};
}

/// The class `Object`, whose objects are made without arguments.
template <class Object>
Class classOf(const char* name, std::vector<Method> methods)
{
    return {name, std::move(methods), []() -> void* { return new Object; },
            [](void* instance) { delete static_cast<Object*>(instance); }};
}

} // namespace sward::godot
