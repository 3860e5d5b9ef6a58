#include "interchange/usda.h"

#include "core/files/atomic_file.h"
#include "core/math/srgb.h"
#include "interchange/blade_groups.h"
#include "interchange/instances.h"
#include "interchange/usda/usda_blade.h"
#include "interchange/usda/usda_compact.h"
#include "interchange/usda/usda_text.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <string>
#include <vector>

namespace sward::interchange {
namespace {

using Out = std::back_insert_iterator<fmt::memory_buffer>;

void appendVector(Out out, float x, float y, float z)
{
    fmt::format_to(out, "({}, {}, {})", x, y, z);
}

void appendPlace(Out out, const Instance& i)
{
    appendVector(out, i.place.x, i.place.y, i.place.z);
}

// quath has half precision: five digits suffice.
void appendOrientation(Out out, const Instance& i)
{
    fmt::format_to(out, "({:.5g}, {:.5g}, {:.5g}, {:.5g})", i.rotation.w, i.rotation.x,
                   i.rotation.y, i.rotation.z);
}

void appendScale(Out out, const Instance& i)
{
    appendVector(out, i.scale.x, i.scale.y, i.scale.z);
}

void appendSpecies(Out out, const Instance& i)
{
    fmt::format_to(out, "{}", i.blade.species);
}

void appendId(Out out, const Instance& i)
{
    fmt::format_to(out, "{}", i.id);
}

void appendStiffness(Out out, const Instance& i)
{
    fmt::format_to(out, "{}", i.blade.stiffness);
}

void appendExposure(Out out, const Instance& i)
{
    fmt::format_to(out, "{}", i.blade.exposure);
}

void appendClump(Out out, const Instance& i)
{
    fmt::format_to(out, "{}", i.blade.clump);
}

void appendTint(Out out, const Instance& i)
{
    // USD's colours are linear.
    fmt::format_to(out, "({:.6g}, {:.6g}, {:.6g})", linearOf(i.blade.tint.x),
                   linearOf(i.blade.tint.y), linearOf(i.blade.tint.z));
}

// The arrays of a PointInstancer, one element per instance.
struct InstanceArray {
    const char* declaration;
    const char* metadata;
    void (*append)(Out out, const Instance& instance);
};
constexpr const char* varying = " (\n            interpolation = \"varying\"\n        )";
constexpr InstanceArray arrays[] = {
    {"int64[] ids", "", appendId},
    {"quath[] orientations", "", appendOrientation},
    {"point3f[] positions", "", appendPlace},
    {"float[] primvars:clump", varying, appendClump},
    {"float[] primvars:exposure", varying, appendExposure},
    {"float[] primvars:stiffness", varying, appendStiffness},
    {"color3f[] primvars:tint", varying, appendTint},
    {"int[] protoIndices", "", appendSpecies},
    {"float3[] scales", "", appendScale},
};

void appendArray(Out out, const InstanceArray& array, const std::vector<Instance>& instances)
{
    fmt::format_to(out, "        {} = [", array.declaration);
    const char* separator = "";
    for (const Instance& instance : instances) {
        fmt::format_to(out, "{}", separator);
        array.append(out, instance);
        separator = ", ";
    }
    fmt::format_to(out, "]{}\n", array.metadata);
}

// Unique prim names of letters, digits and underscores.
std::vector<std::string> prototypeNames(const field::FieldView& field)
{
    std::vector<std::string> names;
    for (std::size_t s = 0; s < field.species.size(); ++s)
        names.push_back(fmt::format("species_{}_{}", s, usdIdentifier(field.species[s].name)));
    return names;
}

void appendHeader(Out out, const field::FieldView& field, const ExportSettings& settings)
{
    fmt::format_to(out,
                   "#usda 1.0\n(\n    customLayerData = {{\n"
                   "        string copyright = {}\n        string generator = {}\n    }}\n"
                   "    defaultPrim = \"Field\"\n    metersPerUnit = 1\n    upAxis = \"Y\"\n)\n\n",
                   usdString(*field.copyright), usdString(settings.generator));
    fmt::format_to(out,
                   "def Xform \"Field\"\n{{\n    double3 xformOp:translate = ({}, {}, {})\n"
                   "    uniform token[] xformOpOrder = [\"xformOp:translate\"]\n\n",
                   field.origin.x, field.origin.y, field.origin.z);
}

void appendGroup(Out out, const BladeGroup& group, std::size_t index,
                 const std::vector<std::string>& prototypes, const std::vector<Instance>& instances)
{
    fmt::format_to(out, "\n    def PointInstancer \"group_{}\"\n    {{\n", index);
    const glm::vec3 low(glm::dvec3(group.bounds.low) - group.place);
    const glm::vec3 high(glm::dvec3(group.bounds.high) - group.place);
    fmt::format_to(out, "        float3[] extent = [({}, {}, {}), ({}, {}, {})]\n", low.x, low.y,
                   low.z, high.x, high.y, high.z);
    for (const InstanceArray& array : arrays)
        appendArray(out, array, instances);

    // Prototypes below the instancer are drawn only through it.
    std::string targets;
    for (const std::string& name : prototypes)
        targets += fmt::format("{}</Field/group_{}/Prototypes/{}>", targets.empty() ? "" : ", ",
                               index, name);
    fmt::format_to(out, "        rel prototypes = [{}]\n", targets);
    fmt::format_to(out,
                   "        double3 xformOp:translate = ({}, {}, {})\n"
                   "        uniform token[] xformOpOrder = [\"xformOp:translate\"]\n\n"
                   "        def Scope \"Prototypes\"\n        {{\n",
                   group.place.x, group.place.y, group.place.z);
    for (const std::string& name : prototypes)
        fmt::format_to(out,
                       "            def Xform \"{}\" (\n"
                       "                prepend references = </Field/Blades/{}>\n"
                       "            )\n            {{\n            }}\n",
                       name, name);
    fmt::format_to(out, "        }}\n    }}\n");
}

void writeAndClear(AtomicFile& file, fmt::memory_buffer& text)
{
    file.write(std::string_view(text.data(), text.size()));
    text.clear();
}

} // namespace

void writeUsda(const field::FieldView& field, const std::filesystem::path& path,
               const ExportSettings& settings, Progress& progress)
{
    AtomicFile file(path, settings.overwrite);
    progress.begin("export", field.blades.size());
    fmt::memory_buffer text;
    const Out out = std::back_inserter(text);
    const std::vector<std::string> prototypes = prototypeNames(field);
    appendHeader(out, field, settings);

    // Define each species' blade once, as an undrawn prototype.
    const std::vector<MeanBlade> means = meanBlades(field);
    fmt::format_to(out, "    class Scope \"Blades\"\n    {{\n");
    for (std::size_t s = 0; s < prototypes.size(); ++s)
        text.append(usdBlade(prototypes[s], bladeMesh(field.species[s], *field.defaults, means[s]),
                             field.species[s].look));
    fmt::format_to(out, "    }}\n");

    const std::vector<BladeGroup> groups = groupBlades(field);
    for (std::size_t g = 0; g < groups.size(); ++g) {
        const std::vector<Instance> instances = instancesOf(field, groups[g], settings.source);
        if (settings.compact)
            appendCompactGroup(text, groups[g], g, prototypes, instances, settings.withIds);
        else
            appendGroup(out, groups[g], g, prototypes, instances);
        writeAndClear(file, text);
        progress.advance(groups[g].bladeCount);
    }
    fmt::format_to(out, "}}\n");
    writeAndClear(file, text);
    file.commit();
}

} // namespace sward::interchange
