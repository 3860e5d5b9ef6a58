// The laws of core's twins for Windows, those of tests/unit/core that need no call of Linux. Usage:
// system_calls FOLDER. Prints each law that does not hold; the exit code is their number. It starts
// itself as a child, with a word instead of the folder: say, wait, echo,
// hold. With the arguments of ffmpeg it writes its input into the file of the last.
#include "core/error.h"
#include "core/files/atomic_file.h"
#include "core/files/file_lock.h"
#include "core/files/mapped_file.h"
#include "core/files/new_name.h"
#include "core/files/piece_file.h"
#include "core/process/arriving_bytes.h"
#include "core/process/child_process.h"
#include "core/process/process_id.h"
#include "core/process/program_path.h"
#include "core/process/user_folders.h"
#include "core/system/arguments.h"
#include "core/system/end_requests.h"
#include "core/system/new_folder.h"
#include "core/system/peak_memory.h"
#include "core/system/shared_library.h"
#include "core/system/standard_streams.h"
#include "core/uninitialized.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <fstream>
#include <iterator>
#include <thread>

using namespace sward;
namespace fs = std::filesystem;

namespace {

int broken = 0;

void law(bool holds, const char* words)
{
    if (holds)
        return;
    fmt::print("does not hold: {}\n", words);
    ++broken;
}

template <typename Work>
std::string complaintOf(const Work& work)
{
    try {
        work();
    } catch (const Error& error) {
        return error.kind() == ErrorKind::io ? error.what() : "of another kind";
    }
    return {};
}

bool says(const std::string& complaint, const char* words)
{
    return complaint.find(words) != std::string::npos;
}

std::string contents(const fs::path& path)
{
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

std::ptrdiff_t entries(const fs::path& folder)
{
    return std::distance(fs::directory_iterator(folder), fs::directory_iterator());
}

void checkNames()
{
    const std::string text = "\xc3\xa4 \xe8\x8d\x89 \xf0\x9f\x8c\xbe.sward"; // ä 草 🌾
    law(fs::path(text).string() == text, "a path keeps its UTF-8");
    law(fs::path(text).wstring() == L"\u00e4 \u8349 \U0001f33e.sward",
        "a path is widened as UTF-8");
    for (const char* wrong :
         {"\xff", "\xc3", "\xc0\x80", "\xed\xa0\x80", "\xf4\x90\x80\x80", "\x80"}) {
        try {
            const fs::path path{std::string(wrong)};
            law(false, "a path that is no UTF-8 is refused");
        } catch (const fs::filesystem_error&) {
        }
    }
}

void checkAtomicFiles(const fs::path& folder)
{
    {
        AtomicFile file(folder / "a", false);
        file.write("half");
        law(!fs::exists(folder / "a"), "a file appears only when committed");
    }
    law(entries(folder) == 0, "nothing is left of a file that was not committed");
    writeTextFile(folder / "a", "old", false);
    law(says(complaintOf([&] { writeTextFile(folder / "a", "new", false); }), "--force"),
        "a file is not overwritten without permission");
    writeTextFile(folder / "a", "new", true);
    law(contents(folder / "a") == "new" && entries(folder) == 1, "a forced write replaces a file");
    {
        AtomicFile file(folder / "b", false);
        file.write("mine");
        std::ofstream(folder / "b") << "theirs";
        law(says(complaintOf([&] { file.commit(); }), "File exists"),
            "a file that has appeared meanwhile is not overwritten");
        law(contents(folder / "b") == "theirs", "and keeps its bytes");
    }
    {
        AtomicFile file(folder / "c", false);
        const std::string text = "abc";
        file.writeAt(5, std::as_bytes(std::span(text)));
        file.write("xy");
        file.writeAt(3, std::as_bytes(std::span(text)).first(1));
        file.write("z");
        law(contents(file.temporaryPath()).size() == 8,
            "a file can be read back before it is named");
        file.commit();
        law(contents(folder / "c") == std::string("xyza\0abc", 8),
            "bytes are taken at any place, and write() goes on where it was");
    }
    law(says(complaintOf([&] { requireWritable(folder / "no" / "a", false); }), "does not exist"),
        "a missing folder is refused");
    law(says(complaintOf([&] { requireWritable(folder, true); }), "is a folder"),
        "a folder is not replaced");
    law(says(complaintOf([&] { requireWritable("NUL", true); }), "is a device"),
        "a device is not replaced");
    writeTextFile(folder / std::string(200, 'a'), "long", false);
    law(contents(folder / std::string(200, 'a')) == "long", "a name may be long");
    law(says(complaintOf([&] { requireWritable(folder / std::string(256, 'a'), false); }), "takes"),
        "but not longer than the folder takes");
    law(entries(folder) == 4, "no temporary file is left");
}

void checkOpenFiles(const fs::path& folder)
{
    writeTextFile(folder / "open", "old bytes", false);
    const MappedFile open(folder / "open");
    // Windows 10 replaces it; an older one, or a file system that cannot, refuses.
    const std::string complaint =
        complaintOf([&] { writeTextFile(folder / "open", "new bytes", true); });
    law(std::memcmp(open.bytes().data(), "old bytes", 9) == 0, "a mapped file keeps its bytes");
    fmt::print("an open file: {}\n", complaint.empty() ? "replaced" : "not replaced");
    law(contents(folder / "open") == (complaint.empty() ? "new bytes" : "old bytes"),
        "a name has the old bytes or the new ones");
    law(complaint.empty() || says(complaint, "may have it open"), "a refusal says why");
    law(hasBeenRead(folder / "." / "open") != complaint.empty(),
        "a file that was read is known, and a new one is not");
    law(entries(folder) == 1, "no temporary file is left beside an open one");
}

void checkReading(const fs::path& folder)
{
    writeTextFile(folder / "a", "grass", false);
    const MappedFile file(folder / "a");
    law(file.bytes().size() == 5 && file.bytes()[0] == std::byte('g'), "a file is mapped as it is");
    writeTextFile(folder / "empty", "", false);
    law(MappedFile(folder / "empty").bytes().empty(), "an empty file is mapped");
    law(says(complaintOf([&] { MappedFile(folder / "missing"); }), "No such file or directory"),
        "a missing file is said to be missing");
    law(says(complaintOf([&] { MappedFile{folder}; }), "not a regular file"),
        "a folder is not mapped");
    law(readFile(folder / "a").size() == 5, "a file is read whole");
    bringIntoMemory(file.bytes());
    law(isInMemory(file.bytes()), "bytes count as present");
    const PieceFile pieces(folder / "a");
    std::string read(3, ' ');
    pieces.read(2, std::as_writable_bytes(std::span(read)));
    law(read == "ass", "a piece is read");
    law(says(complaintOf([&] { pieces.read(3, std::as_writable_bytes(std::span(read))); }), "ends"),
        "a piece beyond the end is refused");
    {
        ScratchFile scratch(folder / "a");
        const std::string text = "some text";
        scratch.append(std::as_bytes(std::span(text)));
        scratch.read(6, std::as_writable_bytes(std::span(read)));
        law(read == "ext", "a scratch file gives back its bytes");
    }
    law(entries(folder) == 2, "a scratch file goes");
}

// `self`: this program, which holds a lock as a child.
void checkLocks(const fs::path& folder, const fs::path& self)
{
    const fs::path path = folder / ".\xc3\xa4.lock";
    {
        std::optional<FileLock> held = FileLock::tryTake(path);
        law(held && held->hasMadeFile(), "a lock is taken");
        held->write("long text");
        held->write("text");
        law(held->text() == "text", "a lock file has a text");
        law(!FileLock::tryTake(path), "a lock has one holder");
        law(says(complaintOf([&] { FileLock::take(path, std::chrono::milliseconds(20)); }), "held"),
            "who waits for it is told");
        FileLock moved = std::move(*held);
        moved.removeFile();
        law(!fs::exists(path) && FileLock::tryTake(path), "its file may go, and is made again");
    }
    law(fs::exists(path), "a lock file stays");
    {
        const std::optional<FileLock> again = FileLock::tryTake(path);
        law(again && !again->hasMadeFile(), "and is taken again");
    }
    {
        ChildProcess child({self.string(), "hold", path.string()});
        while (child.said().empty() && !child.end())
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        law(!FileLock::tryTake(path), "another process has it");
    }
    law(FileLock::tryTake(path).has_value(),
        "the end of its process lets it go, however that ends");
    law(says(complaintOf([&] { FileLock::tryTake(folder / "none" / "lock"); }), "cannot be made"),
        "a missing folder takes none");
    ProcessName own = ProcessName::own();
    law(own.isAlive(), "this process is alive");
    own.start += "1";
    law(!own.isAlive(), "one with its number is another");
}

void checkNewNames(const fs::path& folder)
{
    const auto text = [&](const char* name) { return (folder / name).string(); };
    std::ofstream(folder / "from") << "mine";
    law(moveToNewName(text("from").c_str(), text("to").c_str()) == 0 &&
            contents(folder / "to") == "mine" && !fs::exists(folder / "from"),
        "a file gets a new name");
    std::ofstream(folder / "from") << "other";
    law(moveToNewName(text("from").c_str(), text("to").c_str()) == EEXIST &&
            contents(folder / "to") == "mine" && contents(folder / "from") == "other",
        "a name is never taken from another file");
}

void checkRest(const fs::path& folder)
{
    const std::size_t bytes = std::size_t(1) << 22;
    auto* const pages = static_cast<unsigned char*>(takePages(bytes));
    law(std::all_of(pages, pages + bytes, [](unsigned char c) { return c == 0; }),
        "pages are empty");
    std::memset(pages, 1, bytes);
    returnPages(pages, bytes);
    law(peakMemory() > bytes, "the largest memory counts what was written");
    const fs::path made = makeNewFolder(folder / "new");
    law(fs::is_directory(made) && made != makeNewFolder(folder / "new"), "a new folder is new");
    law(functionOf("kernel32.dll", "GetTickCount64") != nullptr, "a library gives a function");
    law(functionOf("kernel32.dll", "NoSuchFunction") == nullptr, "or null");
    law(functionOf("no-such-library.dll", "Any") == nullptr, "a missing library gives null");
    law(libraryFile("vulkan", 1) == "vulkan-1.dll", "a library has a name");
}

// Waits for the end. What it has said meanwhile goes into `said`.
ChildProcess::End endOf(ChildProcess& child, std::string& said)
{
    for (;;) {
        const std::optional<ChildProcess::End> end = child.end();
        said += child.said();
        if (end)
            return *end;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
}

void checkChildren(const fs::path& folder)
{
    const fs::path self = programPath();
    law(isProgram(self) && !isProgram(folder), "a program knows its file");
    law(programFile("a") == "a.exe", "a program has an ending");
    const std::vector<std::string> words{"a \xc3\xa4", "\"",          "\\",
                                         "",           "b\\\\\" c\\", "\xe8\x8d\x89"};
    std::vector<std::string> arguments{self.string(), "say"};
    arguments.insert(arguments.end(), words.begin(), words.end());
    ChildProcess child(arguments);
    std::string said;
    law(endOf(child, said).exitCode == 7, "a child has an exit code");
    std::string wanted;
    for (const std::string& word : words)
        wanted += word + "|";
    law(said == wanted + "error\n", "a child gets its arguments, and says what it says");

    ChildProcess waiting({self.string(), "wait"});
    said.clear();
    while (said.empty() && !waiting.end())
        said = waiting.said();
    waiting.askToEnd();
    law(endOf(waiting, said).exitCode == static_cast<int>(ErrorKind::interrupted),
        "a child ends when it is asked to");
    law(complaintOf([&] { ChildProcess missing({(folder / "missing.exe").string()}); }) ==
            "of another kind",
        "a missing program is refused");

    ChildProcess echo({self.string(), "echo"}, ChildTalk::answers);
    const std::string text(std::size_t(1) << 20, 'x');
    std::string_view rest = text;
    std::string answered;
    while (!rest.empty() && !echo.end()) {
        rest.remove_prefix(echo.offer(rest));
        answered += echo.answered().value_or("");
    }
    law(echo.give(" end"), "a child takes bytes");
    echo.endInput();
    while (const std::optional<std::string> more = echo.answered())
        answered += *more;
    law(answered == text + " end", "a child answers what it was given");
    law(echo.endWithin(std::chrono::seconds(60)) && echo.end()->exitCode == 0 &&
            echo.said() == "all\n",
        "the end of its input ends it");
    law(!echo.give("more") && echo.offer("more") == 0, "a child that has ended takes nothing");
    law(runChild({self.string(), "say", "a"}).said == "a|error\n", "a child is run to its end");
    law(programNamed("cmd").filename() == "cmd.exe" && programNamed("no-such-program").empty(),
        "a program is found by its name");
    law(userStateFolder().is_absolute() && userHomeFolder().is_absolute(), "the user has folders");

    std::ofstream(folder / "input") << "ab";
    std::FILE* const input = std::fopen((folder / "input").string().c_str(), "rb");
    std::string bytes(8, ' ');
    constexpr std::chrono::milliseconds none{0};
    law(readArriving(::_fileno(input), bytes, none) == 2u && bytes.starts_with("ab"),
        "a file arrives");
    law(readArriving(::_fileno(input), bytes, none) == 0u, "and ends");
    std::fclose(input);
    law(processId() != 0, "a process has a number");
}

std::atomic<bool> isAsked = false;

// What the program does as its own child.
int actAsChild(const std::vector<std::string>& arguments)
{
    if (arguments.at(1) == "say") {
        for (std::size_t i = 2; i < arguments.size(); ++i)
            fmt::print("{}|", arguments[i]);
        std::fflush(stdout);
        fmt::print(stderr, "error\n");
        return 7;
    }
    if (arguments.at(1) == "echo") {
        std::array<char, 4096> bytes{};
        while (const std::size_t count = std::fread(bytes.data(), 1, bytes.size(), stdin))
            std::fwrite(bytes.data(), 1, count, stdout);
        fmt::print(stderr, "all\n");
        return 0;
    }
    std::optional<FileLock> held;
    if (arguments.at(1) == "hold")
        held = FileLock::take(arguments.at(2), std::chrono::seconds(10));
    listenToEndRequests([]() noexcept { isAsked = true; });
    fmt::print("begun\n");
    std::fflush(stdout);
    while (!isAsked)
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    return static_cast<int>(ErrorKind::interrupted);
}

} // namespace

int main(int argc, char** argv)
{
    prepareStandardStreams();
    const std::vector<std::string> arguments = programArguments(argc, argv);
    if (arguments.at(1) == "-y") {
        std::ofstream film(fs::path(arguments.back()), std::ios::binary);
        std::array<char, 4096> bytes{};
        while (const std::size_t count = std::fread(bytes.data(), 1, bytes.size(), stdin))
            film.write(bytes.data(), static_cast<std::streamsize>(count));
        return 0;
    }
    for (const char* word : {"say", "wait", "echo", "hold"})
        if (arguments.at(1) == word)
            return actAsChild(arguments);
    const fs::path top = arguments.at(1);
    auto folder = [&, i = 0]() mutable {
        fs::path made = top / std::to_string(i++);
        fs::create_directories(made);
        return made;
    };
    checkNames();
    checkAtomicFiles(folder());
    checkOpenFiles(folder());
    checkReading(folder());
    checkLocks(folder(), programPath());
    checkNewNames(folder());
    checkRest(folder());
    checkChildren(folder());
    return broken;
}
