#include "apps/sward_view/files/shader_sources.h"

#include "core/error.h"
#include "core/files/mapped_file.h"
#include "core/log.h"
#include "core/process/child_process.h"
#include "core/process/program_path.h"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>
#include <utility>

namespace sward::view {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t linesTold = 8; ///< of an error; later lines are consequential errors

struct Module {
    const char* name;
    const char* source; ///< below the folder of shaders
    const char* definitions;
};

constexpr Module table[] = {
#define SHADER_MODULE(name, source, definitions) {#name, source, definitions},
#include "shaders/modules.def"
#undef SHADER_MODULE
};

std::string fileOf(std::size_t module)
{
    return std::string(table[module].name) + ".spv";
}

std::vector<std::string> words(const std::string& text)
{
    std::istringstream in(text);
    std::vector<std::string> result;
    for (std::string word; in >> word;)
        result.push_back(word);
    return result;
}

// Reads a make dependency file: "out: a b c". The colon of a drive has no space behind it.
std::set<std::string> readDepfile(const fs::path& path)
{
    std::ifstream in(path);
    for (std::string word; in >> word && !word.ends_with(':');)
        continue;
    std::set<std::string> files;
    for (std::string file; in >> file;)
        files.insert(fs::path(file).lexically_normal().string());
    return files;
}

// Keeps the lines with a source position and drops summaries.
std::string told(const std::string& said)
{
    std::istringstream in(said);
    std::string text;
    std::size_t lines = 0;
    for (std::string line; lines < linesTold && std::getline(in, line);) {
        if (line.find("compilation errors") != std::string::npos || line.empty())
            continue;
        if (line.find("Missing entry point") != std::string::npos)
            break;
        text += (text.empty() ? "" : "\n") + line;
        ++lines;
    }
    return text;
}

bool endedWell(const ChildResult& result)
{
    return result.end.exitCode == 0;
}

std::string programOf(const char* name)
{
    const fs::path program = programNamed(name);
    if (program.empty())
        fail(ErrorKind::unsupported, "{}: is not installed; it compiles shaders", name);
    return program.string();
}

} // namespace

ShaderSources::ShaderSources(fs::path folder, std::span<const EmbeddedFile> builtIn)
    : builtIn_(builtIn)
{
    std::error_code error;
    folder_ = fs::canonical(folder, error);
    if (error || !fs::is_directory(folder_, error))
        fail(ErrorKind::io, "{}: there is no such folder of shaders", folder.string());
    if (folder_.filename() != "shaders")
        fail(ErrorKind::io, "{}: is not called 'shaders', as includes call it", folder_.string());
    known_ = last_ = look();
}

ShaderSources::~ShaderSources()
{
    {
        const std::lock_guard lock(mutex_);
        ends_ = true;
    }
    if (thread_.joinable())
        thread_.join();
}

ShaderSources::Look ShaderSources::look() const
{
    Look look;
    std::error_code error;
    for (fs::recursive_directory_iterator at(folder_, error), end; !error && at != end;
         at.increment(error)) {
        std::error_code gone;
        const fs::file_time_type time = fs::last_write_time(at->path(), gone);
        if (!gone && at->is_regular_file(gone) && !gone)
            look.emplace(at->path().string(), time);
    }
    return look;
}

std::string ShaderSources::sourceOf(std::size_t module) const
{
    return (folder_ / table[module].source).string();
}

bool ShaderSources::poll()
{
    if (thread_.joinable())
        return end();
    Look now = look();
    const bool stands = now == last_;
    last_ = std::move(now);
    if (!stands || last_ == known_)
        return false;

    std::set<std::string> changed;
    for (const auto& [path, time] : last_) {
        const auto before = known_.find(path);
        if (before == known_.end() || before->second != time)
            changed.insert(path);
    }
    for (const auto& [path, time] : known_)
        if (!last_.contains(path))
            changed.insert(path);
    known_ = last_;
    // A module that was never compiled has unknown includes: compile it.
    std::vector<std::size_t> touched;
    for (std::size_t module = 0; module < std::size(table); ++module) {
        if (!known_.contains(sourceOf(module)))
            continue;
        const auto reads = reads_.find(module);
        const bool isTouched =
            reads == reads_.end() || std::any_of(changed.begin(), changed.end(), [&](auto& file) {
                return reads->second.contains(file);
            });
        if (isTouched || broken_.contains(module))
            touched.push_back(module);
    }
    if (touched.empty())
        return false;
    // Compile the sources just edited first, so that their errors come first.
    std::stable_partition(touched.begin(), touched.end(),
                          [&](std::size_t module) { return changed.contains(sourceOf(module)); });
    begin(std::move(touched));
    return false;
}

