// What formats allow beyond the usual, and what is said of what is missing.

#include "core/error.h"
#include "unit/terrain/gltf/glb_builder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace sward::terrain {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

struct Number {
    const char* name;
    std::size_t size;
    double full; // of a colour
};

constexpr Number numbers[] = {
    {"char", 1, 127},    {"int8", 1, 127},    {"uchar", 1, 255},    {"uint8", 1, 255},
    {"short", 2, 32767}, {"int16", 2, 32767}, {"ushort", 2, 65535}, {"uint16", 2, 65535},
    {"int", 4, 255},     {"int32", 4, 255},   {"uint", 4, 255},     {"uint32", 4, 255},
    {"float", 4, 1},     {"float32", 4, 1},   {"double", 8, 1},     {"float64", 8, 1},
};

void add(std::string& body, const Number& type, double value, const std::string& format)
{
    if (format == "ascii") {
        body += fmt::format("{} ", value);
        return;
    }
    char bytes[8] = {};
    const std::string name = type.name;
    if (name.starts_with("f")) {
        const auto number = static_cast<float>(value);
        std::memcpy(bytes, &number, 4);
    }
    if (name.starts_with("d") || name == "float64")
        std::memcpy(bytes, &value, 8);
    if (name.find("int") != std::string::npos || type.size < 4) {
        const auto number = static_cast<std::int64_t>(value);
        std::memcpy(bytes, &number, 8);
    }
    if (format == "binary_big_endian")
        std::reverse(bytes, bytes + type.size);
    body.append(bytes, type.size);
}

// A triangle whose vertices have normals along z, the colour (1, 0.4, 0) and elements and lists
// between that nobody reads.
std::string richPly(const std::string& format, const Number& type)
{
    std::string text =
        fmt::format("ply\nformat {} 1.0\nelement camera 1\nproperty {} x\n", format, type.name) +
        "element vertex 3\nproperty float x\nproperty float y\n";
    for (const char* name : {"nx", "ny", "nz", "red", "green", "blue"})
        text += fmt::format("property {} {}\n", type.name, name);
    text += fmt::format("property list {} {} rings\nproperty float z\n", type.name, type.name);
    text += fmt::format("element face 1\nproperty {} flags\n", type.name) +
            fmt::format("property list {} {} vertex_indices\n", type.name, type.name) +
            "element edge 1\nproperty int a\nend_header\n";
    const Number single = numbers[12];
    std::string body;
    const auto put = [&](const Number& as, double value) { add(body, as, value, format); };
    put(type, 1);
    for (int v = 0; v < 3; ++v) {
        put(single, v == 2 ? 1 : 0);
        put(single, 0);
        for (const double n : {0.0, 0.0, 1.0})
            put(type, n);
        for (const double share : {1.0, 0.4, 0.0})
            put(type, share * type.full);
        for (const double n : {2.0, 1.0, 1.0})
            put(type, n);
        put(single, v == 1 ? 1 : 0);
    }
    for (const double n : {7.0, 3.0, 0.0, 1.0, 2.0})
        put(type, n);
    put(numbers[8], 5);
    return text + body;
}

TEST(MeshGaps, EveryPropertyOfAPlyMayHaveAnyType)
{
    for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"})
        for (const Number& type : numbers) {
            const GroundMesh mesh = loadContent("a.ply", richPly(format, type));
            const std::string what = fmt::format("{} {}", format, type.name);
            ASSERT_EQ(mesh.triangles.size(), 1U) << what;
            EXPECT_DOUBLE_EQ(mesh.area(0), 0.5) << what;
            EXPECT_EQ(mesh.normals[0], glm::vec3(0, 0, 1)) << what;
            EXPECT_NEAR(mesh.colors[0].x, 1.0, 1e-6) << what;
            EXPECT_NEAR(mesh.colors[0].y, 0.4, 0.01) << what;
        }
}

