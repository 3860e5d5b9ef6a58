// The same mesh in every form that its format allows.

#include "core/error.h"
#include "support/meshes.h"
#include "terrain/mesh_files/polygon.h"
#include "terrain/reach.h"
#include "unit/terrain/gltf/glb_builder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

namespace sward::terrain {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

using Outline = std::vector<glm::dvec3>;
using Faces = std::vector<std::vector<int>>;

// Polygons in the x-z plane that are not convex; the first corner is not always a good centre.
Outline combOf(int teeth)
{
    Outline comb;
    for (int i = 0; i < teeth; ++i) {
        comb.push_back({2.0 * i, 0.0, 0.0});
        comb.push_back({2.0 * i + 0.7, 0.0, 5.0});
        comb.push_back({2.0 * i + 1.1, 0.0, 5.0});
        comb.push_back({2.0 * i + 1.5, 0.0, 0.0});
    }
    comb.push_back({2.0 * teeth, 0.0, -1.0});
    comb.push_back({-1.0, 0.0, -1.0});
    return comb;
}

const Outline ell = {{0, 0, 0}, {0, 0, 10}, {10, 0, 10}, {10, 0, 8}, {2, 0, 8}, {2, 0, 0}};

// A square with a square hole, reached by an edge that is passed twice.
const Outline keyhole = {{0, 0, 0}, {0, 0, 9}, {9, 0, 9}, {9, 0, 0}, {0, 0, 0},
                         {3, 0, 3}, {6, 0, 3}, {6, 0, 6}, {3, 0, 6}, {3, 0, 3}};

double areaOf(const Outline& outline)
{
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < outline.size(); ++i)
        sum += 0.5 * glm::cross(outline[i], outline[(i + 1) % outline.size()]);
    return glm::length(sum);
}

bool isInside(const Outline& outline, const glm::dvec3& p)
{
    bool inside = false;
    for (std::size_t i = 0, j = outline.size() - 1; i < outline.size(); j = i++) {
        const glm::dvec3& a = outline[i];
        const glm::dvec3& b = outline[j];
        if ((a.z > p.z) != (b.z > p.z) && p.x < (b.x - a.x) * (p.z - a.z) / (b.z - a.z) + a.x)
            inside = !inside;
    }
    return inside;
}

std::string objText(const Outline& vertices, const Faces& faces)
{
    std::string text;
    for (const glm::dvec3& v : vertices)
        text += fmt::format("v {} {} {}\n", v.x, v.y, v.z);
    for (const std::vector<int>& face : faces) {
        text += "f";
        for (const int corner : face)
            text += fmt::format(" {}", corner + 1);
        text += "\n";
    }
    return text;
}

std::string offText(const Outline& vertices, const Faces& faces, const char* gap = " ")
{
    std::string text = fmt::format("OFF\n{} {} 0\n", vertices.size(), faces.size());
    for (const glm::dvec3& v : vertices)
        text += fmt::format("{}{}{}{}{}\n", v.x, gap, v.y, gap, v.z);
    for (const std::vector<int>& face : faces) {
        text += fmt::format("{}", face.size());
        for (const int corner : face)
            text += fmt::format("{}{}", gap, corner);
        text += "\n";
    }
    return text;
}

struct PlyForm {
    const char* format = "ascii";
    const char* length = "uchar";
    const char* index = "int";
    const char* coordinate = "float";
    bool facesFirst = false;
    bool areStrips = false;
};

void addNumber(std::string& text, const PlyForm& form, const std::string& type, double value)
{
    if (form.format == std::string("ascii")) {
        text += fmt::format("{} ", value);
        return;
    }
    std::string bytes;
    const auto put = [&](auto number) {
        bytes.resize(sizeof number);
        std::memcpy(bytes.data(), &number, sizeof number);
    };
    if (type == "char" || type == "int8")
        put(static_cast<std::int8_t>(value));
    else if (type == "uchar" || type == "uint8")
        put(static_cast<std::uint8_t>(value));
    else if (type == "short" || type == "int16")
        put(static_cast<std::int16_t>(value));
    else if (type == "ushort" || type == "uint16")
        put(static_cast<std::uint16_t>(value));
    else if (type == "int" || type == "int32")
        put(static_cast<std::int32_t>(value));
    else if (type == "uint" || type == "uint32")
        put(static_cast<std::uint32_t>(value));
    else if (type == "float" || type == "float32")
        put(static_cast<float>(value));
    else
        put(value);
    if (form.format == std::string("binary_big_endian"))
        std::reverse(bytes.begin(), bytes.end());
    text += bytes;
}

