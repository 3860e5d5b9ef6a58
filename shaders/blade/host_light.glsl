// The light of a host's own scene on a point of a blade: see shared/host_light.h. Part of blade_light.glsl. HOST_LIGHT
// is the number of the set of the shadow map, which any image stands in for where there is none.
#ifndef SWARD_BLADE_HOST_LIGHT_GLSL
#define SWARD_BLADE_HOST_LIGHT_GLSL

/// Whether there is light of a host's; known at pipeline creation.
layout(constant_id = idHasHostLight) const bool hasHostLight = false;

/// A layer for each cascade.
layout(set = HOST_LIGHT, binding = 0) uniform sampler2DArray hostShadow;

#define HOST FRAME.hostLight.at[0]

/// Share of the sun at a place of a cascade. The mean of nine comparisons, a texel apart and each interpolated between
/// four texels: the edge of a shadow is three texels wide. `at`: in texels, from the centre of the first.
float shareInCascade(uint cascade, vec2 at, vec2 size, float depth)
{
    const vec2 first = floor(at);
    const vec2 f = at - first;
    float share = 0.0;
    // Sixteen texels, four at a time around the corner between them.
    SHARED_UNROLL for (uint i = 0u; i < 4u; ++i) {
        const vec2 corner = first + 2.0 * vec2(i & 1u, i >> 1u);
        const vec4 depths = textureGather(hostShadow, vec3(corner / size, cascade));
        const vec4 seen = vec4(greaterThanEqual((depths - depth) * HOST.nearer, vec4(0.0)));
        const vec2 across = (i & 1u) == 0u ? vec2(1.0 - f.x, 1.0) : vec2(1.0, f.x);
        const vec2 down = (i >> 1u) == 0u ? vec2(1.0 - f.y, 1.0) : vec2(1.0, f.y);
        // A gather begins at the lower left and goes on to the lower right.
        share += down.y * dot(across, seen.xy) + down.x * dot(across, seen.wz);
    }
    return share / 9.0;
}

/// Share of the sun that the host's scene lets through: by the first cascade that contains the place and all texels that
/// are compared; 1 outside of all.
float sunShare(vec3 position, vec3 up)
{
    const vec2 size = vec2(textureSize(hostShadow, 0).xy);
    for (uint i = 0u; i < HOST.cascadeCount; ++i) {
        const float texel = HOST.cascades[i].width / min(size.x, size.y);
        const vec4 place = vec4(position + up * (HOST.lift * texel), 1.0);
        const vec2 at = vec2(dot(HOST.cascades[i].across, place), dot(HOST.cascades[i].down, place)) * size - 0.5;
        const float depth = dot(HOST.cascades[i].depth, place);
        if (all(greaterThanEqual(at, vec2(1.0))) && all(lessThan(at, size - 2.0)) && depth >= 0.0 && depth <= 1.0)
            return shareInCascade(i, at, size, depth);
    }
    return 1.0;
}

vec3 ambientTowards(vec3 n)
{
    return vec3(ambientLight(HOST.ambient[0], n), ambientLight(HOST.ambient[1], n), ambientLight(HOST.ambient[2], n));
}

/// The same among leaves that leave `open.x` of the light from above, and `open.y` of that from below.
vec3 ambientAmong(vec3 n, vec2 open)
{
    return open.x * ambientTowards(n) +
           (open.y - open.x) * (0.5 - 0.5 * dot(n, FRAME.skyUp)) * ambientTowards(-FRAME.skyUp);
}

Incoming incomingAt(vec3 position, vec3 up, vec3 n, vec2 open)
{
    if (!hasHostLight)
        return incomingFromSky(n, open);
    const vec3 sun = FRAME.sunColor * sunShare(position, up);
    if (HOST.hasAmbient == 0u) {
        Incoming incoming = incomingFromSky(n, open);
        incoming.sun = sun;
        return incoming;
    }
    // The zenith is darker than the mean sky: see hemisphere().
    return Incoming(ambientAmong(n, open), ambientAmong(-n, open), HOST.above, HOST.above / 1.25, sun);
}

/// Light of all lamps on a point, scattered as the sun's is. Nothing but leaves around the blade is in its way.
vec3 lampLight(BladePoint point, vec3 n, vec3 toEye, vec3 albedo, float leafArea)
{
    const float openSky = point.look.x;
    const vec3 through = throughBlade(point.look.y);
    const float leavesBelow = 1.0 - skyBelow(point.leafBelow);
    vec3 sum = vec3(0.0);
    for (uint i = 0u; i < HOST.lampCount; ++i) {
        const Lamp lamp = HOST.lamps[i];
        const vec3 toLamp = lamp.position - point.position;
        const vec3 color = lamp.color * lampShare(lamp, toLamp);
        if (color == vec3(0.0))
            continue;
        const vec3 source = toLamp * inversesqrt(max(dot(toLamp, toLamp), 1e-12));
        const float upright = dot(point.up, source);
        const float seen = openSky * sunBelow(leafProjectionOf(FRAME.cover), leafArea, upright);
        const Scattering scattering = scatteringOf(source, n);
        sum += albedo * color * (seen * (scattering.diffuse + through * scattering.through));
        sum += albedo * (openSky * (1.0 + through)) *
               lightAmongLeaves(leafArea, leavesBelow, upright, color, vec3(0.0), albedo * (1.0 + through));
        if (point.look.z > 0.0)
            sum += (point.look.z * point.place.y * seen * coatShine(n, point.tangent, source, toEye)) * color;
    }
    return sum;
}

#endif