TEST(MeshGaps, APlySaysWhatItLacks)
{
    const std::string head = "ply\nformat ascii 1.0\n";
    const auto vertices = [](std::initializer_list<const char*> axes) {
        std::string text = "element vertex 3\n";
        for (const char* axis : axes)
            text += fmt::format("property float {}\n", axis);
        return text;
    };
    const std::string faces = "element face 1\nproperty list uchar int vertex_indices\n";
    const std::string end = "end_header\n0 0 0\n0 0 1\n1 0 0\n3 0 1 2\n";
    const std::string all = vertices({"x", "y", "z"});
    EXPECT_THAT(inputErrorOf("a.ply", head + vertices({"x", "y"}) + faces + end),
                HasSubstr("property z of its vertices is missing"));
    EXPECT_THAT(inputErrorOf("a.ply", head + vertices({"y", "z"}) + faces + end),
                HasSubstr("property x"));
    EXPECT_THAT(inputErrorOf("a.ply", head + faces + end), HasSubstr("no element vertex"));
    EXPECT_THAT(inputErrorOf("a.ply", head + all + end), HasSubstr("no element face"));
    EXPECT_THAT(inputErrorOf("a.ply", head + all + "element face 1\nproperty uchar flags\n" + end),
                HasSubstr("no list vertex_indices"));
    EXPECT_THAT(
        inputErrorOf("a.ply", head + all + "element face 1\nproperty int vertex_index\n" + end),
        HasSubstr("vertex_index of element face is no list"));
    EXPECT_THAT(inputErrorOf("a.ply", head + vertices({"x", "y", "z", "x"}) + faces + end),
                HasSubstr("line 7: element vertex has a second property x"));
}

TEST(MeshGaps, APlyNamesVerticesByWholeNumbers)
{
    const std::string head =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
        "property float z\nelement face 1\nproperty list uchar double vertex_indices\n"
        "end_header\n0 0 0\n4 0 0\n0 4 0\n3 0 1 ";
    EXPECT_THAT(inputErrorOf("a.ply", head + "2.000000000000004\n"),
                HasSubstr("about 2, has a fraction"));
    EXPECT_THAT(inputErrorOf("a.ply", head + "4294967295\n"),
                HasSubstr("names vertex 4294967295, but there are 3"));
}

TEST(MeshGaps, FacesKeepTheirGroundWithoutNormalsThatTheyName)
{
    const std::string vertices = "v 0 0 0\nv 0 0 1\nv 1 0 0\nv 1 0 1\n";
    for (const char* faces :
         {"f 1//1 2//1 3//1\nf 3//1 2//1 4//1\n", "f 1/1 2/2 3/3\nf 3/3 2/2 4/4\n",
          "vn 0 1 0\nvt 0 0\nf 1/1/2 2/1/1 3/1/1\nf 3/1/1 2/1/1 4/9/-3\n",
          "f 1/0/0 2/0/0 3/0/0\nf 3 2 4\n"}) {
        Diagnostics diagnostics;
        const GroundMesh mesh = loadContent("a.obj", vertices + faces, {}, &diagnostics);
        EXPECT_EQ(mesh.triangles.size(), 2U) << faces;
        EXPECT_THAT(diagnostics.warnings(), Contains(HasSubstr("but there are"))) << faces;
        EXPECT_GT(mesh.normals[0].y, 0.99f);
    }
}

TEST(MeshGaps, WarnsOfFacesOfFewerThanThreeCornersInEveryFormat)
{
    const std::string ply = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty "
                            "float y\nproperty float z\nelement face 3\nproperty list uchar int "
                            "vertex_indices\nend_header\n0 0 0\n0 0 1\n1 0 0\n";
    const std::pair<const char*, std::string> files[] = {
        {"a.obj", "v 0 0 0\nv 0 0 1\nv 1 0 0\nf\nf 1 2\nf 1 2 3\n"},
        {"a.ply", ply + "0\n2 0 1\n3 0 1 2\n"},
        {"a.off", "OFF\n3 3 0\n0 0 0\n0 0 1\n1 0 0\n0\n2 0 1\n3 0 1 2\n"},
    };
    for (const auto& [name, content] : files) {
        Diagnostics diagnostics;
        EXPECT_EQ(loadContent(name, content, {}, &diagnostics).triangles.size(), 1U) << name;
        EXPECT_THAT(diagnostics.warnings(), ElementsAre(HasSubstr("2 of 3 faces"))) << name;
    }
}

