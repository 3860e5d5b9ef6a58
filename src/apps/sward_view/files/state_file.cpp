#include "apps/sward_view/files/state_file.h"

#include "core/files/atomic_file.h"
#include "core/files/file_lock.h"
#include "core/files/mapped_file.h"
#include "core/process/user_folders.h"

#include <chrono>
#include <vector>

namespace sward::view {
namespace {

constexpr std::size_t largestState = std::size_t(8) << 20; ///< [bytes]
constexpr std::chrono::milliseconds statePatience{1000};   ///< with a window that changes it

} // namespace

std::filesystem::path stateFile(const std::string& name)
{
    const std::filesystem::path folder = userStateFolder();
    return folder.empty() ? folder : folder / "sward" / name;
}

std::string readState(const std::filesystem::path& file)
{
    std::error_code error;
    if (!std::filesystem::exists(file, error) && !error)
        return {};
    const std::vector<std::byte> bytes = readFile(file, largestState);
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

void changeState(const std::filesystem::path& file,
                 const std::function<std::string(const std::string&)>& change)
{
    std::error_code ignored;
    std::filesystem::create_directories(file.parent_path(), ignored);
    const FileLock lock = FileLock::take(lockNameFor(file), statePatience);
    writeTextFile(file, change(readState(file)), true);
}

std::string stateNameOf(const std::string& input)
{
    std::error_code error;
    return std::filesystem::exists(input, error) ? std::filesystem::absolute(input, error).string()
                                                 : input;
}

} // namespace sward::view
