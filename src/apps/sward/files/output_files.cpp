#include "apps/sward/files/output_files.h"

#include "apps/common/output.h"
#include "core/error.h"

namespace sward::apps {

namespace fs = std::filesystem;

void checkOutput(const std::string& output, std::string_view extension,
                 const std::vector<std::string>& sources, bool overwrite)
{
    for (const std::string& source : sources)
        if (fs::exists(source) && isSameFile(source, output))
            fail(ErrorKind::usage, "{}: is read and would be overwritten", output);
    requireOutput(output, extension, overwrite);
}

bool isSameFile(const fs::path& a, const fs::path& b)
{
    std::error_code ignored;
    return fs::equivalent(a, b, ignored) || fs::absolute(a, ignored).lexically_normal() ==
                                                fs::absolute(b, ignored).lexically_normal();
}

} // namespace sward::apps
