// A beam of a range sensor: its rays, and the returns that its receiver tells apart.
#ifndef SWARD_SHARED_LIDAR_RETURNS_H
#define SWARD_SHARED_LIDAR_RETURNS_H

#include "shaders/shared/types.h"

SHARED_BEGIN

/// How a sensor measures; lidar::LidarSettings has the ranges.
struct LidarSensor {
    float halfExit;   ///< [m] half of a beam's width where it starts
    float spread;     ///< tangent of half of its cone's angle
    float resolution; ///< [m] what lies within it of the nearest makes one return
    float nearest;    ///< [m] what is nearer gives no return, but hides
    float farthest;   ///< [m] likewise
    uint rays;        ///< of a beam
    uint maxReturns;  ///< the nearest are kept
};
SHARED_LAYOUT(LidarSensor, 28)

/// A pulse. `turn` of its rays about the axis, as cosine and sine.
struct LidarBeam {
    vec3 from; ///< [m] relative to the field's origin
    float turnCosine;
    vec3 towards; ///< unit
    float turnSine;
};
SHARED_LAYOUT(LidarBeam, 32)

struct LidarRay {
    vec3 from;    ///< [m]
    vec3 towards; ///< unit
};

/// The ray at `place` of the beam's cross-section, a unit disk.
SHARED_FN LidarRay rayOfBeam(LidarSensor sensor, LidarBeam beam, vec2 place)
{
    const vec3 z = beam.towards;
    // An axis across that is not along the beam.
    const vec3 aside = abs(z.y) < 0.9f ? vec3(0.0f, 1.0f, 0.0f) : vec3(1.0f, 0.0f, 0.0f);
    const vec3 x = normalize(cross(z, aside));
    const vec3 y = cross(z, x);
    const float along = beam.turnCosine * place.x - beam.turnSine * place.y;
    const float across = beam.turnSine * place.x + beam.turnCosine * place.y;
    const vec3 off = along * x + across * y;
    LidarRay ray;
    ray.from = beam.from + sensor.halfExit * off;
    ray.towards = normalize(z + sensor.spread * off);
    return ray;
}

/// Number of the ground among blades.
SHARED_CONST uint lidarGround = 0xffffffffu;

/// Where a ray of a beam ends.
struct LidarEnd {
    float range;  ///< [m], or lidarMissed, lidarUncounted
    float power;  ///< reflectance · cosine / rays
    float cosine; ///< of incidence
    uint blade;   ///< index in the field, or lidarGround
};
SHARED_LAYOUT(LidarEnd, 16)
SHARED_TABLE(LidarEndTable, LidarEnd)

SHARED_CONST float lidarMissed = -1.0f;    ///< the ray meets nothing
SHARED_CONST float lidarUncounted = -2.0f; ///< it meets what is too near or too far

SHARED_FN LidarEnd lidarMiss()
{
    LidarEnd end;
    end.range = lidarMissed;
    end.power = 0.0f;
    end.cosine = 0.0f;
    end.blade = 0u;
    return end;
}

/// The end of a ray that meets a surface at `distance` [m].
SHARED_FN LidarEnd lidarEndAt(LidarSensor sensor, float distance, float cosine, uint blade,
                              float reflectance)
{
    LidarEnd end;
    const bool counts = distance >= sensor.nearest && distance <= sensor.farthest;
    end.range = counts ? distance : lidarUncounted;
    end.cosine = clamp(cosine, 0.0f, 1.0f);
    end.power = reflectance * end.cosine / float(sensor.rays);
    end.blade = blade;
    return end;
}

/// A return of a beam.
struct LidarEcho {
    float range;     ///< [m] mean of its rays, by their power
    float intensity; ///< sum of their powers
    float cosine;    ///< of incidence, where its nearest ray meets `blade`
    uint blade;      ///< what most of its rays meet, the nearest of equals
};
SHARED_LAYOUT(LidarEcho, 16)

/// Range behind which a beam's first return lies.
SHARED_CONST float lidarBegin = -0.5f;
/// Range of what is not there.
SHARED_CONST float lidarNowhere = 3.0e38f;

/// The nearest end behind `behind` [m] of a beam whose ends begin at `first`; lidarNowhere if there
/// is none.
SHARED_FN float nextRange(LidarSensor sensor, LidarEndTable ends, uint first, float behind)
{
    float nearest = lidarNowhere;
    for (uint i = 0u; i < sensor.rays; ++i) {
        const float range = ends.at[first + i].range;
        if (range > behind && range < nearest)
            nearest = range;
    }
    return nearest;
}

/// The number of returns of a beam.
SHARED_FN uint countReturns(LidarSensor sensor, LidarEndTable ends, uint first)
{
    uint count = 0u;
    float nearest = nextRange(sensor, ends, first, lidarBegin);
    while (nearest < lidarNowhere && count < sensor.maxReturns) {
        ++count;
        nearest = nextRange(sensor, ends, first, nearest + sensor.resolution);
    }
    return count;
}

/// The return whose nearest ray ends at `nearest` [m].
SHARED_FN LidarEcho echoAt(LidarSensor sensor, LidarEndTable ends, uint first, float nearest)
{
    const float last = nearest + sensor.resolution;
    float weights = 0.0f;
    float beyond = 0.0f;
    uint best = 0u;
    LidarEcho echo;
    echo.intensity = 0.0f;
    echo.blade = lidarGround;
    echo.cosine = 0.0f;
    float bestRange = lidarNowhere;
    for (uint i = 0u; i < sensor.rays; ++i) {
        const LidarEnd end = ends.at[first + i];
        if (!(end.range >= nearest && end.range <= last))
            continue;
        // Rays without power count as little as can be, so that a range is always defined.
        const float weight = max(end.power, 1e-12f);
        weights += weight;
        beyond += weight * (end.range - nearest);
        echo.intensity += end.power;
        uint same = 0u;
        for (uint k = 0u; k < sensor.rays; ++k) {
            const LidarEnd other = ends.at[first + k];
            same +=
                other.blade == end.blade && other.range >= nearest && other.range <= last ? 1u : 0u;
        }
        if (same > best || (same == best && end.range < bestRange)) {
            best = same;
            bestRange = end.range;
            echo.blade = end.blade;
            echo.cosine = end.cosine;
        }
    }
    echo.range = nearest + beyond / weights;
    return echo;
}

SHARED_END
#endif
