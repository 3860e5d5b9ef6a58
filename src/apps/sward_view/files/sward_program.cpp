#include "apps/sward_view/files/sward_program.h"

#include "core/error.h"
#include "core/process/program_path.h"

namespace sward::view {

std::filesystem::path swardProgram(const char* purpose)
{
    const std::filesystem::path own = programPath();
    std::filesystem::path program = programFile(own.parent_path() / "sward");
    if (own.empty() || !isProgram(program))
        fail(ErrorKind::io, "{}: not found; {}", program.string(), purpose);
    return program;
}

std::string plainLine(std::string_view line)
{
    std::string text;
    for (std::size_t i = 0; i < line.size(); ++i) {
        if (line[i] == '\033') {
            while (i < line.size() && !(line[i] >= '@' && line[i] <= 'z' && line[i] != '['))
                ++i;
            continue;
        }
        text += line[i];
    }
    return text;
}

} // namespace sward::view
