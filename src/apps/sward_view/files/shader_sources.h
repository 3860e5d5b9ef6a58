#pragma once

#include "apps/common/temporary_folder.h"
#include "core/embedded.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <span>
#include <string>
#include <thread>
#include <vector>

namespace sward::view {

/// SPIR-V modules for a renderer, some of them recompiled.
struct ShaderModules {
    std::map<std::string, std::vector<std::uint32_t>> compiled; ///< by name
    std::vector<EmbeddedFile> files; ///< built-in modules, or their replacements
};

/// A folder of shader sources. Recompiles the modules of shaders/modules.def whose sources have
/// changed, as the build does, in a separate thread.
/// Finds glslangValidator and spirv-val in $PATH.
class ShaderSources {
public:
    /// `folder` must be named "shaders", as includes expect; its content is assumed to equal the
    /// built-in one. Throws Error{io} if it is missing or named otherwise.
    ShaderSources(std::filesystem::path folder, std::span<const EmbeddedFile> builtIn);
    ShaderSources(const ShaderSources&) = delete;
    ShaderSources& operator=(const ShaderSources&) = delete;
    ~ShaderSources();

    /// Polls the folder without waiting. Compiles files changed and then stable at two polls, and
    /// their dependents. Returns whether new modules are available: only once everything compiles
    /// again.
    bool poll();

    /// The last complete set of modules; null until a change.
    std::shared_ptr<const ShaderModules> modules() const { return modules_; }

    /// Compiler errors with file and line; empty if there are none.
    const std::string& complaint() const { return complaint_; }

private:
    using Look = std::map<std::string, std::filesystem::file_time_type>; ///< by the file's path
    /// Result of compiling a module. A module is its index in shaders/modules.def.
    struct Result {
        std::size_t module = 0;
        std::vector<std::uint32_t> words;
        std::set<std::string> reads; ///< its source and includes
        std::string complaint;
    };

    Look look() const;
    std::string sourceOf(std::size_t module) const; ///< its path
    void begin(std::vector<std::size_t> touched);
    bool end();
    Result compile(std::size_t module) const;

    std::filesystem::path folder_;
    apps::TemporaryFolder scratch_{"sward-shaders"}; ///< output folder of the compiler
    std::span<const EmbeddedFile> builtIn_;
    Look known_;                                                 ///< stage at the last compilation
    Look last_;                                                  ///< stage at the last poll
    std::map<std::size_t, std::set<std::string>> reads_;         ///< by module, once compiled
    std::set<std::size_t> broken_;                               ///< modules that do not compile
    std::map<std::string, std::vector<std::uint32_t>> compiled_; ///< by file name
    std::shared_ptr<const ShaderModules> modules_;
    std::string complaint_;

    std::thread thread_;
    std::mutex mutex_;
    bool done_ = false;
    bool ends_ = false; ///< asks the compiler to stop
    std::vector<Result> results_;
};

} // namespace sward::view
