#include "apps/sward_view/files/watched_file.h"

#include <system_error>
#include <utility>

namespace sward::view {

WatchedFile::WatchedFile(std::filesystem::path path)
    : path_(std::move(path))
    , known_(look())
    , last_(known_)
    , isTold_(known_ == Look())
{
}

bool WatchedFile::hasChanged()
{
    const Look now = look();
    const bool stands = now == last_;
    last_ = now;
    isGone_ = stands && now == Look();
    if (now != Look())
        isTold_ = false;
    if (!stands || now == known_ || now == Look())
        return false;
    known_ = now;
    return true;
}

bool WatchedFile::hasGone()
{
    return isGone_ && !std::exchange(isTold_, true);
}

WatchedFile::Look WatchedFile::look() const
{
    std::error_code absent;
    Look look;
    look.written = std::filesystem::last_write_time(path_, absent);
    if (absent)
        return {};
    look.bytes = std::filesystem::file_size(path_, absent);
    return absent ? Look() : look;
}

} // namespace sward::view
