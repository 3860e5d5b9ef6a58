#include "interchange/usda/usda_blade.h"

#include "core/bounds.h"

#include <fmt/format.h>

namespace sward::interchange {
namespace {

std::string element(const glm::vec3& v)
{
    return fmt::format("({}, {}, {})", v.x, v.y, v.z);
}

std::string element(const glm::vec2& v)
{
    return fmt::format("({}, {})", v.x, v.y);
}

std::string element(std::uint32_t number)
{
    return fmt::format("{}", number);
}

template <typename T>
std::string array(const std::vector<T>& values)
{
    std::string text = "[";
    for (const T& value : values)
        text += (text.size() > 1 ? ", " : "") + element(value);
    return text + "]";
}

} // namespace

std::string usdBlade(const std::string& name, const BladeMesh& mesh, const shared::Species& species)
{
    Aabb bounds;
    for (const glm::vec3& position : mesh.positions)
        bounds.add(position);
    // Few readers support primvars in materials: the material has only the mean colour.
    std::vector<glm::vec3> colors;
    glm::vec3 mean(0.0f);
    for (const glm::vec3& color : mesh.colors) {
        colors.push_back(color * mesh.baseColor);
        mean += colors.back() / static_cast<float>(mesh.colors.size());
    }

    const std::string path = "/Field/Blades/" + name;
    const char* const perVertex = " (\n                    interpolation = \"vertex\"\n"
                                  "                )";
    std::string text;
    const auto line = [&](int depth, const std::string& words) {
        text += std::string(static_cast<std::size_t>(4 * depth), ' ') + words + "\n";
    };
    line(2, fmt::format("def Xform \"{}\"", name));
    line(2, "{");
    line(3, "def Mesh \"blade\" (");
    line(4, "prepend apiSchemas = [\"MaterialBindingAPI\"]");
    line(3, ")");
    line(3, "{");
    line(4, "uniform bool doubleSided = 1");
    line(4, "float3[] extent = " + array(std::vector{bounds.low, bounds.high}));
    line(4, "int[] faceVertexCounts = " +
                array(std::vector<std::uint32_t>(mesh.indices.size() / 3, 3)));
    line(4, "int[] faceVertexIndices = " + array(mesh.indices));
    line(4, fmt::format("rel material:binding = <{}/material>", path));
    line(4, "normal3f[] normals = " + array(mesh.normals) + perVertex);
    line(4, "point3f[] points = " + array(mesh.positions));
    line(4, "color3f[] primvars:displayColor = " + array(colors) + perVertex);
    line(4, "texCoord2f[] primvars:st = " + array(mesh.uvs) + perVertex);
    line(4, "uniform token subdivisionScheme = \"none\"");
    line(3, "}");
    line(0, "");
    line(3, "def Material \"material\"");
    line(3, "{");
    line(4, fmt::format("token outputs:surface.connect = <{}/material/surface.outputs:surface>",
                        path));
    line(0, "");
    line(4, "def Shader \"surface\"");
    line(4, "{");
    line(5, "uniform token info:id = \"UsdPreviewSurface\"");
    line(5, "color3f inputs:diffuseColor = " + element(mean));
    line(5, fmt::format("float inputs:roughness = {}", 1.0f - species.gloss));
    line(5, "token outputs:surface");
    line(4, "}");
    line(3, "}");
    line(2, "}");
    return text;
}

} // namespace sward::interchange