TEST(MeshGaps, TellsWhatIsLeftOverBehindTheElements)
{
    const std::string header = "1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                               "property float z\nelement face 1\nproperty list uchar int "
                               "vertex_indices\nend_header\n";
    const std::string ply = "ply\nformat ascii " + header + "0 0 0\n0 0 1\n1 0 0\n3 0 1 2\n";
    const std::string off = "OFF\n3 1 0\n0 0 0\n0 0 1\n1 0 0\n3 0 1 2\n";
    std::string binary = "ply\nformat binary_little_endian " + header;
    const float corners[9] = {0, 0, 0, 0, 0, 1, 1, 0, 0};
    const std::int32_t face[3] = {0, 1, 2};
    binary.append(reinterpret_cast<const char*>(corners), sizeof corners).append(1, '\3');
    binary.append(reinterpret_cast<const char*>(face), sizeof face);
    std::string stl(80, ' ');
    const std::uint32_t triangles = 1;
    stl.append(reinterpret_cast<const char*>(&triangles), 4).append(12, '\0');
    stl.append(reinterpret_cast<const char*>(corners), sizeof corners).append(2, '\0');
    const auto warningsOf = [](const char* name, const std::string& content) {
        Diagnostics diagnostics;
        EXPECT_EQ(loadContent(name, content, {}, &diagnostics).triangles.size(), 1U) << name;
        return diagnostics.warnings();
    };
    EXPECT_THAT(warningsOf("a.ply", ply + "\n \n"), IsEmpty());
    EXPECT_THAT(warningsOf("a.ply", ply + "3 0 1 2\n\n3 0 2 1\n"),
                ElementsAre(HasSubstr("2 lines are left over")));
    EXPECT_THAT(warningsOf("a.ply", binary), IsEmpty());
    EXPECT_THAT(warningsOf("a.ply", binary + std::string(13, '\1')),
                ElementsAre(HasSubstr("13 bytes are left over")));
    EXPECT_THAT(warningsOf("a.off", off + "# no more\n"), IsEmpty());
    EXPECT_THAT(warningsOf("a.off", off + "3 0 2 1\n"),
                ElementsAre(HasSubstr("1 lines are left over behind its 1 faces")));
    EXPECT_THAT(warningsOf("a.stl", stl), IsEmpty());
    EXPECT_THAT(warningsOf("a.stl", stl + std::string(50, '\0')),
                ElementsAre(HasSubstr("50 bytes are left over behind its 1 triangles")));
}

TEST(MeshGaps, ElementsOfAnOffMayShareLines)
{
    for (const char* text :
         {"OFF 4 2 0 0 0 0 0 0 1 1 0 0 1 0 1 3 0 1 2 3 2 1 3",
          "OFF # a square\n4 2 0\n0 0 0 0 0 1\n1 0 0 1 0 1 # corners\n3 0 1 2 3 2 1 3\n",
          "OFF\n4\n2 0\n0 0 0\n0 0 1\n1 0 0\n1 0 1\n3 0 1 2\n3 2 1 3\n"}) {
        Diagnostics diagnostics;
        const GroundMesh mesh = loadContent("a.off", text, {}, &diagnostics);
        ASSERT_EQ(mesh.triangles.size(), 2U) << text;
        EXPECT_DOUBLE_EQ(mesh.area(0) + mesh.area(1), 1.0) << text;
        EXPECT_THAT(diagnostics.warnings(), IsEmpty()) << text;
    }
    EXPECT_THAT(inputErrorOf("a.off", "OFF 4 2 0 0 0 0 0 0 1 1 0 0 1 0 1 3 0 1 2 3 2 1"),
                HasSubstr("truncated"));
    // Faces without corners take two bytes each.
    std::string many = "OFF\n3 40 0\n0 0 0\n0 0 1\n1 0 0\n3 0 1 2\n";
    for (int i = 0; i < 39; ++i)
        many += "0\n";
    EXPECT_EQ(loadContent("a.off", many).triangles.size(), 1U);
}

