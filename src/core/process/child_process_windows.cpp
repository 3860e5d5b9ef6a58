#include "core/error.h"
#include "core/process/child_process.h"
#include "core/system/native_windows.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <utility>

namespace sward {
namespace native {

constexpr std::size_t maxWrite = std::size_t(1) << 16; // of one write into a pipe [bytes]

// The stdin of a child. A write goes on by itself; one at a time.
class ChildInput {
public:
    ChildInput() = default;
    ChildInput(const ChildInput&) = delete;
    ChildInput& operator=(const ChildInput&) = delete;
    ~ChildInput() { close(); }

    void open(Handle pipe)
    {
        pipe_ = std::move(pipe);
        done_ = Handle(::CreateEventW(nullptr, TRUE, TRUE, nullptr));
    }

    // Begins to write the first bytes, unless a write goes on. Returns how many they are.
    std::size_t begin(std::string_view bytes)
    {
        if (!pipe_.isOpen() || bytes.empty() || !isFree(FALSE))
            return 0;
        bytes_ = bytes.substr(0, maxWrite);
        place_ = {};
        place_.hEvent = done_.get();
        isWriting_ = ::WriteFile(pipe_.get(), bytes_.data(), static_cast<DWORD>(bytes_.size()),
                                 nullptr, &place_) != 0 ||
                     ::GetLastError() == ERROR_IO_PENDING;
        isBroken_ = !isWriting_;
        return isBroken_ ? 0 : bytes_.size();
    }

    // Waits for the write that goes on. Returns whether nothing has failed.
    bool wait() { return pipe_.isOpen() && isFree(TRUE); }

    void close()
    {
        if (isWriting_ && !isFree(FALSE) && isWriting_) {
            ::CancelIoEx(pipe_.get(), &place_);
            isFree(TRUE);
        }
        pipe_.close();
    }

private:
    // Whether another write may begin.
    bool isFree(BOOL waits)
    {
        DWORD written = 0;
        if (isWriting_ && ::GetOverlappedResult(pipe_.get(), &place_, &written, waits) == 0) {
            if (::GetLastError() == ERROR_IO_INCOMPLETE)
                return false;
            isBroken_ = true;
        }
        isWriting_ = false;
        return !isBroken_;
    }

