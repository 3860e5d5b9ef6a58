#include "apps/sward_view/paint/autosave.h"

#include "core/error.h"
#include "core/files/atomic_file.h"
#include "core/json/json_text.h"
#include "core/process/process_id.h"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <system_error>
#include <utility>

namespace sward::view {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* autosaveEnding = ".strokes.autosave";
constexpr int maxAutosaves = 1000;                      ///< of one name in a folder
constexpr std::chrono::milliseconds adoptPatience{250}; ///< others look at a lock for a moment

fs::path autosaveName(const std::string& name, int number)
{
    return name + autosaveEnding + (number == 1 ? "" : fmt::format("-{}", number)) + ".json";
}

// Whether a file name is that of an autosave of this name.
bool isAutosaveOf(const std::string& name, const std::string& file)
{
    const std::string begin = name + autosaveEnding;
    const std::string end = ".json";
    if (file.size() < begin.size() + end.size() || !file.starts_with(begin) || !file.ends_with(end))
        return false;
    const std::string number = file.substr(begin.size(), file.size() - begin.size() - end.size());
    return number.empty() || (number.size() > 1 && number[0] == '-' &&
                              std::all_of(number.begin() + 1, number.end(),
                                          [](unsigned char c) { return std::isdigit(c) != 0; }));
}

bool hasName(const fs::path& path)
{
    std::error_code ignored;
    return fs::exists(fs::symlink_status(path, ignored));
}

std::string textUnder(const json& object, const char* key)
{
    const auto found = object.is_object() ? object.find(key) : object.end();
    if (!object.is_object() || found == object.end())
        return {};
    try {
        return bytesFromJson(*found, key);
    } catch (const Error&) {
        return {};
    }
}

// What a lock file says of a painting.
std::string lockText(const AutosaveSubject& subject)
{
    const ProcessName own = ProcessName::own();
    return jsonText(json{{"input", bytesToJson(subject.input)},
                         {"ground", subject.ground},
                         {"pid", own.pid},
                         {"start", own.start},
                         {"boot", own.boot}}) +
           "\n";
}

// Whether an autosave is of this subject: the same input, or the same ground where the input has
// been moved away. One without a lock file has its name alone.
bool isOf(const AutosaveSubject& subject, const json& said)
{
    const std::string input = textUnder(said, "input");
    if (input.empty() || input == subject.input)
        return true;
    return !subject.ground.empty() && textUnder(said, "ground") == subject.ground &&
           !hasName(input);
}

// What an autosave is to a subject, if its painting has ended.
std::optional<LeftStrokes> leftIn(const AutosaveSubject& subject, const fs::path& path)
{
    std::error_code error;
    LeftStrokes left{path, fs::last_write_time(path, error), false};
    if (error)
        return std::nullopt;
    const fs::path lockFile = lockNameFor(path);
    if (!hasName(lockFile))
        return left;
    std::optional<FileLock> lock;
    try {
        lock = FileLock::tryTake(lockFile);
    } catch (const Error&) {
        return std::nullopt; // whether its painting goes on is not known
    }
    if (!lock)
        return std::nullopt;
    if (!hasName(path)) {
        lock->removeFile();
        return std::nullopt;
    }
    const json said = json::parse(lock->text(), nullptr, false);
    if (!isOf(subject, said))
        return std::nullopt;
    const std::string ground = textUnder(said, "ground");
    left.isOtherGround = !ground.empty() && !subject.ground.empty() && ground != subject.ground;
    return left;
}

} // namespace

Autosave::Autosave(AutosaveSubject subject, std::vector<fs::path> folders)
    : subject_(std::move(subject))
    , folders_(std::move(folders))
{
}

Autosave::~Autosave()
{
    if (lock_ && !hasName(path_))
        lock_->removeFile();
}

bool Autosave::adopt(const fs::path& path)
{
    if (!hasName(path))
        return false;
    std::optional<FileLock> lock;
    try {
        lock.emplace(FileLock::take(lockNameFor(path), adoptPatience));
    } catch (const Error&) {
        return false;
    }
    if (!hasName(path)) {
        lock->removeFile();
        return false;
    }
    letGo();
    try {
        lock->write(lockText(subject_));
    } catch (const Error&) {
        // Read-only, or a full disk: it is locked all the same, and says what it said before.
    }
    lock_ = std::move(lock);
    path_ = path;
    return true;
}

