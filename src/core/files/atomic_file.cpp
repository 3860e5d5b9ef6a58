#include "core/files/atomic_file.h"

namespace sward {

void AtomicFile::write(std::span<const std::byte> bytes)
{
    writeAt(end_, bytes);
    end_ += bytes.size();
}

void requireWritable(const std::filesystem::path& path, bool overwrite)
{
    // Nothing else tells of every reason, for any user and file system.
    const AtomicFile trial(path, overwrite);
}

void writeTextFile(const std::filesystem::path& path, std::string_view text, bool overwrite)
{
    AtomicFile file(path, overwrite);
    file.write(text);
    file.commit();
}

} // namespace sward