std::string plyText(const Outline& vertices, const Faces& faces, const PlyForm& form = {})
{
    const bool isText = form.format == std::string("ascii");
    std::string vertexBody;
    for (const glm::dvec3& v : vertices) {
        for (glm::length_t axis = 0; axis < 3; ++axis)
            addNumber(vertexBody, form, form.coordinate, v[axis]);
        vertexBody += isText ? "\n" : "";
    }
    std::string faceBody;
    for (const std::vector<int>& face : faces) {
        addNumber(faceBody, form, form.length, static_cast<double>(face.size()));
        for (const int corner : face)
            addNumber(faceBody, form, form.index, corner);
        faceBody += isText ? "\n" : "";
    }
    const std::string vertexHead =
        fmt::format("element vertex {}\nproperty {} x\nproperty {} y\n"
                    "property {} z\n",
                    vertices.size(), form.coordinate, form.coordinate, form.coordinate);
    const std::string faceHead =
        fmt::format("element {} {}\nproperty list {} {} vertex_indices\n",
                    form.areStrips ? "tristrips" : "face", faces.size(), form.length, form.index);
    return fmt::format("ply\nformat {} 1.0\n", form.format) +
           (form.facesFirst ? faceHead + vertexHead : vertexHead + faceHead) + "end_header\n" +
           (form.facesFirst ? faceBody + vertexBody : vertexBody + faceBody);
}

std::string stlText(const Outline& vertices, const Faces& faces)
{
    std::string text = "solid hill\n";
    for (const std::vector<int>& face : faces) {
        text += "facet normal 0 1 0\nouter loop\n";
        for (const int corner : face) {
            const glm::dvec3& v = vertices[std::size_t(corner)];
            text += fmt::format("vertex {} {} {}\n", v.x, v.y, v.z);
        }
        text += "endloop\nendfacet\n";
    }
    return text + "endsolid hill\n";
}

std::string withLineEnds(std::string text, const std::string& end)
{
    for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += end.size())
        text.replace(at, 1, end);
    return text;
}

const Outline grid = {{0, 0, 0}, {0, 0, 2}, {3, 0, 0}, {3, 0, 2}, {6, 1, 0}, {6, 1, 2}};
const Faces gridFaces = {{0, 1, 2}, {2, 1, 3}, {2, 3, 4}, {4, 3, 5}};
const double gridArea = 6.0 + 2.0 * std::sqrt(10.0);

void expectGrid(const std::string& name, const std::string& content)
{
    try {
        const GroundMesh mesh = loadContent(name, content);
        EXPECT_EQ(mesh.triangles.size(), 4U) << content.substr(0, 300);
        EXPECT_NEAR(meshes::totalArea(mesh), gridArea, 1e-5) << content.substr(0, 300);
        for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
            EXPECT_GT(mesh.faceNormal(i).y, 0.5) << "fronts look up";
    } catch (const Error& error) {
        ADD_FAILURE() << error.what() << "\n" << content.substr(0, 300);
    }
}

ErrorKind refusalOf(const std::string& name, const std::string& content,
                    std::string* message = nullptr)
{
    try {
        loadContent(name, content);
    } catch (const Error& error) {
        if (message != nullptr)
            *message = error.what();
        return error.kind();
    }
    ADD_FAILURE() << name << " was read";
    return ErrorKind::runtime;
}

TEST(MeshForms, APolygonCoversItsInsideOnceFromAnyCornerInAnyFormat)
{
    const std::vector<std::pair<Outline, double>> outlines = {{ell, 36.0},
                                                              {keyhole, 72.0},
                                                              {combOf(2), areaOf(combOf(2))},
                                                              {combOf(7), areaOf(combOf(7))}};
    for (const auto& [outline, area] : outlines)
        for (const bool isReversed : {false, true})
            for (std::size_t shift = 0; shift < outline.size(); ++shift) {
                Outline turned = outline;
                std::rotate(turned.begin(), turned.begin() + std::ptrdiff_t(shift), turned.end());
                if (isReversed)
                    std::reverse(turned.begin(), turned.end());
                Faces face(1);
                for (std::size_t i = 0; i < turned.size(); ++i)
                    face[0].push_back(static_cast<int>(i));
                const std::pair<const char*, std::string> files[] = {
                    {"a.obj", objText(turned, face)},
                    {"a.ply", plyText(turned, face)},
                    {"a.off", offText(turned, face)}};
                for (const auto& [name, content] : files) {
                    Diagnostics diagnostics;
                    const GroundMesh mesh = loadContent(name, content, {}, &diagnostics);
                    EXPECT_THAT(diagnostics.warnings(), IsEmpty()) << content;
                    EXPECT_NEAR(meshes::totalArea(mesh), area, 1e-5) << content;
                    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
                        glm::dvec3 middle(0.0);
                        for (glm::length_t c = 0; c < 3; ++c)
                            middle += worldPosition(mesh, mesh.triangles[t][c]) / 3.0;
                        EXPECT_TRUE(mesh.area(t) <= 1e-6 || isInside(outline, middle)) << content;
                    }
                }
            }
}

