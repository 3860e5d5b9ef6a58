#include "apps/sward_view/shader_sources.h"

#include "apps/sward_view/child_process.h"
#include "core/error.h"
#include "core/log.h"
#include "core/mapped_file.h"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <sstream>
#include <utility>

namespace sward::view {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t linesTold = 8; ///< of an error; later lines are consequential errors

bool isStage(const std::string& path)
{
    constexpr std::array<std::string_view, 5> endings{".vert", ".tesc", ".tese", ".frag", ".comp"};
    return std::any_of(endings.begin(), endings.end(),
                       [&path](std::string_view ending) { return path.ends_with(ending); });
}

std::string moduleOf(const std::string& stage)
{
    return fs::path(stage).filename().string() + ".spv";
}

std::vector<std::string> words(const std::string& text)
{
    std::istringstream in(text);
    std::vector<std::string> result;
    for (std::string word; in >> word;)
        result.push_back(word);
    return result;
}

// Reads a make dependency file: "out: a b c".
std::set<std::string> readDepfile(const fs::path& path)
{
    std::ifstream in(path);
    std::string text;
    std::getline(in, text, ':');
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

bool endedWell(const ChildEnd& end)
{
    return WIFEXITED(end.status) && WEXITSTATUS(end.status) == 0;
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
    std::string name = (fs::temp_directory_path() / "sward-shaders.XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr)
        fail(ErrorKind::io, "{}: cannot make a folder: {}", name, std::strerror(errno));
    scratch_ = name;
}

ShaderSources::~ShaderSources()
{
    {
        const std::lock_guard lock(mutex_);
        ends_ = true;
    }
    if (thread_.joinable())
        thread_.join();
    std::error_code ignored;
    fs::remove_all(scratch_, ignored);
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
    // A stage that was never compiled has unknown includes: compile it.
    std::vector<std::string> stages;
    for (const auto& [path, time] : known_) {
        if (!isStage(path))
            continue;
        const auto reads = reads_.find(path);
        const bool isTouched =
            reads == reads_.end() || std::any_of(changed.begin(), changed.end(), [&](auto& file) {
                return reads->second.contains(file);
            });
        if (isTouched || broken_.contains(path))
            stages.push_back(path);
    }
    if (stages.empty())
        return false;
    // Compile the stages just edited first, so that their errors come first.
    std::stable_partition(stages.begin(), stages.end(),
                          [&](const std::string& stage) { return changed.contains(stage); });
    begin(std::move(stages));
    return false;
}

void ShaderSources::begin(std::vector<std::string> stages)
{
    log::info("compiling {} shaders", stages.size());
    done_ = false;
    results_.clear();
    thread_ = std::thread([this, stages = std::move(stages)] {
        for (const std::string& stage : stages) {
            Result result;
            try {
                result = compile(stage);
            } catch (const std::exception& error) {
                result = {stage, {}, {}, error.what()};
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

ShaderSources::Result ShaderSources::compile(const std::string& stage) const
{
    const fs::path module = scratch_ / moduleOf(stage);
    const fs::path depfile = module.string() + ".d";
    std::vector<std::string> glslang{programOf("glslangValidator")};
    for (std::string& flag : words(SWARD_GLSLANG_FLAGS))
        glslang.push_back(std::move(flag));
    for (std::string& argument :
         std::vector<std::string>{"-I" + folder_.parent_path().string(), "--depfile",
                                  depfile.string(), "-o", module.string(), stage})
        glslang.push_back(std::move(argument));
    ChildEnd end = runChild(std::move(glslang));
    if (endedWell(end)) {
        std::vector<std::string> validator{programOf("spirv-val")};
        for (std::string& flag : words(SWARD_SPIRV_VAL_FLAGS))
            validator.push_back(std::move(flag));
        validator.push_back(module.string());
        end = runChild(std::move(validator));
    }
    if (!endedWell(end)) {
        const std::string complaint = told(end.said);
        return {stage, {}, {}, complaint.empty() ? stage + ": does not compile" : complaint};
    }
    const std::vector<std::byte> bytes = readFile(module);
    Result result{stage,
                  std::vector<std::uint32_t>(bytes.size() / sizeof(std::uint32_t)),
                  readDepfile(depfile),
                  {}};
    std::memcpy(result.words.data(), bytes.data(), result.words.size() * sizeof(std::uint32_t));
    return result;
}

// Collects the compiled stages.
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
            broken_.insert(result.stage);
            if (complaint.empty())
                complaint = std::move(result.complaint);
            continue;
        }
        broken_.erase(result.stage);
        reads_[result.stage] = std::move(result.reads);
        compiled_[moduleOf(result.stage)] = std::move(result.words);
    }
    // Drop errors of deleted stages.
    std::erase_if(broken_, [this](const std::string& stage) { return !known_.contains(stage); });
    complaint_ = std::move(complaint);
    if (!complaint_.empty())
        log::error("{}", complaint_);
    if (!complaint_.empty() || !broken_.empty())
        return false;

    auto modules = std::make_shared<ShaderModules>();
    modules->compiled = compiled_;
    for (EmbeddedFile file : builtIn_) {
        const auto anew = modules->compiled.find(std::string(file.name));
        if (anew != modules->compiled.end())
            file.bytes = {reinterpret_cast<const unsigned char*>(anew->second.data()),
                          anew->second.size() * sizeof(std::uint32_t)};
        modules->files.push_back(file);
    }
    modules_ = std::move(modules);
    return true;
}

} // namespace sward::view
