// One triangle over the whole picture, without a vertex buffer: three indices.
#ifndef SWARD_PREVIEW_WHOLE_PICTURE_GLSL
#define SWARD_PREVIEW_WHOLE_PICTURE_GLSL

/// The corner with an index, −1 … 3 to the right and downwards; the picture is −1 … 1.
vec2 cornerOfPicture(int index)
{
    return vec2((index & 1) * 4 - 1, (index & 2) * 2 - 1);
}

#endif