TEST(MeshForms, RandomStarsAreDividedIntoTrianglesOfTheirOwnTurn)
{
    std::mt19937 random(5);
    std::uniform_real_distribution<double> radius(0.2, 3.0);
    for (int n = 4; n < 60; ++n) {
        Outline star;
        for (int i = 0; i < n; ++i) {
            const double angle = 2.0 * 3.14159265358979 * i / n;
            const double r = radius(random);
            star.push_back({r * std::cos(angle), 0.3 * r, r * std::sin(angle)});
        }
        // Flat, but leaning.
        for (glm::dvec3& corner : star)
            corner.y = 0.3 * corner.x - 0.2 * corner.z;
        bool crosses = true;
        const auto triangles = triangulate(star, crosses);
        EXPECT_FALSE(crosses);
        EXPECT_EQ(triangles.size(), std::size_t(n - 2));
        double area = 0.0;
        for (const PolygonTriangle& t : triangles) {
            const double own = 0.5 * glm::cross(star[t[1]] - star[t[0]], star[t[2]] - star[t[0]]).y;
            EXPECT_LE(own, 1e-12);
            area -= own;
        }
        EXPECT_NEAR(area, areaOf(star) / std::sqrt(1.0 + 0.09 + 0.04), 1e-9);
    }
}

TEST(MeshForms, WarnsOfPolygonsWhoseEdgesCross)
{
    for (const Outline& bow : {Outline{{0, 0, 0}, {2, 0, 2}, {2, 0, 0}, {0, 0, 2}},
                               Outline{{0, 0, 0}, {5, 0, 4}, {5, 0, 0}, {0, 0, 3}, {-1, 0, 1}}}) {
        Faces face(1);
        for (std::size_t i = 0; i < bow.size(); ++i)
            face[0].push_back(static_cast<int>(i));
        Diagnostics diagnostics;
        loadContent("a.obj", objText(bow, face), {}, &diagnostics);
        EXPECT_THAT(diagnostics.warnings(), testing::Contains(HasSubstr("cross")));
    }
}

TEST(MeshForms, LineEndsAndAByteOrderMarkChangeNothing)
{
    for (const std::string end : {"\n", "\r\n", "\r"})
        for (const std::string mark : {"", "\xef\xbb\xbf"}) {
            expectGrid("a.obj", mark + withLineEnds(objText(grid, gridFaces), end));
            expectGrid("a.off", mark + withLineEnds(offText(grid, gridFaces), end));
            expectGrid("a.ply", mark + withLineEnds(plyText(grid, gridFaces), end));
            expectGrid("a.stl", mark + withLineEnds(stlText(grid, gridFaces), end));
        }
    // A body that begins with a line feed behind a header that ends by CR.
    Outline moved = grid;
    float first = 0.0f;
    const std::uint32_t bits = 0x0000000aU;
    std::memcpy(&first, &bits, 4);
    moved[0].x = double(first);
    std::string binary = plyText(moved, gridFaces, {.format = "binary_little_endian"});
    const std::size_t body = binary.find("end_header\n") + 11;
    expectGrid("a.ply", withLineEnds(binary.substr(0, body), "\r") + binary.substr(body));
}

TEST(MeshForms, EveryTypeAndOrderOfAPlyGivesTheSameMesh)
{
    for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"})
        for (const char* length : {"char", "uint8", "short", "uint16", "int", "uint32", "float"})
            for (const char* index :
                 {"char", "uchar", "int16", "ushort", "int32", "uint", "double"})
                for (const char* coordinate :
                     {"char", "uint8", "int16", "ushort", "int", "uint32", "float", "double"})
                    for (const bool facesFirst : {false, true})
                        expectGrid("a.ply",
                                   plyText(grid, gridFaces,
                                           {format, length, index, coordinate, facesFirst}));
}