    Handle pipe_;
    Handle done_;
    OVERLAPPED place_ = {};
    std::string bytes_; ///< of the write that goes on
    bool isWriting_ = false;
    bool isBroken_ = false;
};

} // namespace native

namespace {

constexpr std::size_t maxAnswered = std::size_t(4) << 20; // of one call [bytes]

// Exit codes from here on are exceptions of the system.
constexpr DWORD firstException = 0x80000000;

std::wstring wideOf(const std::string& text)
{
    const int size = static_cast<int>(text.size());
    const int length = ::MultiByteToWideChar(CP_UTF8, 0, text.data(), size, nullptr, 0);
    std::wstring wide(static_cast<std::size_t>(length), L'\0');
    ::MultiByteToWideChar(CP_UTF8, 0, text.data(), size, wide.data(), length);
    return wide;
}

// Quoted such that CommandLineToArgvW() and the C library take it apart again: backslashes count
// only before a quotation mark.
std::wstring quoted(const std::wstring& argument)
{
    std::wstring text = L"\"";
    std::size_t backslashes = 0;
    for (const wchar_t c : argument) {
        if (c == L'"')
            text.append(backslashes + 1, L'\\');
        backslashes = c == L'\\' ? backslashes + 1 : 0;
        text += c;
    }
    text.append(backslashes, L'\\');
    return text + L'"';
}

// The handle of one end of a pipe for what the child writes.
HANDLE inheritable(HANDLE handle)
{
    HANDLE copy = nullptr;
    ::DuplicateHandle(::GetCurrentProcess(), handle, ::GetCurrentProcess(), &copy, 0, TRUE,
                      DUPLICATE_SAME_ACCESS);
    return copy;
}

struct HandlePair {
    native::Handle own;
    native::Handle childs; ///< inheritable
};

// For what a child writes.
HandlePair makePipe()
{
    HANDLE read = nullptr;
    HANDLE written = nullptr;
    if (::CreatePipe(&read, &written, nullptr, 0) == 0)
        fail(ErrorKind::runtime, "cannot make a pipe: {}", native::lastReason());
    const native::Handle narrow(written);
    return {native::Handle(read), native::Handle(inheritable(written))};
}

// For what a child reads. It has a name, because only then can writing to it go on by itself.
HandlePair makeInputPipe()
{
    static std::atomic<unsigned> number = 0;
    const std::wstring name =
        std::filesystem::path(fmt::format("\\\\.\\pipe\\sward-{:x}-{:x}-{:x}",
                                          ::GetCurrentProcessId(), ::GetTickCount64(), ++number))
            .wstring();
    const HANDLE own = ::CreateNamedPipeW(
        name.c_str(), PIPE_ACCESS_OUTBOUND | FILE_FLAG_OVERLAPPED | FILE_FLAG_FIRST_PIPE_INSTANCE,
        PIPE_TYPE_BYTE | PIPE_WAIT | PIPE_REJECT_REMOTE_CLIENTS, 1, native::maxWrite, 0, 0,
        nullptr);
    if (own == INVALID_HANDLE_VALUE)
        fail(ErrorKind::runtime, "cannot make a pipe: {}", native::lastReason());
    native::Handle written(own);
    SECURITY_ATTRIBUTES inherited = {sizeof(SECURITY_ATTRIBUTES), nullptr, TRUE};
    const HANDLE read = ::CreateFileW(name.c_str(), GENERIC_READ, 0, &inherited, OPEN_EXISTING,
                                      FILE_ATTRIBUTE_NORMAL, nullptr);
    if (read == INVALID_HANDLE_VALUE)
        fail(ErrorKind::runtime, "cannot make a pipe: {}", native::lastReason());
    return {std::move(written), native::Handle(read)};
}

// Appends what has arrived, until `text` has `most` bytes. Returns whether more may come.
bool readArrived(HANDLE from, std::string& text, std::size_t most)
{
    std::array<char, 65536> buffer;
    DWORD waiting = 0;
    while (text.size() < most) {
        if (::PeekNamedPipe(from, nullptr, 0, nullptr, &waiting, nullptr) == 0)
            return false;
        if (waiting == 0)
            return true;
        DWORD count = std::min(waiting, static_cast<DWORD>(buffer.size()));
        if (::ReadFile(from, buffer.data(), count, &count, nullptr) == 0)
            return false;
        text.append(buffer.data(), count);
    }
    return true;
}

// What a child inherits. Null: it has none.
struct ChildStreams {
    HANDLE input = nullptr;
    HANDLE output = nullptr;
    HANDLE error = nullptr;
};

// Starts it such that it inherits these handles and no others. Returns whether it runs.
bool start(const std::wstring& program, std::wstring line, const ChildStreams& streams,
           PROCESS_INFORMATION& made)
{
    SIZE_T size = 0;
    ::InitializeProcThreadAttributeList(nullptr, 1, 0, &size);
    std::vector<std::byte> room(size);
    auto* const list = reinterpret_cast<LPPROC_THREAD_ATTRIBUTE_LIST>(room.data());
    if (::InitializeProcThreadAttributeList(list, 1, 0, &size) == 0)
        return false;
    // Each once.
    std::array<HANDLE, 3> inherited{streams.error};
    std::size_t count = 1;
    if (streams.output != streams.error)
        inherited[count++] = streams.output;
    if (streams.input != nullptr)
        inherited[count++] = streams.input;
    STARTUPINFOEXW how = {};
    how.StartupInfo.cb = sizeof(how);
    how.StartupInfo.dwFlags = STARTF_USESTDHANDLES;
    how.StartupInfo.hStdInput = streams.input;
    how.StartupInfo.hStdOutput = streams.output;
    how.StartupInfo.hStdError = streams.error;
    how.lpAttributeList = list;
    // A group of its own, so that it can be asked to end, and this program not.
    const bool runs =
        ::UpdateProcThreadAttribute(list, 0, PROC_THREAD_ATTRIBUTE_HANDLE_LIST, inherited.data(),
                                    count * sizeof(HANDLE), nullptr, nullptr) != 0 &&
        ::CreateProcessW(program.c_str(), line.data(), nullptr, nullptr, TRUE,
                         CREATE_NEW_PROCESS_GROUP | EXTENDED_STARTUPINFO_PRESENT, nullptr, nullptr,
                         &how.StartupInfo, &made) != 0;
    const DWORD error = ::GetLastError();
    ::DeleteProcThreadAttributeList(list);
    ::SetLastError(error);
    return runs;
}

} // namespace

struct ChildProcess::Handles {
    native::Handle child;
    native::Handle answered; ///< its stdout, if that comes by itself
    native::Handle said;
    native::ChildInput input; ///< its stdin, if this program has it
    DWORD id = 0;
    bool hasEnded = false;

