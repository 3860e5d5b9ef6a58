// Reads a field by the extension, as SwardGrass3D does: fields LIBRARY FIELD. Prints what the
// extension says of a file that it refuses; else the blades of the MultiMesh buffers: place in the
// world, length of each axis, and custom data.
#include "gpu/godot/played_godot.h"

#include <cmath>
#include <cstdio>
#include <exception>

using namespace sward::played;

namespace {

void printBlades(Object& field, const Floats& buffer, const Doubles& place)
{
    const Doubles origin = std::get<Doubles>(field.call("origin"));
    for (std::size_t i = 0; i < buffer.size(); i += 20) {
        const float* const row = &buffer[i];
        const auto axis = [&](std::size_t column) {
            return std::hypot(row[column], row[4 + column], row[8 + column]);
        };
        std::printf("blade %.9f %.9f %.9f %.7g %.7g %.7g %.7g %.7g %.7g %.7g\n",
                    origin[0] + place[0] + double(row[3]), origin[1] + place[1] + double(row[7]),
                    origin[2] + place[2] + double(row[11]), double(axis(0)), double(axis(1)),
                    double(axis(2)), double(row[16]), double(row[17]), double(row[18]),
                    double(row[19]));
    }
}

void printField(Object& field)
{
    std::printf("blades %lld\n", static_cast<long long>(field.number("blade_count")));
    const auto breeze = std::get<Doubles>(field.call("breeze"));
    std::printf("breeze %g %g %g %g %g\n", breeze.at(0), breeze.at(1), breeze.at(2), breeze.at(3),
                breeze.at(4));
    const std::int64_t species = field.number("species_count");
    for (std::int64_t s = 0; s < species; ++s) {
        const auto vertices = std::get<Floats>(field.call("mesh_vertices", {s}));
        const auto indices = std::get<Integers>(field.call("mesh_indices", {s}));
        for (const std::int32_t index : indices)
            if (index < 0 || static_cast<std::size_t>(index) >= vertices.size() / 12)
                std::printf("index %d of %zu vertices\n", index, vertices.size() / 12);
        std::printf("species %s %zu %zu\n", field.text("species_name", {s}).c_str(),
                    vertices.size() / 12, indices.size() / 3);
    }
    const std::int64_t groups = field.number("group_count");
    for (std::int64_t g = 0; g < groups; ++g)
        for (std::int64_t s = 0; s < species; ++s)
            printBlades(field, std::get<Floats>(field.call("blade_buffer", {g, s})),
                        std::get<Doubles>(field.call("group_place", {g})));
    // Numbers that nothing has.
    for (const std::int64_t wrong : {std::int64_t(-1), groups})
        if (!std::get<Floats>(field.call("blade_buffer", {wrong, std::int64_t(0)})).empty() ||
            !std::get<Doubles>(field.call("group_place", {wrong})).empty())
            std::printf("group %lld has blades\n", static_cast<long long>(wrong));
    if (!std::get<Floats>(field.call("mesh_vertices", {species})).empty())
        std::printf("one species too many\n");
}

} // namespace

int main(int argc, char** argv)
{
    try {
        if (argc == 4)
            hide(argv[3]);
        Extension extension(argv[1], "sward_field_entry");
        extension.reach(GodotLevel::scene);
        {
            Object field("SwardFieldReader");
            const std::string wrong = field.text("open", {std::string(argv[2])});
            if (wrong.empty())
                printField(field);
            else
                std::printf("refused %s\n", wrong.c_str());
            field.call("close", {}, true);
            if (field.number("blade_count") != 0 || field.number("group_count") != 0)
                std::printf("a closed field has blades\n");
        }
        extension.leave(GodotLevel::scene);
        if (!methodsOf("SwardFieldReader").empty())
            std::printf("the class is still registered\n");
        for (const std::string& error : errors())
            std::printf("error %s\n", error.c_str());
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
