#include "interchange/formats.h"

#include "core/error.h"
#include "interchange/csv.h"
#include "interchange/gltf.h"
#include "interchange/ply.h"
#include "interchange/usda.h"

#include <string>

namespace sward::interchange {
namespace {

constexpr Format formats[] = {{".glb", writeGlb, true, true},
                              {".ply", writePly, false, false},
                              {".usda", writeUsda, false, true},
                              {".csv", writeCsv, false, false}};

void checkForm(const std::string& path, const Format& format, const ExportSettings& settings)
{
    if (settings.withGround && !format.hasGround)
        fail(ErrorKind::usage, "{}: --with-ground needs a .glb output", path);
    if (settings.forEngines && !format.hasGround)
        fail(ErrorKind::usage, "{}: --for-engines needs a .glb output", path);
    if (settings.compact && !format.isCompact)
        fail(ErrorKind::usage, "{}: --compact needs a .glb or .usda output", path);
    if (settings.compact && settings.forEngines)
        fail(ErrorKind::usage,
             "{}: --for-engines has all attributes in rank order and cannot be --compact", path);
    if (settings.withIds && !settings.compact)
        fail(ErrorKind::usage, "{}: --with-ids needs --compact; other exports have ids", path);
}

} // namespace

const Format& formatOf(const std::filesystem::path& path, const ExportSettings& settings)
{
    std::string known;
    for (const Format& format : formats) {
        if (path.extension() == format.extension) {
            checkForm(path.string(), format, settings);
            return format;
        }
        known += std::string(known.empty() ? "" : ", ") + format.extension;
    }
    const std::string extension = path.extension().string();
    fail(ErrorKind::unsupported,
         "{}: {}; known are {}, a folder {}/ for a page, and --tiles for a folder of 3D Tiles",
         path.string(),
         extension.empty() ? "its name says no format" : "cannot export to '" + extension + "'",
         known, extension.empty() ? path.string() : "NAME");
}

} // namespace sward::interchange
