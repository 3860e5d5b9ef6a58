#include "core/error.h"
#include "core/process/child_process.h"
#include "core/system/native_windows.h"

#include <algorithm>
#include <array>

namespace sward {
namespace {

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

// Starts it such that it inherits these handles and no others. Returns whether it runs.
bool start(const std::wstring& program, std::wstring line, HANDLE input, HANDLE output,
           PROCESS_INFORMATION& made)
{
    SIZE_T size = 0;
    ::InitializeProcThreadAttributeList(nullptr, 1, 0, &size);
    std::vector<std::byte> room(size);
    auto* const list = reinterpret_cast<LPPROC_THREAD_ATTRIBUTE_LIST>(room.data());
    if (::InitializeProcThreadAttributeList(list, 1, 0, &size) == 0)
        return false;
    std::array<HANDLE, 2> inherited{output, input};
    const std::size_t count = input != nullptr ? 2 : 1;
    STARTUPINFOEXW how = {};
    how.StartupInfo.cb = sizeof(how);
    how.StartupInfo.dwFlags = STARTF_USESTDHANDLES;
    how.StartupInfo.hStdInput = input;
    how.StartupInfo.hStdOutput = output;
    how.StartupInfo.hStdError = output;
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
    HANDLE child = nullptr;
    HANDLE output = nullptr; ///< of its stdout and stderr
    DWORD id = 0;
    bool hasEnded = false;

    ~Handles()
    {
        if (child != nullptr && !hasEnded) {
            ::TerminateProcess(child, 1);
            ::WaitForSingleObject(child, INFINITE);
        }
        for (const HANDLE handle : {child, output})
            if (handle != nullptr)
                ::CloseHandle(handle);
    }
};

ChildProcess::ChildProcess(const std::vector<std::string>& arguments)
    : handles_(std::make_unique<Handles>())
{
    std::wstring line;
    for (const std::string& argument : arguments)
        line += (line.empty() ? L"" : L" ") + quoted(wideOf(argument));
    HANDLE written = nullptr;
    if (::CreatePipe(&handles_->output, &written, nullptr, 0) == 0)
        fail(ErrorKind::runtime, "cannot make a pipe: {}", native::lastReason());
    const native::Handle pipe(written);
    const native::Handle output(inheritable(written));
    const native::Handle input(inheritable(::GetStdHandle(STD_INPUT_HANDLE)));
    PROCESS_INFORMATION made = {};
    if (!start(wideOf(arguments[0]), line, input.get(), output.get(), made))
        fail(ErrorKind::runtime, "{}: cannot be run: {}", arguments[0], native::lastReason());
    ::CloseHandle(made.hThread);
    handles_->child = made.hProcess;
    handles_->id = made.dwProcessId;
}

ChildProcess::~ChildProcess() = default;

std::string ChildProcess::said()
{
    std::string text;
    std::array<char, 4096> buffer;
    DWORD waiting = 0;
    while (::PeekNamedPipe(handles_->output, nullptr, 0, nullptr, &waiting, nullptr) != 0 &&
           waiting > 0) {
        DWORD count = std::min(waiting, static_cast<DWORD>(buffer.size()));
        if (::ReadFile(handles_->output, buffer.data(), count, &count, nullptr) == 0)
            break;
        text.append(buffer.data(), count);
    }
    return text;
}

std::optional<ChildProcess::End> ChildProcess::end()
{
    if (::WaitForSingleObject(handles_->child, 0) != WAIT_OBJECT_0)
        return std::nullopt;
    handles_->hasEnded = true;
    DWORD code = 0;
    ::GetExitCodeProcess(handles_->child, &code);
    if (code >= firstException)
        return End{std::nullopt, "exception " + std::to_string(code) + " of Windows"};
    return End{static_cast<int>(code), {}};
}

void ChildProcess::askToEnd()
{
    // Without a console there is no event to send.
    if (!handles_->hasEnded && ::GenerateConsoleCtrlEvent(CTRL_BREAK_EVENT, handles_->id) == 0)
        ::TerminateProcess(handles_->child, static_cast<UINT>(ErrorKind::interrupted));
}

} // namespace sward
