#pragma once

#include "godot/abi/gdextension.h"

#include <cstdint>
#include <map>
#include <string>
#include <variant>
#include <vector>

/// What the tests know of Godot: the functions that Sward's extensions ask for, strings, arrays and
/// Variants that they pass, and a table of classes.
namespace sward::played {

using Floats = std::vector<float>;
using Doubles = std::vector<double>;
using Integers = std::vector<std::int32_t>;
using Value =
    std::variant<std::monostate, std::int64_t, double, std::string, Integers, Floats, Doubles>;

/// An extension as Godot has opened it.
class Extension {
public:
    /// Opens the library, and calls its entry. Throws std::runtime_error with what is wrong.
    Extension(const std::string& library, const std::string& entry);

    void reach(GodotLevel level); ///< calls `initialize`
    void leave(GodotLevel level); ///< calls `deinitialize`
    GodotLevel minimumLevel() const { return initialization_.minimumLevel; }

private:
    GodotInitialization initialization_{};
};

/// An object of a class that an extension has registered.
class Object {
public:
    explicit Object(const std::string& className);
    ~Object();
    Object(const Object&) = delete;
    Object& operator=(const Object&) = delete;

    /// Calls a method by Variants, as a script does, and by typed values, as a compiled script
    /// does; throws std::runtime_error if there is no such method, if the number of arguments is
    /// wrong, or if a method without effects gives two results.
    Value call(const std::string& method, std::vector<Value> arguments = {},
               bool hasEffects = false);
    std::string text(const std::string& method, std::vector<Value> arguments = {});
    std::int64_t number(const std::string& method, std::vector<Value> arguments = {});

private:
    std::string class_;
    void* instance_ = nullptr;
};

/// The methods of a class with the number of their arguments; none if it is not registered.
std::map<std::string, std::size_t> methodsOf(const std::string& className);

/// What extensions have put into the error panel.
const std::vector<std::string>& errors();

/// Names of functions that this Godot claims not to have.
void hide(const std::string& function);

} // namespace sward::played
