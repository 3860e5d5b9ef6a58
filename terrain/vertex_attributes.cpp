#include "terrain/vertex_attributes.h"

#include <algorithm>

namespace sward::terrain {

const VertexAttribute* VertexAttributes::find(const std::string& name) const
{
    for (const VertexAttribute& one : list)
        if (one.name == name)
            return &one;
    return nullptr;
}

VertexAttribute& VertexAttributes::entry(const std::string& name)
{
    for (VertexAttribute& one : list)
        if (one.name == name)
            return one;
    return list.emplace_back(VertexAttribute{.name = name, .components = 4, .values = {}});
}

void VertexAttributes::addGap(const std::string& attribute, std::size_t first, std::size_t end,
                              const std::string& part)
{
    if (first == end)
        return;
    // The gap before belongs to the same part if the part is met again at once.
    for (auto gap = gaps.rbegin(); gap != gaps.rend() && gap->end >= first; ++gap)
        if (gap->end == first && gap->attribute == attribute && parts[gap->part] == part) {
            gap->end = static_cast<std::uint32_t>(end);
            return;
        }
    if (parts.empty() || parts.back() != part)
        parts.push_back(part);
    gaps.push_back({attribute, static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(end),
                    static_cast<std::uint32_t>(parts.size() - 1)});
}

void VertexAttributes::addGeneratedGaps(const MaskInputs& read, std::size_t triangles,
                                        const std::string& part)
{
    for (const std::string& name : read.attributes)
        if (name != "TEXCOORD_0" && name != materialCoordinates)
            addGap(name, 0, triangles, part);
}

void VertexAttributes::appendGaps(const VertexAttributes& other, std::size_t firstTriangle)
{
    for (const AttributeGap& gap : other.gaps)
        addGap(gap.attribute, firstTriangle + gap.first, firstTriangle + gap.end,
               other.parts[gap.part]);
}

void VertexAttributes::resize(std::size_t count)
{
    for (VertexAttribute& one : list)
        one.values.resize(count, glm::vec4(1.0f));
}

void VertexAttributes::copyVertex(std::size_t vertex)
{
    for (VertexAttribute& one : list)
        one.values.push_back(glm::vec4(one.values[vertex]));
}

void VertexAttributes::keep(const std::vector<std::uint32_t>& newIndex, std::uint32_t dropped)
{
    for (VertexAttribute& one : list) {
        std::size_t kept = 0;
        for (std::size_t i = 0; i < one.values.size(); ++i)
            if (newIndex[i] != dropped)
                one.values[kept++] = one.values[i];
        one.values.resize(kept);
    }
}

} // namespace sward::terrain
