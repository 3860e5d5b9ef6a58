#include "core/error.h"
#include "core/process/child_process.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <utility>

namespace sward {
namespace native {

// Closes a file descriptor.
class OwnDescriptor {
public:
    OwnDescriptor() = default;
    explicit OwnDescriptor(int fd)
        : fd_(fd)
    {
    }
    OwnDescriptor(OwnDescriptor&& other) noexcept
        : fd_(std::exchange(other.fd_, -1))
    {
    }
    OwnDescriptor& operator=(OwnDescriptor&& other) noexcept
    {
        std::swap(fd_, other.fd_);
        return *this;
    }
    ~OwnDescriptor() { close(); }

    int get() const { return fd_; }
    void close()
    {
        if (fd_ >= 0)
            ::close(std::exchange(fd_, -1));
    }

private:
    int fd_ = -1;
};

} // namespace native

namespace {

constexpr std::size_t maxAnswered = std::size_t(4) << 20; // of one call [bytes]

struct DescriptorPair {
    native::OwnDescriptor own;
    native::OwnDescriptor childs;
};

// For what a child writes. Reading never waits.
DescriptorPair makePipe()
{
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0)
        fail(ErrorKind::runtime, "cannot make a pipe: {}", std::strerror(errno));
    ::fcntl(ends[0], F_SETFL, O_NONBLOCK);
    return {native::OwnDescriptor(ends[0]), native::OwnDescriptor(ends[1])};
}

// For what a child reads. A socket: writing to one whose reader has died can avoid SIGPIPE.
DescriptorPair makeSocket()
{
    std::array<int, 2> ends{};
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
        fail(ErrorKind::runtime, "cannot make a socket: {}", std::strerror(errno));
    return {native::OwnDescriptor(ends[0]), native::OwnDescriptor(ends[1])};
}

// Appends what has arrived, until `text` has `most` bytes. Returns whether more may come.
bool readArrived(int from, std::string& text, std::size_t most)
{
    std::array<char, 65536> buffer;
    while (text.size() < most) {
        const ssize_t count = ::read(from, buffer.data(), buffer.size());
        if (count > 0)
            text.append(buffer.data(), static_cast<std::size_t>(count));
        else if (count == 0 || (errno != EINTR && errno != EAGAIN))
            return false;
        else if (errno == EAGAIN)
            return true;
    }
    return true;
}

} // namespace

struct ChildProcess::Handles {
    pid_t child = -1;
    native::OwnDescriptor input;    ///< its stdin, if this program has it
    native::OwnDescriptor answered; ///< its stdout, if that comes by itself
    native::OwnDescriptor said;
    std::optional<End> end;

    ~Handles()
    {
        if (child > 0 && !end) {
            ::kill(child, SIGKILL);
            int status = 0;
            while (::waitpid(child, &status, 0) < 0 && errno == EINTR)
                continue;
        }
    }
};

ChildProcess::ChildProcess(const std::vector<std::string>& arguments, ChildTalk talk)
    : handles_(std::make_unique<Handles>())
{
    std::vector<std::string> copies = arguments;
    std::vector<char*> pointers;
    for (std::string& argument : copies)
        pointers.push_back(argument.data());
    pointers.push_back(nullptr);
    DescriptorPair said = makePipe();
    DescriptorPair input = talk == ChildTalk::says ? DescriptorPair() : makeSocket();
    DescriptorPair answered = talk == ChildTalk::answers ? makePipe() : DescriptorPair();
    posix_spawn_file_actions_t actions;
    ::posix_spawn_file_actions_init(&actions);
    if (talk != ChildTalk::says)
        ::posix_spawn_file_actions_adddup2(&actions, input.childs.get(), STDIN_FILENO);
    // Its stdout too, because that of this program carries this program's result.
    ::posix_spawn_file_actions_adddup2(
        &actions, talk == ChildTalk::answers ? answered.childs.get() : said.childs.get(),
        STDOUT_FILENO);
    ::posix_spawn_file_actions_adddup2(&actions, said.childs.get(), STDERR_FILENO);
    const int error =
        ::posix_spawn(&handles_->child, pointers[0], &actions, nullptr, pointers.data(), environ);
    ::posix_spawn_file_actions_destroy(&actions);
    if (error != 0) {
        handles_->child = -1;
        fail(ErrorKind::runtime, "{}: cannot be run: {}", arguments[0], std::strerror(error));
    }
    handles_->input = std::move(input.own);
    handles_->answered = std::move(answered.own);
    handles_->said = std::move(said.own);
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
    std::size_t taken = 0;
    while (taken < bytes.size()) {
        const ssize_t count = ::send(handles_->input.get(), bytes.data() + taken,
                                     bytes.size() - taken, MSG_NOSIGNAL | MSG_DONTWAIT);
        if (count > 0)
            taken += static_cast<std::size_t>(count);
        else if (errno != EINTR)
            break;
    }
    return taken;
}

bool ChildProcess::give(std::string_view bytes)
{
    while (!bytes.empty()) {
        const ssize_t count =
            ::send(handles_->input.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
        if (count > 0)
            bytes.remove_prefix(static_cast<std::size_t>(count));
        else if (errno != EINTR)
            return false;
    }
    return true;
}

void ChildProcess::endInput()
{
    handles_->input.close();
}

std::optional<ChildProcess::End> ChildProcess::end()
{
    int status = 0;
    if (!handles_->end && ::waitpid(handles_->child, &status, WNOHANG) == handles_->child) {
        handles_->end.emplace();
        if (WIFEXITED(status))
            handles_->end->exitCode = WEXITSTATUS(status);
        else if (WIFSIGNALED(status))
            handles_->end->reason = "signal " + std::to_string(WTERMSIG(status)) + " (" +
                                    ::strsignal(WTERMSIG(status)) + ")";
    }
    return handles_->end;
}

void ChildProcess::askToEnd()
{
    if (!handles_->end)
        ::kill(handles_->child, SIGTERM);
}

} // namespace sward
