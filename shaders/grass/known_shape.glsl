// What a pipeline knows of the outlines of a field's blades.
#ifndef SWARD_KNOWN_SHAPE_GLSL
#define SWARD_KNOWN_SHAPE_GLSL

#include "shaders/shared/shape.h"

/// That of all blades; shapeCount if they are not alike. Known when the pipeline is made.
layout(constant_id = 14) const uint onlyShape = shapeCount;

/// A species' own.
uint knownShape(uint shape)
{
    return onlyShape < shapeCount ? onlyShape : shape;
}

#endif
