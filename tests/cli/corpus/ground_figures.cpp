// Sward's figures of many ground files in one process, for corpus_test.py. Each line of stdin is a
// file and its options, apart by tabs: size=W,H extent=X,Z height=MIN,MAX endian=E no_data=V. Each
// line of stdout is JSON: triangles with an area, area, color (mean by area of what blades take
// their tint from, linear), blades, tint (their mean), or error.

#include "bake/bake.h"
#include "bake/ground/drawn_colors.h"
#include "core/error.h"
#include "core/json/json_text.h"
#include "terrain/load.h"
#include "terrain/loading/repeated_ground.h"

#include <fmt/core.h>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>

#include <cstdio>
#include <iostream>
#include <sstream>
#include <string>

namespace {

using namespace sward;

constexpr std::uint64_t blades = 600; // of each file

glm::dvec2 pairIn(const std::string& text)
{
    const std::size_t comma = text.find(',');
    return {std::stod(text.substr(0, comma)), std::stod(text.substr(comma + 1))};
}

void readOption(const std::string& option, terrain::HeightmapSettings& settings)
{
    const std::size_t equals = option.find('=');
    const std::string key = option.substr(0, equals);
    const std::string value = option.substr(equals + 1);
    if (key == "size")
        settings.size = glm::uvec2(pairIn(value));
    else if (key == "extent")
        settings.extent = pairIn(value);
    else if (key == "height")
        settings.height = pairIn(value);
    else if (key == "endian")
        settings.endian = value;
    else if (key == "no_data")
        settings.noData = std::stod(value);
    else
        fail(ErrorKind::usage, "unknown option {}", option);
}

nlohmann::json arrayOf(const glm::dvec3& v)
{
    return {v.x, v.y, v.z};
}

// Mean by area, linear.
glm::dvec3 meanColor(const terrain::GroundMesh& ground)
{
    const std::vector<glm::vec3> base = bake::drawnBaseColors(ground, false);
    glm::dvec3 sum(0.0);
    double area = 0.0;
    for (std::size_t t = 0; t < ground.triangles.size(); ++t) {
        const std::uint32_t material = ground.materialOf[t];
        glm::dvec3 color(base[material]);
        if (bake::showsVertexColors(ground, material, false)) {
            glm::dvec3 corners(0.0);
            for (glm::length_t c = 0; c < 3; ++c)
                corners += glm::dvec3(bake::vertexColor(ground, material, ground.triangles[t][c]));
            color *= corners / 3.0;
        }
        sum += ground.area(t) * color;
        area += ground.area(t);
    }
    return sum / area;
}

nlohmann::json figuresOf(const std::string& line)
{
    std::istringstream words(line);
    std::string path;
    std::getline(words, path, '\t');
    terrain::ImportSettings import;
    for (std::string option; std::getline(words, option, '\t');)
        readOption(option, import.heightmap);
    Diagnostics diagnostics;
    terrain::GroundMesh ground = terrain::load(path, import, diagnostics);
    terrain::removeCoincident(ground, diagnostics);

    bake::BakeSettings settings;
    settings.count = blades;
    settings.exposureRays = 0;
    settings.meadow =
        bake::parseMeadow(R"({"species": [{"name": "grass", "share": 1}]})", "meadow");
    Progress progress;
    const bake::BakeResult baked = bake::bakeField(ground, settings, 1, diagnostics, progress);
    glm::dvec3 tint(0.0);
    for (const shared::PackedBlade& blade : baked.field.blades)
        tint += glm::dvec3(double(blade.look & 31U) / 31.0, double((blade.look >> 5U) & 63U) / 63.0,
                           double((blade.look >> 11U) & 31U) / 31.0);
    // Stitches of strips have no area.
    std::uint64_t triangles = baked.report.input.triangles;
    for (std::size_t t = 0; t < ground.triangles.size(); ++t)
        triangles -= ground.area(t) > 0.0 ? 0U : 1U;
    return {{"triangles", triangles},
            {"area", baked.report.input.area},
            {"color", arrayOf(meanColor(ground))},
            {"blades", baked.field.blades.size()},
            {"tint", arrayOf(tint / double(baked.field.blades.size()))},
            {"warnings", diagnostics.warnings()}};
}

} // namespace

int main()
{
    for (std::string line; std::getline(std::cin, line);) {
        nlohmann::json figures;
        try {
            figures = figuresOf(line);
        } catch (const Error& error) {
            figures = {{"error", error.what()}};
        }
        fmt::print("{}\n", jsonText(figures));
    }
    return 0;
}
