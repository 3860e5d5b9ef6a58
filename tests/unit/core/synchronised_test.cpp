// A file's bytes are on the disk before its name is, and the name before the program goes on. This
// program has its own fsync(), which is called in place of the C library's.

#include "core/files/atomic_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace {

std::function<void(int)>& onSync()
{
    static std::function<void(int)> called;
    return called;
}

} // namespace

extern "C" int fsync(int descriptor)
{
    if (onSync())
        onSync()(descriptor);
    return static_cast<int>(::syscall(SYS_fsync, descriptor));
}

namespace sward {
namespace {

namespace fs = std::filesystem;

/// What was synchronised: "file" or "folder", and "named" if the file had its name by then.
std::vector<std::string> synchronised(const fs::path& path, bool overwrite, bool synchronises)
{
    std::vector<std::string> seen;
    onSync() = [&](int descriptor) {
        struct stat status = {};
        ::fstat(descriptor, &status);
        const bool isNamed = fs::exists(path) && fs::file_size(path) == 3;
        seen.push_back(std::string(S_ISDIR(status.st_mode) ? "folder" : "file") +
                       (isNamed ? ", named" : ""));
    };
    AtomicFile file(path, overwrite);
    file.write("new");
    file.commit(synchronises);
    onSync() = {};
    return seen;
}

TEST(Synchronised, IsTheFileBeforeItsNameAndTheNameAfterIt)
{
    const fs::path folder =
        fs::temp_directory_path() / ("sward-synchronised-" + std::to_string(::getpid()));
    fs::create_directories(folder);
    const std::vector<std::string> wanted = {"file", "folder, named"};
    EXPECT_EQ(synchronised(folder / "a", false, true), wanted);
    writeTextFile(folder / "b", "older", false);
    EXPECT_EQ(synchronised(folder / "b", true, true), wanted);
    EXPECT_TRUE(synchronised(folder / "c", false, false).empty());
    fs::remove_all(folder);
}

} // namespace
} // namespace sward
