// Converts light to a picture.
#ifndef SWARD_COMMON_FILM_CURVE_GLSL
#define SWARD_COMMON_FILM_CURVE_GLSL

/// The filmic curve fitted to ACES by K. Narkowicz ("ACES Filmic Tone Mapping Curve", 2015), slightly desaturated in
/// bright areas. `exposed`: radiance times exposure.
vec3 filmOf(vec3 exposed)
{
    const vec3 x = exposed * 0.80;
    const vec3 film = (x * (2.51 * x + 0.03)) / (x * (2.43 * x + 0.59) + 0.14);
    return clamp(film, 0.0, 1.0);
}

#endif