TEST(MeshGaps, TellsOfPolygonsOfTooManyCorners)
{
    constexpr int corners = 4098;
    std::string text = fmt::format("OFF\n{} 1 0\n", corners);
    for (int i = 0; i < corners; ++i) {
        const double angle = -6.283185307179586 * i / corners;
        const double radius = i % 2 == 0 ? 1.0 : 2.0;
        text += fmt::format("{} 0 {}\n", radius * std::cos(angle), radius * std::sin(angle));
    }
    text += fmt::format("{}", corners);
    for (int i = 0; i < corners; ++i)
        text += fmt::format(" {}", i);
    Diagnostics diagnostics;
    loadContent("a.off", text, {}, &diagnostics);
    EXPECT_THAT(diagnostics.warnings(), Contains(HasSubstr("have more than 4096 corners, face 0")));
}

TEST(MeshGaps, AnStlMayBeCalledFacet)
{
    const std::string text = "solid facet of stone endsolid x\nfacet normal 0 1 0 outer loop\n"
                             "vertex 0 0 0 vertex 1 0 0 vertex 1 0 -1 endloop endfacet\n"
                             "endsolid facet";
    Diagnostics diagnostics;
    EXPECT_EQ(loadContent("a.stl", text, {}, &diagnostics).triangles.size(), 1U);
    EXPECT_THAT(diagnostics.warnings(), IsEmpty());
}

TEST(MeshGaps, AVertexOfTwoCoordinatesLacksItsThird)
{
    for (const char* rest : {"", "  ", " # a comment"})
        EXPECT_THAT(
            inputErrorOf("a.obj", fmt::format("v 0 0 0\nv 4 0{}\nv 4 4 0\nf 1 2 3\n", rest)),
            HasSubstr("line 2: the vertex has 2 coordinates: z is missing"));
    EXPECT_THAT(inputErrorOf("a.off", "OFF\n# flat\n3 1 0\n0 0\n4 0\n4 4\n3 0 1 2\n"),
                HasSubstr("line 4: the vertex has 2 coordinates: z is missing"));
    EXPECT_THAT(inputErrorOf("a.stl",
                             "solid a facet normal 0 1 0 outer loop\nvertex 0 0\nvertex 1 0\n"
                             "vertex 1 1\nendloop endfacet endsolid"),
                HasSubstr("line 3: coordinate z of a vertex is missing"));
}

TEST(MeshGaps, TakesMaterialLibrariesOfNearlyTheNameWithAWarning)
{
    const ScratchFolder folder;
    folder.write("Meadow.mtl", "newmtl grass\nKd 0.25 0.5 0.125\n");
    const std::string obj = folder.write("a.obj", "mtllib MEADOW.MTL\nv 0 0 0\nv 0 0 1\nv 1 0 0\n"
                                                  "usemtl grass\nf 1 2 3\n");
    Diagnostics diagnostics;
    const GroundMesh mesh = load(obj, {}, diagnostics);
    EXPECT_FLOAT_EQ(mesh.materials[0].baseColor.y, 0.5f);
    EXPECT_THAT(diagnostics.warnings(), ElementsAre(HasSubstr("Meadow.mtl is taken")));
}

TEST(MeshGaps, AnStlMayHaveAnyWhiteSpaceBetweenItsWords)
{
    const std::string lines =
        "solid the facet of a stone\nfacet normal 0 1 0\nouter loop\nvertex 0 "
        "0 0\nvertex 4 0 0\nvertex 4 0 -4\nendloop\nendfacet\nfacet\nouter "
        "loop\nvertex 0 0 0\nvertex 4 0 -4\nvertex 0 0 -4\nendloop\n"
        "endfacet\nendsolid the facet of a stone\n";
    for (const std::string space : {"\n", " ", "\t", "\r\n", "\r", "\v", "\f", "\n\n  "}) {
        std::string text;
        for (const char c : lines)
            text += c == '\n' || c == ' ' ? space : std::string(1, c);
        for (const bool isUpper : {false, true}) {
            if (isUpper)
                std::transform(text.begin(), text.end(), text.begin(),
                               [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
            Diagnostics diagnostics;
            const GroundMesh mesh = loadContent("a.stl", text, {}, &diagnostics);
            EXPECT_EQ(mesh.triangles.size(), 2U);
            EXPECT_DOUBLE_EQ(mesh.area(0) + mesh.area(1), 16.0);
            EXPECT_THAT(diagnostics.warnings(), IsEmpty());
        }
    }
}

} // namespace
} // namespace sward::terrain
