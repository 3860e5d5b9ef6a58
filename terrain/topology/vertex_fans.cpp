#include "terrain/topology/vertex_fans.h"

#include "terrain/topology/half_edges.h"

#include <algorithm>

namespace sward::terrain {

std::size_t countFans(const std::vector<std::uint32_t>& around, std::uint32_t vertex,
                      const std::vector<glm::uvec3>& triangles,
                      const std::vector<glm::uvec3>& neighbours)
{
    const auto placeOf = [&](std::uint32_t triangle) {
        return static_cast<std::size_t>(std::lower_bound(around.begin(), around.end(), triangle) -
                                        around.begin());
    };

    // Link triangles across the edges at the vertex. At an edge of three triangles, two name the
    // third but not each other, so links go both ways.
    std::vector<std::vector<std::size_t>> links(around.size());
    for (std::size_t i = 0; i < around.size(); ++i)
        for (glm::length_t e = 0; e < 3; ++e) {
            const glm::uvec3 t = triangles[around[i]];
            const std::uint32_t other = neighbours[around[i]][e];
            if (other == Adjacency::none || (t[e] != vertex && t[(e + 1) % 3] != vertex))
                continue;
            links[i].push_back(placeOf(other));
            links[placeOf(other)].push_back(i);
        }

    // Walk through one fan after the other.
    std::vector<bool> seen(around.size(), false);
    std::size_t fans = 0;
    for (std::size_t i = 0; i < around.size(); ++i) {
        if (seen[i])
            continue;
        ++fans;
        std::vector<std::size_t> next = {i};
        while (!next.empty()) {
            const std::size_t at = next.back();
            next.pop_back();
            if (seen[at])
                continue;
            seen[at] = true;
            next.insert(next.end(), links[at].begin(), links[at].end());
        }
    }
    return fans;
}

} // namespace sward::terrain
