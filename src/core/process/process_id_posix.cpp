#include "core/process/process_id.h"

#include <fmt/core.h>
#include <unistd.h>

#include <fstream>
#include <sstream>

namespace sward {
namespace {

constexpr int startField = 22; ///< of /proc/PID/stat, counted from 1

std::string firstLineOf(const std::string& path)
{
    std::ifstream in(path);
    std::string line;
    std::getline(in, line);
    return line;
}

// Start time of a process; empty if it does not run.
std::string startOf(long pid)
{
    const std::string line = firstLineOf(fmt::format("/proc/{}/stat", pid));
    // The name, field 2, may hold anything; it ends at the last bracket.
    const std::size_t end = line.rfind(')');
    if (end == std::string::npos)
        return {};
    std::istringstream rest(line.substr(end + 1));
    std::string word;
    for (int field = 3; field <= startField; ++field)
        if (!(rest >> word))
            return {};
    return word;
}

std::string currentBoot()
{
    return firstLineOf("/proc/sys/kernel/random/boot_id");
}

} // namespace

std::uint64_t processId() noexcept
{
    return static_cast<std::uint64_t>(::getpid());
}

ProcessName ProcessName::own()
{
    const auto pid = static_cast<long>(::getpid());
    return {pid, startOf(pid), currentBoot()};
}

bool ProcessName::isAlive() const
{
    return pid > 0 && !start.empty() && startOf(pid) == start && currentBoot() == boot;
}

} // namespace sward
