// Converts light to a picture.
#ifndef SWARD_SHARED_LOOK_FILM_CURVE_H
#define SWARD_SHARED_LOOK_FILM_CURVE_H

#include "shaders/shared/types.h"

SHARED_BEGIN

/// The filmic curve fitted to ACES by K. Narkowicz ("ACES Filmic Tone Mapping Curve", 2015),
/// slightly desaturated in bright areas. `exposed`: radiance times exposure.
SHARED_FN vec3 filmOf(vec3 exposed)
{
    const vec3 x = exposed * 0.80f;
    const vec3 film = (x * (2.51f * x + 0.03f)) / (x * (2.43f * x + 0.59f) + 0.14f);
    return clamp(film, 0.0f, 1.0f);
}

SHARED_END
#endif