// Finds a name in a folder that no painting has, of one that runs or has ended.
bool Autosave::claimIn(const fs::path& folder)
{
    std::error_code error;
    fs::create_directories(folder, error);
    for (int number = 1; number <= maxAutosaves; ++number) {
        const fs::path path = folder / autosaveName(subject_.name, number);
        std::optional<FileLock> lock;
        try {
            lock = FileLock::tryTake(lockNameFor(path));
        } catch (const Error& failed) {
            trouble_ = failed.what();
            return false;
        }
        if (!lock)
            continue;
        if (hasName(path)) {
            if (lock->hasMadeFile())
                lock->removeFile();
            continue;
        }
        try {
            lock->write(lockText(subject_));
        } catch (const Error& failed) {
            trouble_ = failed.what();
            lock->removeFile();
            return false;
        }
        lock_ = std::move(lock);
        path_ = path;
        return true;
    }
    trouble_ = fmt::format("{}: has {} autosaves of {} already", folder.string(), maxAutosaves,
                           subject_.name);
    return false;
}

bool Autosave::writeIn(const fs::path& folder, std::string_view text)
{
    if (!claimIn(folder))
        return false;
    try {
        writeTextFile(path_, text, true);
        return true;
    } catch (const Error& failed) {
        trouble_ = failed.what();
        letGo();
        return false;
    }
}

void Autosave::write(std::string_view text)
{
    std::string first;
    if (lock_) {
        try {
            return writeTextFile(path_, text, true);
        } catch (const Error& failed) {
            first = failed.what();
        }
    }
    // The file before stays until another folder has the new one.
    const fs::path former = std::exchange(path_, fs::path());
    std::optional<FileLock> formerLock = std::exchange(lock_, std::nullopt);
    for (const fs::path& folder : folders_) {
        if (!former.empty() && folder == former.parent_path())
            continue;
        if (writeIn(folder, text)) {
            if (formerLock) {
                std::error_code ignored;
                fs::remove(former, ignored);
                formerLock->removeFile();
            }
            return;
        }
        if (first.empty())
            first = trouble_;
    }
    path_ = former;
    lock_ = std::move(formerLock);
    fail(ErrorKind::io, "{}", first);
}

void Autosave::remove()
{
    if (!lock_)
        return;
    std::error_code ignored;
    fs::remove(path_, ignored);
    letGo();
}

// The lock file goes with its file.
void Autosave::letGo()
{
    if (lock_ && !hasName(path_))
        lock_->removeFile();
    lock_.reset();
    path_.clear();
}

std::vector<LeftStrokes> leftStrokes(const AutosaveSubject& subject,
                                     const std::vector<fs::path>& folders)
{
    std::vector<LeftStrokes> left;
    for (const fs::path& folder : folders) {
        std::error_code ended;
        const fs::path searched = folder.empty() ? fs::path(".") : folder;
        for (auto entry = fs::directory_iterator(searched, ended);
             !ended && entry != fs::directory_iterator(); entry.increment(ended))
            if (const fs::path file = entry->path().filename();
                isAutosaveOf(subject.name, file.string()))
                if (auto one = leftIn(subject, folder / file))
                    left.push_back(std::move(*one));
    }
    std::sort(left.begin(), left.end(), [](const LeftStrokes& a, const LeftStrokes& b) {
        return a.written != b.written ? a.written > b.written : a.path < b.path;
    });
    return left;
}

bool removeLeft(const fs::path& path)
{
    std::optional<FileLock> lock = FileLock::tryTake(lockNameFor(path));
    if (!lock)
        return false;
    std::error_code error;
    fs::remove(path, error);
    if (error)
        fail(ErrorKind::io, "{}: cannot be removed: {}", path.string(), error.message());
    lock->removeFile();
    return true;
}

} // namespace sward::view
