#include "terrain/mesh_files/mesh_import.h"

#include "core/error.h"
#include "core/foreign_bytes.h"
#include "core/mapped_file.h"
#include "terrain/file_kind.h"
#include "terrain/mesh_files/mesh_import_obj.h"
#include "terrain/mesh_files/mesh_scan.h"
#include "terrain/mesh_files/mtl_import.h"
#include "terrain/mesh_files/openmesh_soup.h"
#include "terrain/topology/quiet_openmesh.h"

#include <OpenMesh/Core/IO/Options.hh>
#include <OpenMesh/Core/IO/reader/OFFReader.hh>
#include <OpenMesh/Core/IO/reader/PLYReader.hh>
#include <OpenMesh/Core/IO/reader/STLReader.hh>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace sward::terrain {
namespace {

using OpenMesh::IO::Options;

struct Format {
    std::string_view extension;
    MeshScan (*scan)(std::string_view, const std::string&);
    bool (*read)(std::istream&, OpenMesh::IO::BaseImporter&, Options&);
};

// OpenMesh's readers are its globals; a local one would stay registered after its destruction.
template <auto& reader>
bool readWith(std::istream& stream, OpenMesh::IO::BaseImporter& importer, Options& options)
{
    return reader().read(stream, importer, options);
}

constexpr Format formats[] = {
    {".ply", scanPly, readWith<OpenMesh::IO::PLYReader>},
    {".off", scanOff, readWith<OpenMesh::IO::OFFReader>},
    {".stl", scanStl, readWith<OpenMesh::IO::STLReader>},
};

const Format& formatOf(const std::filesystem::path& path)
{
    const std::string extension = fileKind(path);
    for (const Format& format : formats)
        if (format.extension == extension)
            return format;
    fail(ErrorKind::unsupported, "{}: not an OBJ, PLY, OFF or STL file", path.string());
}

// Replaces the reader's positions by those read in double precision.
void refine(Soup& soup, std::vector<glm::dvec3>&& positions, const std::string& place)
{
    if (positions.size() != soup.positions.size())
        fail(ErrorKind::input, "{}: {} of {} vertices could be read", place, soup.positions.size(),
             positions.size());
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const glm::dvec3& own = positions[i];
        for (glm::length_t axis = 0; axis < 3; ++axis)
            if (std::fabs(soup.positions[i][axis] - own[axis]) >
                1e-6 * std::fabs(own[axis]) + 1e-30)
                fail(ErrorKind::input, "{}: vertex {} is ambiguous: {} or {}", place, i, own[axis],
                     soup.positions[i][axis]);
    }
    soup.positions = std::move(positions);
}

// Single precision resolves 0.1 mm up to 2048 m.
void warnOfCoarseness(const Soup& soup, double metresPerUnit, const std::string& place,
                      Diagnostics& diagnostics)
{
    constexpr double reach = 2048.0; // [m]
    double largest = 0.0;
    for (const glm::dvec3& p : soup.positions)
        largest = std::max({largest, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
    largest *= metresPerUnit;
    if (std::isfinite(largest) && largest > reach)
        diagnostics.warn(
            "{}: coordinates up to {:.0f} m in single precision, which resolves {:.1f} mm "
            "there; move the mesh to its origin, or use a format with double precision",
            place, largest, largest * 0x1p-24 * 1e3);
}

// Difference of neighbouring coordinates: the last decimal of a text, or that of single or double
// precision.
double stepOf(const std::vector<glm::dvec3>& positions, bool isText)
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

// Lets vertex colours, if there are any, be the colour of all materials that have none.
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

} // namespace

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
        soup.precision = metresPerUnit * stepOf(soup.positions, true);
        return soup;
    }

    // Check the numbers before OpenMesh reads.
    const Format& format = formatOf(path);
    MeshScan scan = format.scan(file, place);
    std::istringstream stream(scan.cleaned.empty() ? std::string(file) : std::move(scan.cleaned));
    Options options(Options::VertexNormal | Options::VertexColor | Options::VertexTexCoord |
                    Options::FaceTexCoord);
    if (scan.isBinary)
        options += Options::Binary;
    OpenMeshSoup importer(place);
    importer.expectFaceUvs(std::move(scan.faceUvs));
    {
        const QuietOpenMesh quiet;
        if (!format.read(stream, importer, options))
            fail(ErrorKind::input, "{}: OpenMesh cannot read it", place);
    }
    if (scan.vertices != 0 && importer.n_vertices() != scan.vertices)
        fail(ErrorKind::input, "{}: {} of {} vertices could be read", place, importer.n_vertices(),
             scan.vertices);
    if (scan.faces != 0 && importer.facesSeen() != scan.faces)
        fail(ErrorKind::input, "{}: {} of {} faces could be read", place, importer.facesSeen(),
             scan.faces);
    if (importer.facesSeen() == 0)
        fail(ErrorKind::input, "{}: no faces", place);
    importer.warnOfCrossed(diagnostics);

    if (scan.positions.empty())
        warnOfCoarseness(importer.soup(), metresPerUnit, place, diagnostics);
    else
        refine(importer.soup(), std::move(scan.positions), place);
    importer.setColors(scan.colors);
    for (std::size_t v = 0; v < scan.uvs.size(); ++v)
        importer.set_texcoord(OpenMesh::VertexHandle(static_cast<int>(v)),
                              OpenMesh::Vec2f(scan.uvs[v].x, scan.uvs[v].y));
    Soup soup = importer.take(read, diagnostics);
    showColors(soup);
    soup.precision = metresPerUnit * stepOf(soup.positions, !scan.isBinary);
    return soup;
}

} // namespace sward::terrain
