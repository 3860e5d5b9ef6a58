#include "render/frame/wind.h"

#include "core/error.h"
#include "core/expect.h"
#include "field/defaults.h"
#include "shaders/shared/wind.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace sward::render {
namespace {

static_assert(windNoise == shared::windNoise && windTurning == shared::windTurning &&
              windWave == shared::windWave && windRadial == shared::windRadial &&
              windSwirl == shared::windSwirl && windGusts == shared::windGusts);
static_assert(windKinds == shared::windKinds && maxWindSources == shared::maxWindSources);

/// Size [m] at which a turning wind is uniform.
constexpr float everywhere = 1e9f;

shared::WindSource relativeTo(glm::dvec3 origin, const WindSource& wind, const glm::quat& toWorld)
{
    shared::WindSource result = {};
    result.direction = wind.source.direction;
    result.strength = wind.source.strength;
    result.size = wind.source.size;
    result.speed = wind.source.speed;
    result.rate = wind.source.rate;
    result.turn = wind.source.turn;
    result.alignment = wind.source.alignment;
    result.lift = wind.source.lift;
    result.kind = wind.source.kind;
    const float length = glm::length(result.direction);
    result.direction = length > 0.0f ? result.direction / length : glm::vec3(1.0f, 0.0f, 0.0f);
    result.size = std::max(result.size, smallestWindSize);
    result.centre = glm::vec3(wind.centre - origin);
    shared::WindSource prepared = shared::preparedSource(result);
    // Across the wind as the world sees it, so that waves of tilted fields meet those of others.
    shared::WindSource inWorld = result;
    inWorld.direction = toWorld * result.direction;
    prepared.side = glm::conjugate(toWorld) * shared::preparedSource(inWorld).side;
    return prepared;
}

} // namespace

shared::WindLattice latticeOf(glm::dvec3 origin, const WindFrame& frame)
{
    glm::dvec3 place = frame.position + frame.scale * (frame.rotation * origin);
    place -= windPeriod * glm::round(place / windPeriod);
    const glm::dquat toField = glm::conjugate(frame.rotation);
    return {.origin = glm::vec3(toField * place / frame.scale),
            .x = glm::vec3(toField * glm::dvec3(1.0, 0.0, 0.0)),
            .y = glm::vec3(toField * glm::dvec3(0.0, 1.0, 0.0)),
            .z = glm::vec3(toField * glm::dvec3(0.0, 0.0, 1.0))};
}

WindSource windSource(std::uint32_t kind)
{
    requireUsage(kind < windKinds, "wind kind {}; there are {}", kind, windKinds);
    WindSource wind;
    WindPattern& s = wind.source;
    s.kind = kind;
    s.direction = {0.8f, 0.0f, 0.6f};
    s.strength = 3.0f;
    s.speed = 2.6f;
    s.alignment = 1.0f;
    switch (kind) {
    case windTurning:
        s.size = everywhere;
        s.rate = 1.0f;
        break;
    case windWave:
        s.size = 7.0f;
        break;
    // The paper's helicopter rings pull independently of a blade's direction. They travel at 10
    // blade lengths per second; its swirl at 15.
    case windRadial:
        s.size = 75.0f;
        s.speed = 10.0f;
        s.alignment = 0.0f;
        break;
    case windSwirl:
        s.size = 30.0f;
        s.speed = 15.0f;
        break;
    case windGusts:
        s.size = 12.0f;
        s.speed = 5.0f;
        break;
    default:
        s.size = 3.5f;
        break;
    }
    return wind;
}

std::vector<WindSource> sourcesOf(const field::Wind& breeze)
{
    WindSource wave = windSource(windWave);
    WindSource noise = windSource(windNoise);
    wave.source.strength = breeze.strength * (1.0f - breeze.gustiness);
    wave.source.size = breeze.waveLength;
    noise.source.strength = breeze.strength * breeze.gustiness;
    noise.source.size = breeze.gustSize;
    for (WindSource* wind : {&wave, &noise}) {
        wind->source.direction = breeze.direction;
        wind->source.speed = breeze.speed;
    }
    return {wave, noise};
}

float windStrength(const std::vector<WindSource>& sources)
{
    float sum = 0.0f;
    for (const WindSource& wind : sources)
        sum += wind.source.strength;
    return sum;
}

void scaleWind(std::vector<WindSource>& sources, float strength)
{
    const float before = windStrength(sources);
    if (before <= 0.0f)
        return;
    for (WindSource& wind : sources)
        wind.source.strength *= strength / before;
}

std::vector<WindSource> withStrength(std::span<const WindSource> sources)
{
    std::vector<WindSource> result;
    std::ranges::copy_if(sources, std::back_inserter(result),
                         [](const WindSource& wind) { return wind.source.strength > 0.0f; });
    std::ranges::stable_sort(result, {}, [](const WindSource& wind) { return wind.source.kind; });
    return result;
}

std::vector<shared::WindSource> blowing(const std::vector<WindSource>& sources, glm::dvec3 origin,
                                        const WindFrame& frame)
{
    std::vector<shared::WindSource> result;
    for (const WindSource& wind : withStrength(sources))
        result.push_back(relativeTo(origin, wind, glm::quat(frame.rotation)));
    return result;
}

shared::Wind together(std::span<const shared::WindSource> sources, float extent,
                      const shared::WindLattice& lattice)
{
    expect(sources.size() <= shared::maxWindSources, "at most maxWindSources blow at once");
    shared::Wind wind = {};
    wind.lattice = lattice;
    std::ranges::copy(sources, wind.sources);
    std::ranges::fill(wind.phases, shared::windPhaseAtZero());
    if (!sources.empty() && std::ranges::all_of(sources, [&](const shared::WindSource& source) {
            return shared::blowsLike(sources.front(), source);
        }))
        wind.counts |= shared::windsAlike;
    wind.eddySize = extent > 0.0f ? 0.25f * extent : everywhere;
    for (const shared::WindSource& source : sources) {
        wind.counts += 1u << (4u * source.kind);
        wind.sum += source.strength;
        if (source.kind == shared::windRadial || source.kind == shared::windSwirl)
            continue;
        wind.eddySize = std::min(wind.eddySize, 2.0f * source.size);
        wind.eddySpeed = std::max(wind.eddySpeed, std::abs(source.speed));
    }
    return wind;
}

shared::Wind together(std::span<const shared::WindSource> sources, float extent)
{
    return together(sources, extent, latticeOf(glm::dvec3(0.0), {}));
}

} // namespace sward::render
