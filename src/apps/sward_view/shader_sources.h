#pragma once

#include "core/embedded.h"

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

/// SPIR-V modules for a renderer, some of them compiled anew.
struct ShaderModules {
    std::map<std::string, std::vector<std::uint32_t>> compiled; ///< by their names
    std::vector<EmbeddedFile> files; ///< those built in, or their successors
};

/// The folder of shaders that the program was built from, or a copy: compiles what changes in it,
/// as the build does, in a thread of its own. Both programs of the build, glslangValidator and
/// spirv-val, are looked for in $PATH.
class ShaderSources {
public:
    /// `folder` is called "shaders", as includes call it; it is taken to be what is built in.
    /// Throws Error{io} if it is not there or is called otherwise.
    ShaderSources(std::filesystem::path folder, std::span<const EmbeddedFile> builtIn);
    ShaderSources(const ShaderSources&) = delete;
    ShaderSources& operator=(const ShaderSources&) = delete;
    ~ShaderSources();

    /// Looks at the folder, and compiles what stands changed at two looks in a row, with all that
    /// includes it. Never waits. Whether there are other modules than before: once everything
    /// compiles again.
    bool poll();

    /// The last ones that all compiled; null until something has changed.
    std::shared_ptr<const ShaderModules> modules() const { return modules_; }

    /// What the compiler finds wrong, with file and line; empty if nothing is.
    const std::string& complaint() const { return complaint_; }

private:
    using Look = std::map<std::string, std::filesystem::file_time_type>; ///< by the file's path
    /// A state that was compiled, or was not.
    struct Result {
        std::string state; ///< its path
        std::vector<std::uint32_t> words;
        std::set<std::string> reads; ///< it and what it includes
        std::string complaint;
    };

    Look look() const;
    void begin(std::vector<std::string> stages);
    bool end();
    Result compile(const std::string& state) const;

    std::filesystem::path folder_;
    std::filesystem::path scratch_; ///< of the compiler
    std::span<const EmbeddedFile> builtIn_;
    Look known_;                                                 ///< what was compiled
    Look last_;                                                  ///< what was seen last
    std::map<std::string, std::set<std::string>> reads_;         ///< by state, once it was compiled
    std::set<std::string> broken_;                               ///< stages that do not compile
    std::map<std::string, std::vector<std::uint32_t>> compiled_; ///< by module
    std::shared_ptr<const ShaderModules> modules_;
    std::string complaint_;

    std::thread thread_;
    std::mutex mutex_;
    bool done_ = false;
    bool ends_ = false; ///< the compiler is to stop
    std::vector<Result> results_;
};

} // namespace sward::view
