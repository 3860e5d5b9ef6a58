#include "terrain/mesh_files/mesh_import.h"

#include "core/error.h"
#include "core/files/foreign_bytes.h"
#include "core/files/mapped_file.h"
#include "terrain/files/file_kind.h"
#include "terrain/mesh_files/mesh_import_obj.h"
#include "terrain/mesh_files/mesh_readers.h"
#include "terrain/mesh_files/mtl_import.h"

#include <algorithm>
#include <cmath>

namespace sward::terrain {

void warnOfCoarseness(const std::vector<glm::dvec3>& positions, double metresPerUnit,
                      const std::string& place, Diagnostics& diagnostics)
{
    constexpr double reach = 2048.0; // [m], where single precision resolves 0.1 mm
    double largest = 0.0;
    for (const glm::dvec3& p : positions)
        largest = std::max({largest, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
    largest *= metresPerUnit;
    if (std::isfinite(largest) && largest > reach)
        diagnostics.warn(
            "{}: coordinates up to {:.0f} m in single precision, which resolves {:.1f} mm "
            "there; move the mesh to its origin, or use a format with double precision",
            place, largest, largest * 0x1p-24 * 1e3);
}

double coordinateStep(const std::vector<glm::dvec3>& positions, bool isText)
{
    double largest = 0.0;
    bool isSingle = true;
    for (const glm::dvec3& p : positions)
        for (glm::length_t axis = 0; axis < 3; ++axis) {
            largest = std::max(largest, std::fabs(p[axis]));
            isSingle = isSingle && double(float(p[axis])) == p[axis];
        }
    const auto isWhole = [&](double factor) {
        return std::all_of(positions.begin(), positions.end(), [&](const glm::dvec3& p) {
            for (glm::length_t axis = 0; axis < 3; ++axis)
                if (const double number = p[axis] * factor;
                    std::fabs(number - std::round(number)) > 1e-4)
                    return false;
            return true;
        });
    };
    constexpr int decimals = 8;
    double factor = 1.0;
    for (int i = 0; isText && i <= decimals; ++i, factor *= 10.0)
        if (isWhole(factor))
            return 1.0 / factor;
    return largest * (isSingle ? 0x1p-23 : 0x1p-52);
}

void showColors(Soup& soup)
{
    if (!soup.hasColors)
        return;
    if (soup.materials.empty())
        soup.materials.push_back({.name = "ground"});
    for (GroundMaterial& material : soup.materials) {
        material.srgbColors = true;
        if (material.baseColor == GroundMaterial{}.baseColor)
            material.baseColor = glm::vec4(1.0f);
    }
}

Soup importMesh(const std::filesystem::path& path, const MaskInputs& read, double metresPerUnit,
                Diagnostics& diagnostics)
{
    const std::string place = path.string();
    const MappedFile mapped(path);
    const std::string_view file =
        withoutMark({reinterpret_cast<const char*>(mapped.bytes().data()), mapped.bytes().size()});
    if (file.empty())
        fail(ErrorKind::input, "{}: empty", place);
    if (fileKind(path) == ".obj") {
        std::vector<std::string> libraries;
        Soup soup = readObj(file, place, read, libraries, diagnostics);
        if (!libraries.empty())
            readMtl(path, libraries, read.imageChannels, soup, diagnostics);
        showColors(soup);
        soup.precision = metresPerUnit * coordinateStep(soup.positions, true);
        return soup;
    }

    PolygonSoup polygons(place);
    const std::string kind = fileKind(path);
    const MeshForm form = kind == ".ply"   ? readPly(file, place, polygons, diagnostics)
                          : kind == ".off" ? readOff(file, place, polygons, diagnostics)
                                           : readStl(file, place, polygons, diagnostics);
    polygons.finishFaces(diagnostics);
    if (form.isSingle)
        warnOfCoarseness(polygons.positions(), metresPerUnit, place, diagnostics);
    Soup soup = polygons.take(read, diagnostics);
    showColors(soup);
    soup.precision = metresPerUnit * coordinateStep(soup.positions, form.isText);
    return soup;
}

} // namespace sward::terrain
