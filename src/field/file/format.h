#pragma once

#include <array>
#include <cstdint>

namespace sward::field::format {

// The byte format of a field file, little endian, as specified by docs/field_format.md. A file is
// the header, the chunk table, then the chunks. Each chunk starts on a 64-byte boundary, with zeros
// between.

inline constexpr std::array<char, 8> magic{'S', 'W', 'A', 'R', 'D', '\r', '\n', '\x1a'};
inline constexpr std::uint16_t majorVersion = 1;
inline constexpr std::uint16_t minorVersion =
    3; ///< newest; 1: the chunk `cover`; 2: organs of species; 3: seeds
inline constexpr std::uint32_t endianMark = 0x01020304;
inline constexpr std::uint64_t alignment = 64;
inline constexpr std::uint32_t maxChunks = 64;

struct FileHeader {
    std::array<char, 8> magic;
    std::uint16_t majorVersion;
    std::uint16_t minorVersion;
    std::uint32_t endianMark;
    std::uint64_t fileBytes;
    std::uint32_t chunkCount;
    std::uint32_t reserved;       ///< 0
    std::array<double, 3> origin; ///< [m] world position of the field's origin
    std::uint64_t
        tableHash; ///< XXH3 of this header with tableHash = 0, followed by the chunk table
};
static_assert(sizeof(FileHeader) == 64);

using ChunkId = std::array<char, 8>;

// Flags of a chunk.
inline constexpr std::uint32_t critical = 1;   ///< readers must reject an unknown chunk
inline constexpr std::uint32_t compressed = 2; ///< stored as one zstd frame
inline constexpr std::uint32_t knownFlags = critical | compressed;

struct ChunkEntry {
    ChunkId id;
    std::uint64_t offset; ///< from the start of the file, a multiple of 64
    std::uint64_t storedBytes;
    std::uint64_t rawBytes; ///< after decompression; = storedBytes if not compressed
    std::uint64_t hash;     ///< XXH3 of the stored bytes
    std::uint32_t flags;
    std::uint32_t elementBytes; ///< size of one element of the array; 1 for text
    std::uint64_t elementCount; ///< rawBytes = elementBytes · elementCount
    std::uint64_t reserved;     ///< 0
};
static_assert(sizeof(ChunkEntry) == 64);

inline constexpr ChunkId patches{'P', 'A', 'T', 'C', 'H', 'E', 'S', ' '};
inline constexpr ChunkId blades{'B', 'L', 'A', 'D', 'E', 'S', ' ', ' '};
inline constexpr ChunkId keys{'K', 'E', 'Y', 'S', ' ', ' ', ' ', ' '};
inline constexpr ChunkId species{'S', 'P', 'E', 'C', 'I', 'E', 'S', ' '};
inline constexpr ChunkId groundVertices{'G', 'V', 'E', 'R', 'T', 'I', 'C', 'E'};
inline constexpr ChunkId groundIndices{'G', 'I', 'N', 'D', 'I', 'C', 'E', 'S'};
inline constexpr ChunkId groundRanges{'G', 'R', 'A', 'N', 'G', 'E', 'S', ' '};
inline constexpr ChunkId groundMaterials{'G', 'M', 'A', 'T', 'E', 'R', 'I', 'A'};
inline constexpr ChunkId groundImages{'G', 'I', 'M', 'A', 'G', 'E', 'S', ' '};
inline constexpr ChunkId defaults{'D', 'E', 'F', 'A', 'U', 'L', 'T', 'S'};
inline constexpr ChunkId cover{'C', 'O', 'V', 'E', 'R', ' ', ' ', ' '};
inline constexpr ChunkId seeds{'S', 'E', 'E', 'D', 'S', ' ', ' ', ' '};
inline constexpr ChunkId seedCells{'S', 'E', 'E', 'D', 'C', 'E', 'L', 'L'};
inline constexpr ChunkId seedData{'S', 'E', 'E', 'D', 'D', 'A', 'T', 'A'};
inline constexpr ChunkId provenance{'P', 'R', 'O', 'V', 'E', 'N', 'A', 'N'};

} // namespace sward::field::format
