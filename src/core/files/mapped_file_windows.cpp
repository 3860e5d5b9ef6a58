#include "core/error.h"
#include "core/files/mapped_file.h"
#include "core/system/native_windows.h"

#include <mutex>
#include <set>
#include <tuple>

namespace sward {
namespace {

// What tells files apart, by whatever names.
using FileId = std::tuple<DWORD, DWORD, DWORD>;

FileId idOf(const BY_HANDLE_FILE_INFORMATION& about)
{
    return {about.dwVolumeSerialNumber, about.nFileIndexHigh, about.nFileIndexLow};
}

// All files opened so far. Ground, images and fields are read in parallel.
struct ReadFiles {
    std::mutex mutex;
    std::set<FileId> ids;
};

ReadFiles& readFiles()
{
    static ReadFiles files;
    return files;
}

// Checks that a file is regular, notes that it is read, and returns its size.
std::size_t sizeOf(const native::Handle& file, const std::filesystem::path& path)
{
    if (!file.isOpen()) {
        // A folder opens only for those who ask for one.
        const std::string reason = native::lastReason();
        if (std::error_code ignored; std::filesystem::is_directory(path, ignored))
            fail(ErrorKind::io, "{}: not a regular file", path.string());
        fail(ErrorKind::io, "{}: cannot open: {}", path.string(), reason);
    }
    if (::GetFileType(file.get()) != FILE_TYPE_DISK)
        fail(ErrorKind::io, "{}: not a regular file", path.string());
    BY_HANDLE_FILE_INFORMATION about = {};
    if (::GetFileInformationByHandle(file.get(), &about) == 0)
        fail(ErrorKind::io, "{}: cannot read its size: {}", path.string(), native::lastReason());
    const std::lock_guard lock(readFiles().mutex);
    readFiles().ids.insert(idOf(about));
    return (static_cast<std::size_t>(about.nFileSizeHigh) << 32) | about.nFileSizeLow;
}

} // namespace

bool hasBeenRead(const std::filesystem::path& path)
{
    const native::Handle file(native::openShared(path.c_str(), 0));
    BY_HANDLE_FILE_INFORMATION about = {};
    if (!file.isOpen() || ::GetFileInformationByHandle(file.get(), &about) == 0)
        return false;
    const std::lock_guard lock(readFiles().mutex);
    return readFiles().ids.contains(idOf(about));
}

void forgetReadFiles()
{
    const std::lock_guard lock(readFiles().mutex);
    readFiles().ids.clear();
}

MappedFile::MappedFile(const std::filesystem::path& path)
{
    const native::Handle file(native::openShared(path.c_str(), GENERIC_READ));
    size_ = sizeOf(file, path);
    if (size_ == 0)
        return;
    // The view outlives both handles.
    const native::Handle mapping(
        ::CreateFileMappingW(file.get(), nullptr, PAGE_READONLY, 0, 0, nullptr));
    void* const mapped =
        mapping.isOpen() ? ::MapViewOfFile(mapping.get(), FILE_MAP_READ, 0, 0, size_) : nullptr;
    if (mapped == nullptr)
        fail(ErrorKind::io, "{}: cannot map {} bytes: {}", path.string(), size_,
             native::lastReason());
    data_ = static_cast<const std::byte*>(mapped);
}

MappedFile::~MappedFile()
{
    if (data_ != nullptr)
        ::UnmapViewOfFile(data_);
}

// Windows does not tell what its cache holds: the bytes count as present; reading them may wait.
bool isInMemory(std::span<const std::byte>) noexcept
{
    return true;
}

void bringIntoMemory(std::span<const std::byte> bytes) noexcept
{
    if (bytes.empty())
        return;
    WIN32_MEMORY_RANGE_ENTRY range{const_cast<std::byte*>(bytes.data()), bytes.size()};
    ::PrefetchVirtualMemory(::GetCurrentProcess(), 1, &range, 0);
}

void leaveOnDisk(std::span<const std::byte> bytes) noexcept
{
    // Unlocking what is not locked takes it out of the working set.
    if (!bytes.empty())
        ::VirtualUnlock(const_cast<std::byte*>(bytes.data()), bytes.size());
}

std::vector<std::byte> readFile(const std::filesystem::path& path, std::size_t limit)
{
    const native::Handle file(native::openShared(path.c_str(), GENERIC_READ));
    const std::size_t size = sizeOf(file, path);
    if (size > limit)
        fail(ErrorKind::input, "{}: {} bytes, more than the {} that are read", path.string(), size,
             limit);
    std::vector<std::byte> bytes(size);
    std::size_t done = 0;
    while (done < size) {
        const std::ptrdiff_t got = native::readAt(file.get(), done, std::span(bytes).subspan(done));
        if (got < 0)
            fail(ErrorKind::io, "{}: cannot read: {}", path.string(), native::lastReason());
        if (got == 0)
            break;
        done += static_cast<std::size_t>(got);
    }
    bytes.resize(done);
    return bytes;
}

} // namespace sward
