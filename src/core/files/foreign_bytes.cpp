#include "core/files/foreign_bytes.h"

#include "core/error.h"

#include <algorithm>

namespace sward {
namespace {

using namespace std::string_view_literals;

struct Form {
    std::string_view start;
    ErrorKind kind;
    const char* says;
};

constexpr Form forms[] = {
    {"\x1f\x8b"sv, ErrorKind::input, "is compressed by gzip; decompress it"},
    {"PK\x03\x04"sv, ErrorKind::input, "is a zip archive; unpack it"},
    {"PK\x05\x06"sv, ErrorKind::input, "is an empty zip archive"},
    {"7z\xbc\xaf\x27\x1c"sv, ErrorKind::input, "is a 7z archive; unpack it"},
    {"Rar!\x1a\x07"sv, ErrorKind::input, "is a RAR archive; unpack it"},
    {"\xfd"
     "7zXZ\0"sv,
     ErrorKind::input, "is compressed by xz; decompress it"},
    {"\x28\xb5\x2f\xfd"sv, ErrorKind::input, "is compressed by zstd; decompress it"},
    {"BZh"sv, ErrorKind::input, "is compressed by bzip2; decompress it"},
    {"\xff\xfe"sv, ErrorKind::input, "is UTF-16 text; save it as UTF-8"},
    {"\xfe\xff"sv, ErrorKind::input, "is UTF-16 text; save it as UTF-8"},
    {"version https://git-lfs.github.com/"sv, ErrorKind::input,
     "is a pointer of git-LFS, not the file itself; fetch it with git lfs pull"},
    {"Kaydara FBX Binary"sv, ErrorKind::unsupported,
     "is an FBX model; export it as glTF (.glb), for example with Blender"},
    {"; FBX "sv, ErrorKind::unsupported,
     "is an FBX model; export it as glTF (.glb), for example with Blender"},
    {"BLENDER"sv, ErrorKind::unsupported, "is a Blender file; export it as glTF (.glb)"},
    {"PXR-USDC"sv, ErrorKind::unsupported,
     "is a USD model; export it as glTF (.glb), for example with Blender"},
    {"#usda "sv, ErrorKind::unsupported,
     "is a USD model; export it as glTF (.glb), for example with Blender"},
    {"II*\0"sv, ErrorKind::unsupported,
     "is a TIFF; make a PNG of it: gdal_translate -ot UInt16 -of PNG -scale MIN MAX 0 65535"},
    {"MM\0*"sv, ErrorKind::unsupported,
     "is a TIFF; make a PNG of it: gdal_translate -ot UInt16 -of PNG -scale MIN MAX 0 65535"},
};

} // namespace

std::string_view withoutMark(std::string_view text)
{
    constexpr std::string_view mark = "\xef\xbb\xbf";
    return text.substr(0, mark.size()) == mark ? text.substr(mark.size()) : text;
}

void refuseForeign(std::span<const std::byte> file, const std::string& place)
{
    const std::string_view bytes(reinterpret_cast<const char*>(file.data()), file.size());
    for (const Form& form : forms)
        if (bytes.substr(0, form.start.size()) == form.start)
            fail(form.kind, "{}: {}", place, form.says);
}

} // namespace sward
