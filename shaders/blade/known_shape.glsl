// The shape of a field's blades, if it is known at pipeline creation.
#ifndef SWARD_BLADE_KNOWN_SHAPE_GLSL
#define SWARD_BLADE_KNOWN_SHAPE_GLSL

#include "shaders/shared/constants.h"
#include "shaders/shared/shape.h"

/// The shape of all blades, or shapeCount if shapes differ. Known at pipeline creation.
layout(constant_id = idOnlyShape) const uint onlyShape = shapeCount;

/// The shape of a species' blades.
uint knownShape(uint shape)
{
    return onlyShape < shapeCount ? onlyShape : shape;
}

#endif
