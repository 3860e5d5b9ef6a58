#include "apps/common/picture/npz_file.h"

#include "apps/common/picture/crc32.h"
#include "core/error.h"
#include "core/expect.h"
#include "core/files/atomic_file.h"

#include <fmt/format.h>

#include <cstdint>
#include <limits>

namespace sward::apps {
namespace {

constexpr std::size_t npyAlignment = 64; ///< [bytes] of the first element

/// Numbers in the order of bytes of a ZIP archive.
class Bytes {
public:
    Bytes& add(std::uint64_t number, std::size_t count)
    {
        for (std::size_t i = 0; i < count; ++i)
            bytes_.push_back(static_cast<std::byte>(number >> (8 * i) & 255U));
        return *this;
    }
    Bytes& add(std::string_view text)
    {
        for (const char c : text)
            bytes_.push_back(static_cast<std::byte>(c));
        return *this;
    }
    std::vector<std::byte>& all() { return bytes_; }

private:
    std::vector<std::byte> bytes_;
};

/// A file in the archive.
struct Entry {
    std::string name;
    std::uint32_t crc = 0;
    std::uint64_t bytes = 0;
    std::uint64_t at = 0; ///< where its header begins
};

constexpr std::uint64_t version = 20;           ///< of the format: 2.0
constexpr std::uint64_t firstDate = 1 << 5 | 1; ///< 1 January 1980, the first that there is

/// What local and central header have alike, from the version on.
void addCommon(Bytes& header, const Entry& entry)
{
    header.add(version, 2).add(0, 2).add(0, 2).add(0, 2).add(firstDate, 2);
    header.add(entry.crc, 4)
        .add(entry.bytes, 4)
        .add(entry.bytes, 4)
        .add(entry.name.size(), 2)
        .add(0, 2);
}

/// What stands in an .npy file before the elements.
std::vector<std::byte> npyHeader(const NumberArray& array)
{
    std::size_t count = 1;
    std::string shape;
    for (const std::size_t along : array.shape) {
        count *= along;
        shape += fmt::format("{}, ", along);
    }
    expect(count > 0 ? array.bytes.size() % count == 0 : array.bytes.empty(),
           "an array has whole elements");
    std::string header = fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({}), }}",
                                     array.type, shape);
    constexpr std::size_t before = 10; // magic, version and length
    const std::size_t whole = (before + header.size() + npyAlignment) / npyAlignment * npyAlignment;
    header.resize(whole - before - 1, ' ');
    header += '\n';
    Bytes bytes;
    bytes.add("\x93NUMPY").add(1, 1).add(0, 1).add(header.size(), 2).add(header);
    return std::move(bytes.all());
}

} // namespace

std::vector<std::byte> npyBytes(const NumberArray& array)
{
    std::vector<std::byte> bytes = npyHeader(array);
    bytes.insert(bytes.end(), array.bytes.begin(), array.bytes.end());
    return bytes;
}

void writeNpz(std::span<const NumberArray> arrays, const std::filesystem::path& path,
              bool overwrite)
{
    constexpr std::uint64_t most = std::numeric_limits<std::uint32_t>::max();
    std::uint64_t whole = 1024 * (arrays.size() + 1);
    for (const NumberArray& array : arrays)
        whole += array.bytes.size();
    if (whole > most)
        fail(ErrorKind::runtime, "{}: the arrays take {} bytes; an .npz holds {} at most",
             path.string(), whole, most);

    AtomicFile file(path, overwrite);
    std::vector<Entry> entries;
    std::uint64_t at = 0;
    const auto write = [&](std::span<const std::byte> bytes) {
        file.write(bytes);
        at += bytes.size();
    };
    for (const NumberArray& array : arrays) {
        const std::vector<std::byte> begin = npyHeader(array);
        const Entry entry{array.name + ".npy", crc32Of(array.bytes, crc32Of(begin)),
                          begin.size() + array.bytes.size(), at};
        Bytes header;
        header.add(0x04034b50, 4);
        addCommon(header, entry);
        header.add(entry.name);
        write(header.all());
        write(begin);
        write(array.bytes);
        entries.push_back(entry);
    }
    const std::uint64_t directory = at;
    for (const Entry& entry : entries) {
        Bytes header;
        header.add(0x02014b50, 4).add(version, 2);
        addCommon(header, entry);
        header.add(0, 2).add(0, 2).add(0, 2).add(0, 4).add(entry.at, 4).add(entry.name);
        write(header.all());
    }
    Bytes end;
    end.add(0x06054b50, 4).add(0, 2).add(0, 2).add(entries.size(), 2).add(entries.size(), 2);
    end.add(at - directory, 4).add(directory, 4).add(0, 2);
    write(end.all());
    file.commit();
}

} // namespace sward::apps