TEST(MeshForms, StripsOfAPlyAreTriangles)
{
    for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
        expectGrid("a.ply", plyText(grid, {{0, 1, 2, 3, 4, 5}},
                                    {.format = format, .length = "int", .areStrips = true}));
        expectGrid("a.ply", plyText(grid, {{0, 1, 2, 3, -1, 2, 3, 4, 5}},
                                    {.format = format, .length = "int", .areStrips = true}));
    }
}

TEST(MeshForms, APlyWithFractionsOfCornersIsRefused)
{
    const std::string whole = plyText(grid, gridFaces);
    for (const auto& [from, to] :
         {std::pair("3 0 1 2", "3.5 0 1 2"), std::pair("2 1 3 ", "2 1.5 3 ")}) {
        std::string text = whole;
        text.replace(text.find(from), std::strlen(from), to);
        EXPECT_EQ(refusalOf("a.ply", text), ErrorKind::input) << to;
    }
}

TEST(MeshForms, AnOffMayBreakItsLinesAnywhere)
{
    expectGrid("a.off", offText(grid, gridFaces, "\n"));
    expectGrid("a.off", offText(grid, gridFaces, "\n# a comment\n"));
    expectGrid("a.off", offText(grid, gridFaces, "  \t"));
}

TEST(MeshForms, AnStlIsKnownByItsContent)
{
    std::string upper = stlText(grid, gridFaces);
    std::transform(upper.begin(), upper.end(), upper.begin(),
                   [](unsigned char c) { return c >= 'a' && c <= 'z' ? char(c - 32) : char(c); });
    expectGrid("a.stl", upper);
    expectGrid("a.stl", "\n\n" + stlText(grid, gridFaces));
    std::string message;
    const std::string text = stlText(grid, gridFaces);
    EXPECT_EQ(refusalOf("a.stl", "x" + text.substr(0, text.size() - 20), &message),
              ErrorKind::input);
    EXPECT_THAT(message, testing::Not(HasSubstr("triangles need")));
}

TEST(MeshForms, ABinaryStlWithAnyNumberThatIsNoneIsRefused)
{
    for (std::size_t place = 0; place < 9; ++place)
        for (const float wrong :
             {std::numeric_limits<float>::quiet_NaN(), -std::numeric_limits<float>::infinity()}) {
            float numbers[12] = {0, 1, 0, 0, 0, 0, 0, 0, 1, 1, 0, 0};
            numbers[3 + place] = wrong;
            std::string file(84, '\0');
            file[80] = 1;
            file.append(reinterpret_cast<const char*>(numbers), sizeof numbers).append(2, '\0');
            std::string message;
            EXPECT_EQ(refusalOf("a.stl", file, &message), ErrorKind::input);
            EXPECT_THAT(message, HasSubstr("triangle 0"));
        }
}

TEST(MeshForms, ACommentMayEndAnyLineOfAnObj)
{
    std::string text;
    for (const char c : objText(grid, gridFaces))
        text += c == '\n' ? std::string(" # remark f 1 2 3\n") : std::string(1, c);
    expectGrid("a.obj", text);
}

TEST(MeshForms, AnyExponentIsGroundWithinReachOrAnErrorThatNamesTheBound)
{
    std::mt19937 random(7);
    std::uniform_int_distribution<int> exponent(-320, 308);
    std::uniform_int_distribution<std::size_t> corner(0, grid.size() - 1);
    std::uniform_int_distribution<int> axis(0, 2);
    std::size_t refused = 0;
    for (int i = 0; i < 300; ++i) {
        Outline vertices = grid;
        vertices[corner(random)][axis(random)] = 3.7 * std::pow(10.0, exponent(random));
        const std::pair<const char*, std::string> files[] = {
            {"a.obj", objText(vertices, gridFaces)},
            {"a.off", offText(vertices, gridFaces)},
            {"a.ply", plyText(vertices, gridFaces,
                              {.format = "binary_little_endian", .coordinate = "double"})},
            {"a.stl", stlText(vertices, gridFaces)}};
        for (const auto& [name, content] : files) {
            try {
                const GroundMesh mesh = loadContent(name, content);
                for (std::size_t v = 0; v < mesh.positions.size(); ++v)
                    EXPECT_TRUE(isWithinReach(worldPosition(mesh, v))) << content;
            } catch (const Error& error) {
                EXPECT_EQ(error.kind(), ErrorKind::input) << error.what();
                ++refused;
            }
        }
    }
    EXPECT_GT(refused, 100U);
}

} // namespace
} // namespace sward::terrain
