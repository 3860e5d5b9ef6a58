#pragma once

#include "godot/abi/gdextension.h"

#include <cstdint>
#include <string>
#include <vector>

namespace sward::godot {

/// The functions of Godot that Sward calls. One table for each library, filled by loadHost().
struct Host {
    void* library = nullptr; ///< by which Godot knows this extension
    void (*registerClass)(void* library, const void* name, const void* parent,
                          const GodotClass* info) = nullptr;
    void (*unregisterClass)(void* library, const void* name) = nullptr;
    void (*registerMethod)(void* library, const void* className, const GodotMethod* info) = nullptr;
    void* (*constructObject)(const void* className) = nullptr;
    void (*setInstance)(void* object, const void* className, void* instance) = nullptr;
    void (*makeName)(void* to, const char* latin1, GodotBool isStatic) = nullptr;
    void (*makeString)(void* to, const char* utf8) = nullptr;
    std::int64_t (*readString)(const void* string, char* to, std::int64_t size) = nullptr;
    GodotConversion (*toVariant)(GodotType type) = nullptr;
    GodotConversion (*fromVariant)(GodotType type) = nullptr;
    GodotConstructor (*constructor)(GodotType type, std::int32_t number) = nullptr;
    GodotDestructor (*destructor)(GodotType type) = nullptr;
    GodotTypeMethod (*typeMethod)(GodotType type, const void* name, std::int64_t hash) = nullptr;
    float* (*float32At)(void* array, std::int64_t index) = nullptr;
    double* (*float64At)(void* array, std::int64_t index) = nullptr;
    std::int32_t* (*int32At)(void* array, std::int64_t index) = nullptr;
    void (*printError)(const char* message, const char* function, const char* file,
                       std::int32_t line, GodotBool notifiesEditor) = nullptr;
};

/// The table of this library.
Host& host();

/// Fills the table. Returns the name of a function that Godot lacks; null if it has all.
const char* loadHost(GodotGetFunction get, void* library);

/// A StringName of Godot. It is not released: some live until the library is closed, when Godot's
/// table of names is gone.
struct Name {
    alignas(8) unsigned char bytes[8];
    explicit Name(const char* text) { host().makeName(bytes, text, 0); }
};

/// How a C++ type is passed to Godot and taken from it: its type there, its value from the place of
/// an argument, and its assignment to the place of a result, which holds a valid value.
template <class Value>
struct Passed;

template <>
struct Passed<std::int64_t> {
    static constexpr GodotType type = GodotType::integer;
    static std::int64_t read(const void* from);
    static void assign(void* to, std::int64_t value);
};

template <>
struct Passed<double> {
    static constexpr GodotType type = GodotType::real;
    static double read(const void* from);
    static void assign(void* to, double value);
};

template <>
struct Passed<std::string> {
    static constexpr GodotType type = GodotType::string;
    static std::string read(const void* from);
    static void assign(void* to, const std::string& value);
};

template <>
struct Passed<std::vector<float>> {
    static constexpr GodotType type = GodotType::packedFloat32;
    static void assign(void* to, const std::vector<float>& value);
};

template <>
struct Passed<std::vector<std::int32_t>> {
    static constexpr GodotType type = GodotType::packedInt32;
    static void assign(void* to, const std::vector<std::int32_t>& value);
};

template <>
struct Passed<std::vector<double>> {
    static constexpr GodotType type = GodotType::packedFloat64;
    static std::vector<double> read(const void* from);
    static void assign(void* to, const std::vector<double>& value);
};

} // namespace sward::godot