    ~Handles()
    {
        if (child.isOpen() && !hasEnded) {
            ::TerminateProcess(child.get(), 1);
            ::WaitForSingleObject(child.get(), INFINITE);
        }
    }
};

ChildProcess::ChildProcess(const std::vector<std::string>& arguments, ChildTalk talk)
    : handles_(std::make_unique<Handles>())
{
    std::wstring line;
    for (const std::string& argument : arguments)
        line += (line.empty() ? L"" : L" ") + quoted(wideOf(argument));
    HandlePair said = makePipe();
    HandlePair answered = talk == ChildTalk::answers ? makePipe() : HandlePair();
    HandlePair input;
    if (talk == ChildTalk::says)
        input.childs = native::Handle(inheritable(::GetStdHandle(STD_INPUT_HANDLE)));
    else
        input = makeInputPipe();
    const ChildStreams streams{
        input.childs.get(), talk == ChildTalk::answers ? answered.childs.get() : said.childs.get(),
        said.childs.get()};
    PROCESS_INFORMATION made = {};
    if (!start(wideOf(arguments[0]), line, streams, made))
        fail(ErrorKind::runtime, "{}: cannot be run: {}", arguments[0], native::lastReason());
    ::CloseHandle(made.hThread);
    handles_->child = native::Handle(made.hProcess);
    handles_->id = made.dwProcessId;
    handles_->said = std::move(said.own);
    handles_->answered = std::move(answered.own);
    if (talk != ChildTalk::says)
        handles_->input.open(std::move(input.own));
}

ChildProcess::~ChildProcess() = default;

std::string ChildProcess::said()
{
    std::string text;
    readArrived(handles_->said.get(), text, std::string::npos);
    return text;
}

std::optional<std::string> ChildProcess::answered()
{
    std::string text;
    const bool isOpen = readArrived(handles_->answered.get(), text, maxAnswered);
    return isOpen || !text.empty() ? std::optional(std::move(text)) : std::nullopt;
}

std::size_t ChildProcess::offer(std::string_view bytes)
{
    return handles_->input.begin(bytes);
}

bool ChildProcess::give(std::string_view bytes)
{
    while (handles_->input.wait()) {
        if (bytes.empty())
            return true;
        bytes.remove_prefix(handles_->input.begin(bytes));
    }
    return false;
}

void ChildProcess::endInput()
{
    handles_->input.close();
}

std::optional<ChildProcess::End> ChildProcess::end()
{
    if (::WaitForSingleObject(handles_->child.get(), 0) != WAIT_OBJECT_0)
        return std::nullopt;
    handles_->hasEnded = true;
    DWORD code = 0;
    ::GetExitCodeProcess(handles_->child.get(), &code);
    if (code >= firstException)
        return End{std::nullopt, "exception " + std::to_string(code) + " of Windows"};
    return End{static_cast<int>(code), {}};
}

void ChildProcess::askToEnd()
{
    // Without a console there is no event to send.
    if (!handles_->hasEnded && ::GenerateConsoleCtrlEvent(CTRL_BREAK_EVENT, handles_->id) == 0)
        ::TerminateProcess(handles_->child.get(), static_cast<UINT>(ErrorKind::interrupted));
}

} // namespace sward
