// What the passes of a range sensor know.
#ifndef SWARD_SHARED_LIDAR_CASTING_H
#define SWARD_SHARED_LIDAR_CASTING_H

#include "shaders/shared/lidar/ray_tree.h"
#include "shaders/shared/lidar/returns.h"
#include "shaders/shared/types.h"

SHARED_BEGIN

SHARED_CONST uint lidarThreads = 64u; ///< of a work-group

/// Sums over the beams of a batch.
struct LidarTotals {
    uint returns;
    uint groundRays; ///< that met the ground
    uint freeRays;   ///< that met nothing
    uint reserved;
};
SHARED_LAYOUT(LidarTotals, 16)

SHARED_BUFFER(LidarBeamArray, LidarBeam, readonly)
SHARED_BUFFER(LidarPlaceArray, vec2, readonly)
SHARED_BUFFER(LidarReflectanceArray, float, readonly)
SHARED_BUFFER(LidarEchoArray, LidarEcho, writeonly)
SHARED_BUFFER(LidarRunArray, uint, writeonly)
SHARED_BUFFER(LidarTotalsArray, LidarTotals, )

/// The returns of a beam: this number of them, and the place of the first.
SHARED_CONST uint lidarRunShift = 28u;
SHARED_CONST uint lidarRunFirst = 0x0fffffffu;

/// A batch of beams.
struct LidarPush {
    RayTree tree;
    LidarBeamArray beams;
    LidarPlaceArray places;             ///< of a beam's rays, see rayOfBeam()
    LidarReflectanceArray reflectances; ///< raySurfaces
    LidarEndTable ends;                 ///< of all rays, beam by beam
    LidarEchoArray echoes;
    LidarRunArray runs; ///< of each beam
    LidarTotalsArray totals;
    LidarSensor sensor;
    uint beamCount;
};
SHARED_LAYOUT(LidarPush, 104)

SHARED_END
#endif
