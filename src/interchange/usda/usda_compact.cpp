#include "interchange/usda/usda_compact.h"

#include "core/bounds.h"
#include "core/math/srgb.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

namespace sward::interchange {
namespace {

using Appender = std::back_insert_iterator<fmt::memory_buffer>;

// Appends `[a,b,…]`, each by `append`.
template <typename Append>
void appendList(fmt::memory_buffer& text, const char* declaration,
                const std::vector<Instance>& instances, Append append)
{
    const Appender out = std::back_inserter(text);
    fmt::format_to(out, "        {} = [", declaration);
    bool isFirst = true;
    for (const Instance& instance : instances) {
        if (!isFirst)
            text.push_back(',');
        isFirst = false;
        append(out, instance);
    }
    fmt::format_to(out, "]");
}

// Appends a primvar of few different values as these and indices. Frequent values come first, since
// small indices have few digits.
template <typename ValueOf>
void appendIndexed(fmt::memory_buffer& text, const char* type, const char* name,
                   const std::vector<Instance>& instances, ValueOf valueOf)
{
    std::map<std::string, std::size_t> counts;
    for (const Instance& instance : instances)
        ++counts[valueOf(instance)];
    std::vector<std::pair<std::size_t, std::string>> values;
    for (const auto& [value, count] : counts)
        values.emplace_back(count, value);
    std::sort(values.begin(), values.end(), [](const auto& a, const auto& b) {
        return a.first != b.first ? a.first > b.first : a.second < b.second;
    });

    const Appender out = std::back_inserter(text);
    fmt::format_to(out, "        {}[] primvars:{} = [", type, name);
    for (std::size_t i = 0; i < values.size(); ++i) {
        fmt::format_to(out, "{}{}", i == 0 ? "" : ",", values[i].second);
        counts[values[i].second] = i;
    }
    fmt::format_to(out, "] (\n            interpolation = \"varying\"\n        )\n");
    appendList(
        text, fmt::format("int[] primvars:{}:indices", name).c_str(), instances,
        [&](Appender to, const Instance& i) { fmt::format_to(to, "{}", counts.at(valueOf(i))); });
    text.push_back('\n');
}

void appendHundredths(Appender out, int value)
{
    // TinyUSDZ wants a digit before the point.
    if (value % 100 == 0)
        fmt::format_to(out, "{}", value / 100);
    else
        fmt::format_to(out, "{}", double(value) / 100.0);
}

// The largest scale of each species; 1 for one without instances.
std::vector<glm::vec3> largestScales(const std::vector<Instance>& instances, std::size_t species)
{
    std::vector<glm::vec3> largest(species, glm::vec3(0.0f));
    for (const Instance& i : instances)
        largest[i.blade.species] = glm::max(largest[i.blade.species], i.scale);
    for (glm::vec3& scale : largest)
        if (scale.x <= 0.0f)
            scale = glm::vec3(1.0f);
    return largest;
}

} // namespace

std::array<int, 4> hundredthsOf(const glm::quat& rotation)
{
    const glm::dvec4 exact(rotation.w, rotation.x, rotation.y, rotation.z);
    const glm::dvec4 low = glm::floor(100.0 * exact);
    glm::dvec4 best = low;
    double least = 1e9;
    for (unsigned int corner = 0; corner < 16; ++corner) {
        glm::dvec4 candidate = low;
        for (int c = 0; c < 4; ++c)
            candidate[c] += double(corner >> static_cast<unsigned int>(c) & 1U);
        const double length = glm::length(candidate);
        // The sine of half the turn, and twice the change of length: readers do not normalise, so
        // it counts up to four times in sizes.
        const double turn = glm::length(candidate / length - exact);
        const double stretch = 2.0 * (length / 100.0 - 1.0);
        const double error = turn * turn + stretch * stretch;
        if (error < least) {
            least = error;
            best = candidate;
        }
    }
    std::array<int, 4> result;
    for (int c = 0; c < 4; ++c)
        result[static_cast<std::size_t>(c)] = static_cast<int>(best[c]);
    // Of both signs, which turn alike, that with fewer minus signs.
    if (std::ranges::count_if(result, [](int c) { return c < 0; }) >
        std::ranges::count_if(result, [](int c) { return c > 0; }))
        for (int& c : result)
            c = -c;
    return result;
}

void appendCompactGroup(fmt::memory_buffer& text, const BladeGroup& group, std::size_t index,
                        const std::vector<std::string>& prototypes,
                        const std::vector<Instance>& instances, bool withIds)
{
    // Positions begin at the lowest corner of the roots: they have no sign and few digits.
    Aabb roots;
    for (const Instance& instance : instances)
        roots.add(instance.place);
    const glm::vec3 extent = instances.empty() ? glm::vec3(0.0f) : roots.high - roots.low;
    const double unit = usdaPlaceStep(double(std::max({extent.x, extent.y, extent.z})));
    const glm::dvec3 low =
        instances.empty() ? glm::dvec3(0.0) : glm::floor(glm::dvec3(roots.low) / unit) * unit;
    const glm::dvec3 place = group.place + low;
    const std::vector<glm::vec3> largest = largestScales(instances, prototypes.size());

    const Appender out = std::back_inserter(text);
    fmt::format_to(out, "\n    def PointInstancer \"group_{}\"\n    {{\n", index);
    const glm::dvec3 boxLow = glm::floor((glm::dvec3(group.bounds.low) - place) / unit);
    const glm::dvec3 boxHigh = glm::ceil((glm::dvec3(group.bounds.high) - place) / unit);
    fmt::format_to(out, "        float3[] extent = [({}, {}, {}), ({}, {}, {})]\n", boxLow.x,
                   boxLow.y, boxLow.z, boxHigh.x, boxHigh.y, boxHigh.z);
    if (withIds) {
        appendList(text, "int64[] ids", instances,
                   [](Appender to, const Instance& i) { fmt::format_to(to, "{}", i.id); });
        text.push_back('\n');
    }
    appendList(text, "quath[] orientations", instances, [&](Appender to, const Instance& i) {
        const std::array<int, 4> turn = hundredthsOf(i.rotation);
        const char* separator = "(";
        for (const int component : turn) {
            fmt::format_to(to, "{}", separator);
            appendHundredths(to, component);
            separator = ",";
        }
        fmt::format_to(to, ")");
    });
    text.push_back('\n');
    appendList(text, "point3f[] positions", instances, [&](Appender to, const Instance& i) {
        const glm::dvec3 steps = glm::round((glm::dvec3(i.place) - low) / unit);
        fmt::format_to(to, "({},{},{})", std::int64_t(steps.x), std::int64_t(steps.y),
                       std::int64_t(steps.z));
    });
    text.push_back('\n');
    if (withIds)
        appendIndexed(text, "float", "clump", instances,
                      [](const Instance& i) { return fmt::format("{}", i.blade.clump); });
    appendIndexed(text, "float", "exposure", instances,
                  [](const Instance& i) { return fmt::format("{}", i.blade.exposure); });
    appendIndexed(text, "float", "stiffness", instances,
                  [](const Instance& i) { return fmt::format("{}", i.blade.stiffness); });
    appendIndexed(text, "color3f", "tint", instances, [](const Instance& i) {
        return fmt::format("({:.6g},{:.6g},{:.6g})", linearOf(i.blade.tint.x),
                           linearOf(i.blade.tint.y), linearOf(i.blade.tint.z));
    });
    appendList(text, "int[] protoIndices", instances,
               [](Appender to, const Instance& i) { fmt::format_to(to, "{}", i.blade.species); });
    text.push_back('\n');
    appendList(text, "float3[] scales", instances, [&](Appender to, const Instance& i) {
        const glm::vec3 steps =
            glm::max(glm::round(float(usdaScaleSteps) * i.scale / largest[i.blade.species]), 1.0f);
        fmt::format_to(to, "({},{},{})", int(steps.x), int(steps.y), int(steps.z));
    });
    text.push_back('\n');

    std::string targets;
    for (const std::string& name : prototypes)
        targets += fmt::format("{}</Field/group_{}/Prototypes/{}>", targets.empty() ? "" : ", ",
                               index, name);
    fmt::format_to(out, "        rel prototypes = [{}]\n", targets);
    fmt::format_to(out,
                   "        float3 xformOp:scale = ({}, {}, {})\n"
                   "        double3 xformOp:translate = ({}, {}, {})\n"
                   "        uniform token[] xformOpOrder = [\"xformOp:translate\", "
                   "\"xformOp:scale\"]\n\n"
                   "        def Scope \"Prototypes\"\n        {{\n",
                   unit, unit, unit, place.x, place.y, place.z);
    for (std::size_t s = 0; s < prototypes.size(); ++s) {
        // A step of a scale, in steps of positions.
        const glm::vec3 step = largest[s] / (float(usdaScaleSteps) * float(unit));
        fmt::format_to(out,
                       "            def Xform \"{}\" (\n"
                       "                prepend references = </Field/Blades/{}>\n"
                       "            )\n            {{\n"
                       "                float3 xformOp:scale = ({}, {}, {})\n"
                       "                uniform token[] xformOpOrder = [\"xformOp:scale\"]\n"
                       "            }}\n",
                       prototypes[s], prototypes[s], step.x, step.y, step.z);
    }
    fmt::format_to(out, "        }}\n    }}\n");
}

} // namespace sward::interchange
