// Position and resolution of a view of blades.
#ifndef SWARD_SHARED_EYEPOINT_H
#define SWARD_SHARED_EYEPOINT_H

#include "shaders/shared/types.h"

SHARED_BEGIN

/// The part of a frame that decides which blades are visible, and how wide they are drawn.
struct Eyepoint {
    vec4 planes[6]; ///< left right bottom top near far; unit normals inward, offset
    vec3 eye;
    float drawDistance;   ///< [m]
    float pixelsPerUnit;  ///< pixels of something 1 m large at 1 m distance
    float lodThreshold;   ///< [pixels] width below which blades are left out; 0: none
    float lodWidth;       ///< [m] typical width of a blade
    float minWidth;       ///< [m at 1 m distance] see crossSectionAt(); 0: true width
    float maxLeafArea;    ///< see leafAreaShare(); 0: no limit
    float maxEdgeOn;      ///< cosine beyond which a blade is seen edge-on; 1: never
    uint samples;         ///< per pixel
    float buckets;        ///< of the stepwise thinning, see bucketsKeep(); 0: off
    float bucketDistance; ///< [m]
    uint cullMask;
    float
        areaFactor; ///< area of the field's blades relative to height times width of their patches
    float sparseFrom;  ///< [m] beyond this distance less is drawn, see sparseShare(); 0: off
    float sparseLeast; ///< the least share that sparseShare() leaves
};
SHARED_LAYOUT(Eyepoint, 164)

SHARED_END
#endif
