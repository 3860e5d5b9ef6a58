// Quadrilaterals under a binary tree of boxes, for rays.
#ifndef SWARD_SHARED_LIDAR_RAY_TREE_H
#define SWARD_SHARED_LIDAR_RAY_TREE_H

#include "shaders/shared/types.h"

SHARED_BEGIN

/// An inner node: the boxes of both children. A child is the index of an inner node, or a leaf.
struct RayNode {
    vec3 low0; ///< [m] relative to the field's origin
    vec3 high0;
    vec3 low1;
    vec3 high1;
    uint child0;
    uint child1;
    uint reserved0;
    uint reserved1;
};
SHARED_LAYOUT(RayNode, 64)

/// A quadrilateral of a blade: left, right, right and left one row on, as two triangles a b d and c
/// d b; or a triangle of the ground, a b d with c equal to b.
struct RayQuad {
    vec3 a;     ///< [m]
    uint blade; ///< index in the field, or lidarGround
    vec3 b;
    uint surface; ///< slot of the species, or groundSurface
    vec3 c;
    uint reserved0;
    vec3 d;
    uint reserved1;
};
SHARED_LAYOUT(RayQuad, 64)

SHARED_TABLE(RayNodeTable, RayNode)
SHARED_TABLE(RayQuadTable, RayQuad)

/// Node 0 is the root.
struct RayTree {
    RayNodeTable nodes;
    RayQuadTable quads;
};
SHARED_LAYOUT(RayTree, 16)

/// Number of surfaces with a reflectance of their own: eight species and the ground.
SHARED_CONST uint raySurfaces = 9u;
SHARED_CONST uint rayGroundSurface = 8u;

// A leaf: this bit, its number of quads less one, and the first of them.
SHARED_CONST uint rayLeafBit = 0x80000000u;
SHARED_CONST uint rayLeafShift = 28u;
SHARED_CONST uint rayLeafFirst = 0x0fffffffu;
SHARED_CONST uint maxLeafQuads = 8u;
/// Inner nodes on a path from the root.
SHARED_CONST uint maxRayDepth = 62u;

SHARED_END
#endif
