#include "fuzz/samples.h"

#include "bake/settings/meadow.h"
#include "bake/settings/stroke_file.h"
#include "bake/tiles/tile_files.h"
#include "core/files/mapped_file.h"
#include "field/delta.h"
#include "field/poses/blade_poses.h"
#include "field/write.h"
#include "fuzz/memory_file.h"
#include "presentation/settings_text.h"
#include "support/fields/fields.h"
#include "terrain/load.h"
#include "terrain/recipe.h"
#include "unit/field/sample_seeds.h"
#include "unit/terrain/gltf/compressed_glb.h"
#include "unit/terrain/image_files.h"
#include "unit/terrain/mesh_files/mesh_text.h"

namespace sward::fuzz {
namespace {

// A triangle with every feature of glTF.
terrain::GlbBuilder richGlb()
{
    terrain::GlbBuilder builder = terrain::triangleGlb();
    auto& primitive = builder.document["meshes"][0]["primitives"][0];
    primitive["attributes"]["COLOR_0"] =
        builder.bytes({1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}, "VEC4", true);
    primitive["attributes"]["TEXCOORD_0"] =
        builder.shorts({0, 0, 65535, 0, 0, 65535}, "VEC2", true);
    primitive["material"] = 0;
    const std::string png = terrain::greyPng({2, 1}, {0, 255}, 8);
    const int image = builder.view(png.data(), png.size());
    builder.document["images"] = {{{"bufferView", image}, {"mimeType", "image/png"}}};
    builder.document["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}}};
    builder.document["textures"] = {{{"source", 0}, {"sampler", 0}}};
    auto& material = builder.document["materials"][0];
    material = {{"name", "grass"}, {"doubleSided", true}};
    material["pbrMetallicRoughness"] = {{"baseColorFactor", {0.5, 0.25, 0.125, 1.0}},
                                        {"baseColorTexture", {{"index", 0}}}};
    material["pbrMetallicRoughness"]["baseColorTexture"]["extensions"]["KHR_texture_transform"] = {
        {"offset", {0.5, 0.25}}, {"scale", {2, 3}}, {"rotation", 1}};
    const std::vector<std::uint16_t> index = {1};
    const std::vector<float> value = {2, 0, 0};
    const int indexView = builder.view(index.data(), 2);
    const int valueView = builder.view(value.data(), 12);
    builder.document["accessors"][0]["sparse"] = {
        {"count", 1},
        {"indices", {{"bufferView", indexView}, {"componentType", 5123}}},
        {"values", {{"bufferView", valueView}}}};
    builder.document["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
        {"TRANSLATION", builder.floats({1, 0, 0, 2, 0, 0}, "VEC3")},
        {"ROTATION", builder.floats({0, 0, 0, 1, 0, 1, 0, 1}, "VEC4")}};
    builder.node({{"children", {0}}, {"rotation", {0, 0, 0, 1}}, {"scale", {1, -2, 1}}});
    return builder;
}

// A triangle with two joints and a morph target.
terrain::GlbBuilder posedGlb()
{
    terrain::GlbBuilder builder = terrain::triangleGlb();
    auto& primitive = builder.document["meshes"][0]["primitives"][0];
    primitive["attributes"]["JOINTS_0"] =
        builder.bytes({0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0}, "VEC4");
    primitive["attributes"]["WEIGHTS_0"] =
        builder.bytes({255, 0, 0, 0, 255, 0, 0, 0, 55, 200, 0, 0}, "VEC4", true);
    primitive["targets"] = {{{"POSITION", builder.floats({0, 1, 0, 0, 1, 0, 0, 1, 0}, "VEC3")},
                             {"NORMAL", builder.floats({1, 0, 0, 1, 0, 0, 1, 0, 0}, "VEC3")}}};
    builder.document["meshes"][0]["weights"] = {0.5};
    std::vector<float> binds(32, 0.0f);
    for (std::size_t i = 0; i < binds.size(); i += i % 16 == 15 ? 1 : 5)
        binds[i] = 1.0f;
    builder.document["nodes"][0]["skin"] = 0;
    builder.document["nodes"][0]["weights"] = {0.25};
    builder.node({{"translation", {0, 2, 0}}});
    builder.node({{"scale", {-1, 1, 1}}, {"children", {1}}});
    builder.document["skins"] = {
        {{"joints", {1, 2}}, {"inverseBindMatrices", builder.floats(binds, "MAT4")}}};
    return builder;
}

void addGltf(std::vector<Sample>& all)
{
    const auto add = [&](const char* name, const std::string& bytes) {
        all.push_back({"gltf_import", name, bytes});
    };
    add("triangle.glb", terrain::triangleGlb().glb());
    add("triangle.gltf", terrain::triangleGlb().gltf());
    add("rich.glb", richGlb().glb());
    add("rich.gltf", richGlb().gltf());
    add("posed.glb", posedGlb().glb());
    add("posed.gltf", posedGlb().gltf());
    add("meshopt.glb", terrain::meshoptGrid(4).glb());
    add("meshopt_filters.glb",
        terrain::meshoptGrid(4, {.indexMode = "INDICES", .shortIndices = true, .filters = true})
            .glb());
    add("draco.glb", terrain::dracoGrid(4, {.bits = 11}).glb());
    add("draco_sequential.glb", terrain::dracoGrid(4, {.edgebreaker = false, .bits = 11}).glb());
    terrain::GlbBuilder strip = terrain::plainGrid(2);
    strip.document["meshes"][0]["primitives"][0]["mode"] = 5;
    add("strip.glb", strip.glb());
}

void addMeshes(std::vector<Sample>& all)
{
    const std::string kinds[] = {"obj", "ply", "stl", "off"};
    for (const terrain::CubeFile& file : terrain::cubeFiles())
        for (std::size_t i = 0; i < std::size(kinds); ++i)
            if (file.name.substr(file.name.size() - 3) == kinds[i])
                all.push_back({"mesh_import", file.name, static_cast<char>(i) + file.content});
    all.push_back({"mesh_import", "corners.obj",
                   std::string(1, '\0') +
                       "mtllib a.mtl\no a\nusemtl b\nv 0 0 0 1 0 0\nv 0 0 1\nv 1 0 "
                       "0\nvt 0 0\nvn 0 1 0\nf 1/1/1 2//1 -1/1\n"});
    all.push_back({"mesh_import", "types.ply",
                   std::string(1, '\1') +
                       "ply\nformat ascii 1.0\nelement face 1\nproperty uint flags\nproperty list "
                       "short double vertex_index\nproperty list int ushort texcoord\nelement "
                       "vertex 3\nproperty short x\nproperty uint y\nproperty char z\nproperty "
                       "char nx\nproperty ushort ny\nproperty double nz\nproperty int "
                       "red\nproperty short green\nproperty char blue\nproperty list char float "
                       "rings\nelement tristrips 1\nproperty list int int "
                       "vertex_indices\nend_header\n7 3 0 1 2 6 0 0 1 0 0 1\n0 0 0 0 1 0 255 9 127 "
                       "0\n0 0 1 0 1 0 1 2 3 1 0.5\n1 0 0 0 1 0 4 5 6 0\n7 0 1 2 -1 2 1 0\n"});
    all.push_back(
        {"mesh_import", "line.stl",
         std::string(1, '\2') +
             "SOLID a facet facet normal 0 1 0\touter loop vertex 0 0 0 vertex 0 0 1\fvertex "
             "1 0 0 endloop endfacet"});
    all.push_back({"mesh_import", "double.ply",
                   std::string(1, '\1') + terrain::binaryPly({0, 0, 0, 0, 0, 1, 1, 0, 0})});
}

void addHeightmaps(std::vector<Sample>& all)
{
    const std::vector<std::uint16_t> heights = {0, 65535, 13107, 26214, 39321, 52428};
    const std::vector<float> metres = {0.0f, 1.0f, -9999.0f, 2.5f, 3.0f, 4.0f};
    const auto add = [&](const char* name, int choice, const std::string& bytes) {
        all.push_back(
            {"heightmap_import", name, std::string({static_cast<char>(choice), 3, 2}) + bytes});
    };
    add("grey16.png", 0, terrain::greyPng({3, 2}, heights, 16));
    add("own_mask.png", 0x42, terrain::greyPng({3, 2}, {0, 255, 9, 80, 3, 7}, 8, true));
    add("heights.r16", 0x81, terrain::rawHeights(heights));
    add("grid.asc", 0x21, "ncols 3\nnrows 2\ncellsize 2\nnodata_value 7\n0 1 2 3 4 7\n");
    add("tile.hgt", 0x22, std::string("\0\1\0\2\0\3\x80\0", 8));
    add("float.exr", 2, terrain::floatExr({3, 2}, metres));
    add("half_tiles.exr", 0x82,
        terrain::floatExr({3, 2}, metres, {.isHalf = true, .isTiled = true}));
}

void addTexts(std::vector<Sample>& all)
{
    for (const std::string& name : terrain::builtInNames())
        all.push_back({"recipe", name + ".json", std::string(terrain::builtInRecipe(name))});
    all.push_back(
        {"recipe", "small.json",
         R"({"kind": "hills", "extent": [4, 4], "cells": [8, 8], "octaves": 2, "gain": 0.4})"});
    all.push_back({"recipe", "map.json",
                   R"({"kind": "heightmap", "file": "a.r16", "size": [3, 2], "height": [0, 9]})"});
    all.push_back({"recipe", "mesh.json", R"({"kind": "mesh", "file": "a.obj", "up_axis": "z"})"});
    for (const std::string& name : bake::builtInMeadows())
        all.push_back({"meadow", name + ".json", bake::toJson(bake::loadMeadow(name))});
}

void addStrokes(std::vector<Sample>& all)
{
    all.push_back({"strokes", "none.json", bake::toJson(bake::Strokes())});
    bake::Strokes strokes;
    for (int kind = 0; kind <= int(bake::StrokeKind::clear); ++kind) {
        bake::Stroke& stroke = strokes.list.emplace_back();
        stroke.kind = static_cast<bake::StrokeKind>(kind);
        stroke.species = kind == int(bake::StrokeKind::species) ? "grass" : "";
        stroke.depth = kind % 3 == 0 ? 0.5 : 0.0;
        stroke.points = {{-1000, 0, 250 * kind}, {500, 100, 0}};
        if (kind % 2 == 0)
            stroke.normals = {{0, 1000, 0}};
        if (kind % 4 == 1)
            stroke.normals = {{0, 1000, 0}, {600, 800, 0}};
    }
    all.push_back({"strokes", "all.json", bake::toJson(strokes)});
    strokes.list = {strokes.list[0]};
    strokes.list[0].points.resize(1);
    strokes.list[0].normals.clear();
    all.push_back({"strokes", "dab.json", bake::toJson(strokes)});
}

// Blades at rest as `sward-view render --dump-blades` writes them.
void addPoses(std::vector<Sample>& all)
{
    const field::Field field = test::makeField({.blades = posesBlades});
    const field::FieldView view = field::viewOf(field);
    const std::vector<field::BladePose> poses = field::restingPoses(view);
    std::string text = "id,x,y,z,v1x,v1y,v1z,v2x,v2y,v2z,ux,uy,uz,eta,lod_width,cull_result\n";
    for (std::size_t i = 0; i < poses.size(); ++i) {
        text += std::to_string(view.idOf(i));
        for (const glm::vec3& v : {poses[i].v0, poses[i].v1, poses[i].v2})
            text +=
                "," + std::to_string(v.x) + "," + std::to_string(v.y) + "," + std::to_string(v.z);
        text += ",0,1,0,0,1,drawn\n";
    }
    all.push_back({"poses", "rest.csv", text});
}

void addSettings(std::vector<Sample>& all)
{
    render::FrameSettings settings;
    all.push_back({"settings", "usual.json", presentation::settingsText(settings)});
    settings.winds.clear();
    for (std::uint32_t kind = 0; kind < shared::windKinds; ++kind)
        settings.winds.push_back(render::windSource(kind));
    settings.colliders = {
        {{1.0, 2.0, 3.0}, {1.0, 2.0, 3.0}, 0.3, {}},
        {{1.0, 2.0, 3.0}, {4.0, 2.0, 3.0}, 0.2, {{0.0, {}}, {1.5, {1.0, 0.0, 0.0}}}}};
    settings.maxEdgeOn = 0.9f;
    settings.buckets = {7, 40.0f};
    settings.levelSteps = {{5.0f, 16}, {10.0f, 12}};
    settings.updateRate = {10.0f, 20.0f};
    settings.skyUp = {0.0f, 0.0f, 1.0f};
    settings.fogDensity = 0.1f;
    all.push_back({"settings", "everything.json", presentation::settingsText(settings)});
}

void addFields(std::vector<Sample>& all)
{
    const std::filesystem::path path = memoryFile().folder() / "sample.sward";
    const auto add = [&](const char* name, const field::Field& field) {
        field::writeField(field, path, true);
        const std::vector<std::byte> bytes = readFile(path);
        all.push_back({"field_reader", name,
                       std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size())});
    };
    add("empty.sward", test::emptyField());
    add("cloud.sward", test::makeField({.surface = test::Surface::cloud, .blades = 40}));
    add("sphere.sward", test::makeField({.surface = test::Surface::sphere, .blades = 300}));
    field::Field seeded =
        tests::seeded(test::makeField({.surface = test::Surface::cloud, .blades = 40}));
    add("seeded.sward", seeded);
    // Two cells of a meadow whose species vary from place to place, with bits and a large triangle.
    field::Seeds seeds;
    seeds.meadow = seeded.seeds->seeds.meadow;
    seeds.meadow.isMixed = true;
    field::SeedCell cell = tests::seedCell();
    field::addSeedCell(seeds, cell);
    cell.cell = {0, 0, 0};
    cell.pieces[0].form = 3U | 2U << 5U | 1U << 10U | 1U << 18U;
    cell.pieces[0].count = 10;
    cell.pieces[0].bits = static_cast<std::uint32_t>(cell.words.size());
    cell.words.push_back(0x3ffU);
    cell.conditions.resize(4, cell.conditions[0]);
    cell.conditions[2].growth = 0;
    field::addSeedCell(seeds, cell);
    seeded.seeds = std::make_shared<const field::SharedSeeds>(std::move(seeds));
    add("seeded_mixed.sward", seeded);
    std::filesystem::remove(path);
}

void addDeltas(std::vector<Sample>& all)
{
    const field::Field field = test::makeField({.surface = test::Surface::cloud, .blades = 600});
    const std::filesystem::path path = memoryFile().folder() / "sample.swdelta";
    field::writeDelta(path, {.origin = field.origin,
                             .cells = {{{0, 0, -1}, {}, {}, {}},
                                       {{0, 0, 1}, field.patches, field.blades, field.keys}},
                             .storage = {}});
    const auto add = [&](const char* name) {
        const std::vector<std::byte> bytes = readFile(path);
        all.push_back({"field_delta", name,
                       std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size())});
    };
    add("change.swdelta");
    const auto bare = std::make_shared<field::SeedCell>();
    bare->cell = {0, 0, 7};
    field::writeDelta(
        path, {.origin = field.origin,
               .cells = {{{0, 0, 1}, field.patches, field.blades, field.keys}},
               .storage = {},
               .seeds = {std::make_shared<const field::SeedCell>(tests::seedCell()), bare}});
    add("seeded.swdelta");
    std::filesystem::remove(path);
}

std::string contentOf(const std::filesystem::path& path)
{
    const std::vector<std::byte> bytes = readFile(path);
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

void addMasks(std::vector<Sample>& all)
{
    const auto add = [&](const char* name, int kind, int channel, const std::string& bytes) {
        all.push_back({"mask", name,
                       std::string({static_cast<char>(kind), static_cast<char>(channel)}) + bytes});
    };
    add("grey16.png", 0, 0, terrain::greyPng({3, 2}, {0, 65535, 13107, 26214, 39321, 52428}, 16));
    add("grey8.png", 0, 3, terrain::greyPng({2, 2}, {0, 255, 9, 80}, 8, true));
    // A true-colour TGA of 2 x 1 pixels.
    std::string tga(18, '\0');
    tga[2] = 2;
    tga[12] = 2;
    tga[14] = 1;
    tga[16] = 24;
    add("color.tga", 2, 1, tga + std::string("\1\2\3\4\5\6", 6));
    for (const char* text : {"vertex-color:R", "texture:a.png:G:invert", "material-texture:A"})
        all.push_back(
            {"mask", std::string(text).substr(0, 7) + ".txt", "\x80" + std::string(text)});
}

// A square of two triangles with an image.
terrain::GroundMesh paintedSquare()
{
    Diagnostics diagnostics;
    const std::string glb = richGlb().glb();
    return terrain::load(
        memoryFile().hold({reinterpret_cast<const std::uint8_t*>(glb.data()), glb.size()}, ".glb"),
        {}, diagnostics);
}

void addTileFiles(std::vector<Sample>& all)
{
    const std::filesystem::path folder = memoryFile().folder() / "sample.parts";
    std::filesystem::create_directory(folder);
    const auto add = [&](const char* name, int kind, const std::filesystem::path& path) {
        all.push_back(
            {"tile_files", name, std::string(1, static_cast<char>(kind)) + contentOf(path)});
    };
    bake::TilePart part;
    part.ground = paintedSquare();
    part.cells = {{0, 0, 0}, {-1, 0, 2}};
    part.features.curvature.assign(part.ground.positions.size(), 0.5f);
    bake::writePart(bake::partPath(folder, 0), tileFilesId, part);
    add("part", 0, bake::partPath(folder, 0));
    terrain::GroundMesh drawn = part.ground;
    drawn.images.resize(1);
    bake::writeImages(folder, tileFilesId, drawn);
    add("image", 2, bake::imagePath(folder, 0));
    part.ground.materials.front().image = terrain::GroundMaterial::noImage;
    bake::writePart(bake::partPath(folder, 0), tileFilesId, part);
    add("part_without_image", 0, bake::partPath(folder, 0));

    bake::TileResult tile;
    tile.counts.kept = 2;
    bake::CellTree& cell = tile.cells.emplace_back();
    cell.patches.resize(1);
    cell.blades.resize(2);
    cell.keys.resize(2);
    field::addSeedCell(tile.seeds, tests::seedCell());
    bake::writeTile(bake::tilePath(folder, 0), tileFilesId, tile);
    add("tile", 1, bake::tilePath(folder, 0));

    bake::TilePlan plan;
    plan.id = tileFilesId;
    plan.tiles = 3;
    plan.arguments = {"--density=2", "--", "a.glb"};
    plan.files = {{"meadow", "0123456789abcdef"}};
    bake::writePlan(folder / "plan.json", plan, true);
    add("plan.json", 3, folder / "plan.json");
    plan.plan.seeds = tests::seedMeadow(1);
    bake::writePlan(folder / "plan.json", plan, true);
    add("sown_plan.json", 3, folder / "plan.json");
    std::filesystem::remove_all(folder);
}

} // namespace

std::vector<Sample> samples()
{
    std::vector<Sample> all;
    addGltf(all);
    addMeshes(all);
    addHeightmaps(all);
    addTexts(all);
    addPoses(all);
    addStrokes(all);
    addSettings(all);
    addFields(all);
    addDeltas(all);
    addMasks(all);
    addTileFiles(all);
    return all;
}

} // namespace sward::fuzz