void ShaderSources::begin(std::vector<std::size_t> touched)
{
    log::info("compiling {} shaders", touched.size());
    done_ = false;
    results_.clear();
    thread_ = std::thread([this, touched = std::move(touched)] {
        for (const std::size_t module : touched) {
            Result result;
            try {
                result = compile(module);
            } catch (const std::exception& error) {
                result = {module, {}, {}, error.what()};
            }
            const std::lock_guard lock(mutex_);
            results_.push_back(std::move(result));
            if (ends_)
                break;
        }
        const std::lock_guard lock(mutex_);
        done_ = true;
    });
}

ShaderSources::Result ShaderSources::compile(std::size_t module) const
{
    const std::string source = sourceOf(module);
    const fs::path output = scratch_.path() / fileOf(module);
    const fs::path depfile = output.string() + ".d";
    std::vector<std::string> glslang{programOf("glslangValidator")};
    for (std::string& flag : words(SWARD_GLSLANG_FLAGS))
        glslang.push_back(std::move(flag));
    for (const std::string& definition : words(table[module].definitions))
        glslang.push_back("-D" + definition);
    for (std::string& argument :
         std::vector<std::string>{"-I" + folder_.parent_path().string(), "--depfile",
                                  depfile.string(), "-o", output.string(), source})
        glslang.push_back(std::move(argument));
    ChildResult end = runChild(glslang);
    if (endedWell(end)) {
        std::vector<std::string> validator{programOf("spirv-val")};
        for (std::string& flag : words(SWARD_SPIRV_VAL_FLAGS))
            validator.push_back(std::move(flag));
        validator.push_back(output.string());
        end = runChild(validator);
    }
    if (!endedWell(end)) {
        const std::string complaint = told(end.said);
        return {module, {}, {}, complaint.empty() ? source + ": does not compile" : complaint};
    }
    const std::vector<std::byte> bytes = readFile(output);
    Result result{module,
                  std::vector<std::uint32_t>(bytes.size() / sizeof(std::uint32_t)),
                  readDepfile(depfile),
                  {}};
    std::memcpy(result.words.data(), bytes.data(), result.words.size() * sizeof(std::uint32_t));
    return result;
}

// Collects the compiled modules.
bool ShaderSources::end()
{
    {
        const std::lock_guard lock(mutex_);
        if (!done_)
            return false;
    }
    thread_.join();
    std::string complaint;
    for (Result& result : results_) {
        if (!result.complaint.empty()) {
            broken_.insert(result.module);
            if (complaint.empty())
                complaint = std::move(result.complaint);
            continue;
        }
        broken_.erase(result.module);
        reads_[result.module] = std::move(result.reads);
        compiled_[fileOf(result.module)] = std::move(result.words);
    }
    // Drop errors of deleted sources.
    std::erase_if(broken_,
                  [this](std::size_t module) { return !known_.contains(sourceOf(module)); });
    complaint_ = std::move(complaint);
    if (!complaint_.empty())
        log::error("{}", complaint_);
    if (!complaint_.empty() || !broken_.empty())
        return false;

    auto made = std::make_shared<ShaderModules>();
    made->compiled = compiled_;
    for (EmbeddedFile file : builtIn_) {
        const auto anew = made->compiled.find(std::string(file.name));
        if (anew != made->compiled.end())
            file.bytes = {reinterpret_cast<const unsigned char*>(anew->second.data()),
                          anew->second.size() * sizeof(std::uint32_t)};
        made->files.push_back(file);
    }
    modules_ = std::move(made);
    return true;
}

} // namespace sward::view
