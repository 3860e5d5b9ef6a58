#include "core/files/file_hash.h"

#include "core/files/mapped_file.h"
#include "core/random.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace sward {

std::string hashOfBytes(std::span<const std::byte> bytes)
{
    std::uint64_t hash = bytes.size();
    for (std::size_t at = 0; at < bytes.size(); at += sizeof hash) {
        std::uint64_t word = 0;
        std::memcpy(&word, bytes.data() + at, std::min(sizeof word, bytes.size() - at));
        hash = mixBits(hash ^ word) + 0x9e3779b97f4a7c15ULL;
    }
    return fmt::format("{:016x}", hash);
}

std::string hashOfText(std::string_view text)
{
    return hashOfBytes(std::as_bytes(std::span(text)));
}

std::string hashOfFile(const std::filesystem::path& path)
{
    const MappedFile file(path);
    return hashOfBytes(file.bytes());
}

} // namespace sward
