#include "core/error.h"
#include "core/files/atomic_file.h"
#include "core/files/new_name.h"
#include "core/system/native_windows.h"

#include <io.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <string>

namespace sward {
namespace {

namespace fs = std::filesystem;

// Names of the temporary files, for a listener of end requests, which runs on a thread of its own.
// One that finds no place is not removed there.
std::array<std::atomic<const wchar_t*>, 64> temporaryNames{};

void announce(const wchar_t* name)
{
    for (std::atomic<const wchar_t*>& place : temporaryNames) {
        const wchar_t* empty = nullptr;
        if (place.compare_exchange_strong(empty, name))
            return;
    }
}

void forget(const wchar_t* name)
{
    for (std::atomic<const wchar_t*>& place : temporaryNames) {
        const wchar_t* own = name;
        if (place.compare_exchange_strong(own, nullptr))
            return;
    }
}

constexpr std::size_t maxName = 255; ///< of NTFS and FAT [units of UTF-16]

fs::path folderOf(const fs::path& path)
{
    const fs::path parent = path.parent_path();
    return parent.empty() ? fs::path(".") : parent;
}

bool isSameFile(HANDLE a, HANDLE b)
{
    BY_HANDLE_FILE_INFORMATION first = {};
    BY_HANDLE_FILE_INFORMATION second = {};
    return ::GetFileType(a) == FILE_TYPE_DISK && ::GetFileType(b) == FILE_TYPE_DISK &&
           ::GetFileInformationByHandle(a, &first) != 0 &&
           ::GetFileInformationByHandle(b, &second) != 0 &&
           first.dwVolumeSerialNumber == second.dwVolumeSerialNumber &&
           first.nFileIndexHigh == second.nFileIndexHigh &&
           first.nFileIndexLow == second.nFileIndexLow;
}

// Only a regular file may be replaced, and none that this program prints to.
void requireReplaceable(const fs::path& path)
{
    const DWORD attributes = ::GetFileAttributesW(path.c_str());
    if (attributes != INVALID_FILE_ATTRIBUTES && (attributes & FILE_ATTRIBUTE_DIRECTORY) != 0)
        fail(ErrorKind::io, "{}: is a folder, not a file to write", path.string());
    const native::Handle file(native::openShared(path.c_str(), 0));
    if (!file.isOpen())
        return;
    if (::GetFileType(file.get()) != FILE_TYPE_DISK)
        fail(ErrorKind::io, "{}: is a device, not a file to write", path.string());
    for (const DWORD printed : {STD_OUTPUT_HANDLE, STD_ERROR_HANDLE})
        if (isSameFile(::GetStdHandle(printed), file.get()))
            fail(ErrorKind::io, "{}: is what this program prints to", path.string());
}

// ".NAME.", where NAME is shortened to what a folder takes with `createNew`'s letters after it.
fs::path temporaryStart(const fs::path& target)
{
    constexpr std::size_t added = 40;
    std::wstring name = target.filename().wstring();
    if (name.size() + added > maxName)
        name.resize(maxName - added);
    // A character may take two units.
    if (!name.empty() && name.back() >= 0xd800 && name.back() < 0xdc00)
        name.pop_back();
    return folderOf(target) / (L"." + name + L".");
}

// FileRenameInfoEx, which the headers of mingw-w64 10 hide.
constexpr auto renameInfoEx = static_cast<FILE_INFO_BY_HANDLE_CLASS>(22);

// Renames over a file that others may have open: they keep the old bytes. Returns 0 or an errno.
int replace(const fs::path& from, const fs::path& to)
{
    // What Windows 10 has, and file systems other than NTFS lack, replaces an open file as well.
    const std::wstring name = fs::absolute(to).wstring();
    const std::size_t bytes = name.size() * sizeof(wchar_t);
    std::string request(sizeof(FILE_RENAME_INFO) + bytes, '\0');
    auto* const rename = reinterpret_cast<FILE_RENAME_INFO*>(request.data());
    rename->Flags = FILE_RENAME_FLAG_REPLACE_IF_EXISTS | FILE_RENAME_FLAG_POSIX_SEMANTICS;
    rename->FileNameLength = static_cast<DWORD>(bytes);
    std::memcpy(rename->FileName, name.data(), bytes);
    if (const native::Handle file(native::openShared(from.c_str(), DELETE | SYNCHRONIZE));
        file.isOpen() && ::SetFileInformationByHandle(file.get(), renameInfoEx, rename,
                                                      static_cast<DWORD>(request.size())) != 0)
        return 0;
    if (::MoveFileExW(from.c_str(), to.c_str(),
                      MOVEFILE_REPLACE_EXISTING | MOVEFILE_WRITE_THROUGH) != 0)
        return 0;
    return native::errnoOf(::GetLastError());
}

} // namespace

void refuseOverwrite(const fs::path& path, bool overwrite)
{
    requireReplaceable(path);
    std::error_code ignored;
    if (!overwrite && fs::exists(path, ignored))
        fail(ErrorKind::io, "{}: exists already; --force overwrites it", path.string());
    const fs::path folder = folderOf(path);
    if (fs::exists(folder, ignored) && !fs::is_directory(folder, ignored))
        fail(ErrorKind::io, "{}: {} is no folder", path.string(), folder.string());
    if (!fs::is_directory(folder, ignored))
        fail(ErrorKind::io, "{}: the folder {} does not exist", path.string(), folder.string());
    const std::wstring name = path.filename().wstring();
    if (name.empty())
        fail(ErrorKind::io, "{}: has no file name", path.string());
    if (name.size() > maxName)
        fail(ErrorKind::io, "{}: its name has {} letters; the folder {} takes up to {}",
             path.string(), name.size(), folder.string(), maxName);
}

AtomicFile::AtomicFile(fs::path path, bool overwrite)
    : path_(std::move(path))
    , overwrite_(overwrite)
{
    refuseOverwrite(path_, overwrite);
    target_ = path_;
    // The temporary name is in the same folder, so that the rename stays on one file system.
    native::NewFile made = native::createNew(temporaryStart(target_),
                                             FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE,
                                             FILE_ATTRIBUTE_NORMAL);
    fd_ = made.descriptor;
    if (fd_ < 0)
        fail(ErrorKind::io, "{}: the folder {} cannot be written to: {}", path_.string(),
             folderOf(target_).string(), native::lastReason());
    temporary_ = std::move(made.path);
    announce(temporary_.c_str());
}

AtomicFile::~AtomicFile()
{
    if (fd_ >= 0)
        ::_close(fd_);
    forget(temporary_.c_str());
    if (!committed_)
        ::DeleteFileW(temporary_.c_str());
}

void removeTemporaryFiles() noexcept
{
    for (const std::atomic<const wchar_t*>& place : temporaryNames)
        if (const wchar_t* const name = place.load())
            ::DeleteFileW(name);
}

void AtomicFile::writeAt(std::uint64_t at, std::span<const std::byte> bytes)
{
    while (!bytes.empty()) {
        const std::ptrdiff_t written = native::writeAt(native::handleOf(fd_), at, bytes);
        if (written < 0)
            fail(ErrorKind::io, "{}: cannot write: {}", path_.string(), native::lastReason());
        at += static_cast<std::uint64_t>(written);
        bytes = bytes.subspan(static_cast<std::size_t>(written));
    }
}

void AtomicFile::flush()
{
    if (::FlushFileBuffers(native::handleOf(fd_)) == 0)
        fail(ErrorKind::io, "{}: cannot write: {}", path_.string(), native::lastReason());
}

void AtomicFile::commit(bool synchronises)
{
    if (synchronises)
        flush();
    ::_close(fd_);
    fd_ = -1;
    // Without --force, a file that has appeared in the meantime stays.
    const int trouble = overwrite_
                            ? replace(temporary_, target_)
                            : moveToNewName(temporary_.string().c_str(), target_.string().c_str());
    if (trouble != 0)
        fail(ErrorKind::io, "{}: cannot put into place: {}{}", path_.string(),
             std::strerror(trouble), trouble == EACCES ? "; a program may have it open" : "");
    committed_ = true;
}

} // namespace sward
