#include "apps/sward/output_files.h"

#include "core/atomic_file.h"
#include "core/error.h"

#include <unistd.h>

namespace sward::apps {

namespace fs = std::filesystem;

void checkOutput(const std::string& output, const std::vector<std::string>& sources, bool overwrite)
{
    for (const std::string& source : sources)
        if (fs::exists(source) && isSameFile(source, output))
            fail(ErrorKind::usage, "{}: is read and would be overwritten", output);
    refuseOverwrite(output, overwrite);
    const fs::path parent = fs::path(output).parent_path();
    const fs::path folder = parent.empty() ? fs::path(".") : parent;
    if (::access(folder.c_str(), W_OK) != 0)
        fail(ErrorKind::io, "{}: the folder {} cannot be written to", output, folder.string());
}

bool isSameFile(const fs::path& a, const fs::path& b)
{
    std::error_code ignored;
    return fs::equivalent(a, b, ignored) || fs::absolute(a, ignored).lexically_normal() ==
                                                fs::absolute(b, ignored).lexically_normal();
}

} // namespace sward::apps
