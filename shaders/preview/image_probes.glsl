// Probe places of an image for a pixel that sees it at a slant: a few in a row, as in
// GL_EXT_texture_filter_anisotropic. Does not use a sampler's anisotropy: a driver may take its gradients from
// neighbouring threads, which in a compute shader are not neighbours in the picture.
#ifndef SWARD_PREVIEW_IMAGE_PROBES_GLSL
#define SWARD_PREVIEW_IMAGE_PROBES_GLSL

const float maxProbes = 8.0;

struct ImageProbes {
    vec2 first;
    vec2 step; ///< to the next
    uint count;
    float lod; ///< of each probe
};

/// `right`, `down`: change of the place `uv` per pixel, in an image of `size` texels.
ImageProbes imageProbes(vec2 uv, vec2 right, vec2 down, vec2 size)
{
    const float across = length(right * size);
    const float along = length(down * size);
    const float longest = max(across, along);
    const float ratio = longest > 1.0 ? longest / max(min(across, along), 1e-6) : 1.0;
    const float count = clamp(ceil(ratio), 1.0, maxProbes);
    ImageProbes probes;
    probes.step = (across > along ? right : down) / (count + 1.0);
    probes.first = uv - 0.5 * (count - 1.0) * probes.step;
    probes.count = uint(count);
    probes.lod = log2(max(longest / count, 1e-6));
    return probes;
}

#endif
