#include "core/error.h"
#include "unit/terrain/gltf/glb_builder.h"
#include "unit/terrain/mesh_files/mesh_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sward::terrain {
namespace {

using testing::HasSubstr;

ErrorKind kindOf(const std::string& name, const std::string& content)
{
    try {
        loadContent(name, content);
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr(name));
        return error.kind();
    }
    return ErrorKind::difference;
}

// Whether a text STL ends behind a whole facet or its end, and white space.
bool endsWholly(const std::string& text)
{
    const std::size_t end = text.find_last_not_of(" \n") + 1;
    const std::string last = text.substr(0, end).substr(text.find_last_of(" \n", end - 1) + 1);
    return last == "endfacet" || text.find("endsolid") != std::string::npos;
}

TEST(MeshDamage, RefusesEveryTruncationThatLosesAFace)
{
    for (const CubeFile& file : cubeFiles()) {
        // An OBJ may end after any line; of a text STL see below.
        if (file.name == "cube.obj")
            continue;
        const std::size_t last = file.content.size() - 2;
        for (std::size_t length = 0; length < last; ++length) {
            const std::string cut = file.content.substr(0, length);
            if (file.name == "text.stl" && endsWholly(cut))
                continue;
            EXPECT_EQ(kindOf(file.name, cut), ErrorKind::input)
                << file.name << " cut to " << length;
        }
    }
}

TEST(MeshDamage, WarnsOfATextStlWithoutItsEnd)
{
    std::size_t warned = 0;
    for (const CubeFile& file : cubeFiles())
        for (std::size_t length = 0; file.name == "text.stl" && length < file.content.size() - 2;
             ++length) {
            const std::string cut = file.content.substr(0, length);
            if (!endsWholly(cut) || cut.find("endsolid") != std::string::npos)
                continue;
            Diagnostics diagnostics;
            loadContent(file.name, cut, {}, &diagnostics);
            EXPECT_THAT(diagnostics.warnings(), testing::Contains(HasSubstr("no endsolid")));
            ++warned;
        }
    EXPECT_GE(warned, 12U);
}

TEST(MeshDamage, SurvivesEveryFlippedByte)
{
    for (const CubeFile& file : cubeFiles())
        for (std::size_t at = 0; at < file.content.size(); ++at)
            for (const unsigned mask : {0x01U, 0x08U, 0x40U, 0x80U}) {
                std::string damaged = file.content;
                damaged[at] = static_cast<char>(static_cast<unsigned char>(damaged[at]) ^ mask);
                kindOf(file.name, damaged);
            }
}

TEST(MeshDamage, RefusesCountsThatTheFileCannotHold)
{
    EXPECT_EQ(kindOf("a.off", "OFF\n3000000000 1000000000 0\n1 2 3\n"), ErrorKind::input);
    EXPECT_EQ(kindOf("a.ply",
                     "ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\nproperty "
                     "float x\nproperty float y\nproperty float z\nelement face 1\nproperty list "
                     "uchar int vertex_indices\nend_header\nabc"),
              ErrorKind::input);
    EXPECT_EQ(kindOf("a.ply",
                     "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float "
                     "y\nproperty float z\nelement face 1\nproperty list int int "
                     "vertex_indices\nend_header\n0 0 0\n2000000000 0 0 0\n"),
              ErrorKind::input);
    std::string stl(84, '\xff');
    EXPECT_EQ(kindOf("a.stl", stl), ErrorKind::input);
}

TEST(MeshDamage, RefusesNumbersThatAreNone)
{
    for (const char* wrong : {"nan", "inf", "-inf", "1e999", "x", ""}) {
        EXPECT_EQ(kindOf("a.obj", fmt::format("v 0 0 0\nv 0 {} 1\nv 1 0 0\nf 1 2 3\n", wrong)),
                  ErrorKind::input)
            << wrong;
        EXPECT_EQ(
            kindOf("a.off", fmt::format("OFF\n3 1 0\n0 0 0\n0 {} 1\n1 0 0\n3 0 1 2\n", wrong)),
            ErrorKind::input)
            << wrong;
    }
}

TEST(MeshDamage, RefusesCornersThatDoNotExist)
{
    EXPECT_EQ(kindOf("a.obj", "v 0 0 0\nv 0 0 1\nv 1 0 0\nf 1 2 4\n"), ErrorKind::input);
    EXPECT_EQ(kindOf("a.obj", "v 0 0 0\nv 0 0 1\nv 1 0 0\nf 1 2 0\n"), ErrorKind::input);
    EXPECT_EQ(kindOf("a.obj", "v 0 0 0\nv 0 0 1\nv 1 0 0\nf 1 2 99999999999\n"), ErrorKind::input);
    EXPECT_EQ(kindOf("a.off", "OFF\n3 1 0\n0 0 0\n0 0 1\n1 0 0\n3 0 1 3\n"), ErrorKind::input);
}

TEST(MeshDamage, SaysThatThereAreNoFaces)
{
    EXPECT_EQ(kindOf("a.obj", "v 0 0 0\nv 0 0 1\nv 1 0 0\n"), ErrorKind::input);
    EXPECT_EQ(kindOf("a.obj", "\n"), ErrorKind::input);
    EXPECT_EQ(kindOf("a.ply",
                     "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float "
                     "y\nproperty float z\nend_header\n0 0 0\n"),
              ErrorKind::input);
}

TEST(MeshDamage, RefusesAPlyWithTwoKindsOfVertices)
{
    const std::string vertices =
        "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
    EXPECT_EQ(
        kindOf("a.ply", "ply\nformat ascii 1.0\n" + vertices + vertices +
                            "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
                            "0 0 0\n0 0 1\n1 0 0\n0 0 0\n0 0 1\n1 0 0\n3 0 1 2\n"),
        ErrorKind::input);
}

TEST(MeshDamage, RefusesCornersThatAreNoCorners)
{
    const std::string vertices = "v 0 0 0\nv 0 0 1\nv 1 0 0\nvt 0 0\nvn 0 1 0\n";
    EXPECT_EQ(kindOf("a.obj", vertices + "f 1/1/1 2//1 \\\n 3/1\n"), ErrorKind::difference);
    for (const char* corner :
         {"/1", "0", "4", "-4", "a", "1.5", "/", "1/x", "1//x", "99999999999999999999"})
        EXPECT_EQ(kindOf("a.obj", vertices + "f 1 2 " + corner + "\n"), ErrorKind::input) << corner;
}

TEST(MeshDamage, RefusesEntriesWithoutBytes)
{
    EXPECT_EQ(kindOf("a.ply", "ply\nformat ascii 1.0\nelement vertex 4000000000\nend_header\n"),
              ErrorKind::input);
    EXPECT_EQ(kindOf("a.ply", "ply\nformat binary_little_endian 1.0\nelement dust "
                              "18446744073709551615\nend_header\n"),
              ErrorKind::input);
    std::string many = "ply\nformat ascii 1.0\n";
    for (int i = 0; i < 100; ++i)
        many += fmt::format("element e{} 0\n", i);
    EXPECT_EQ(kindOf("a.ply", many + "end_header\n"), ErrorKind::input);
}

TEST(MeshDamage, RefusesVariantsThatAreNotRead)
{
    EXPECT_EQ(kindOf("a.off", "OFF BINARY\nabc"), ErrorKind::input);
    EXPECT_EQ(kindOf("a.off", "4OFF\n3 1 0\n"), ErrorKind::unsupported);
}

} // namespace
} // namespace sward::terrain
