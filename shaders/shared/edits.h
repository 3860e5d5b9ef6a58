// Edits of a field in device memory: blades and patches that replace others take over their states.
#ifndef SWARD_SHARED_EDITS_H
#define SWARD_SHARED_EDITS_H

#include "shaders/shared/frame.h"
#include "shaders/shared/types.h"

SHARED_BEGIN

/// A new blade, and the one of the same key before the edit.
struct BladeSource {
    uint place;
    uint from;         ///< place before; noSource: the blade is new
    uint fromPatch;    ///< the patch that contained it before …
    uint indexInPatch; ///< … and its index there
};
SHARED_LAYOUT(BladeSource, 16)

SHARED_CONST uint noSource = 0xffffffffu;

/// A patch that is new or has another place.
struct PatchSource {
    uint patchIndex;
    uint from;       ///< the patch whose time it takes over; noPatch: it is settled
    uint keepsCount; ///< countsAll, countsSame or countsNone
};
SHARED_LAYOUT(PatchSource, 12)

// Blades of a patch that have been moved.
SHARED_CONST uint countsAll = 0u;  ///< every blade has a state, or is unsettled
SHARED_CONST uint countsSame = 1u; ///< it is the same patch
SHARED_CONST uint countsNone = 2u; ///< none has a state

SHARED_BUFFER(BladeSourceArray, BladeSource, readonly)
SHARED_BUFFER(PatchSourceArray, PatchSource, readonly)

/// Threads of a work-group, a blade or a patch each.
SHARED_CONST uint editThreads = 64u;

struct EditPush {
    UintArray states;      ///< Frame::states
    FloatArray etas;       ///< Frame::etas, or address 0
    UintArray patchTimes;  ///< Frame::patchTimes
    UintArray patchCounts; ///< Frame::patchCounts
    BladeSourceArray blades;
    PatchSourceArray patches;
    UintArray times;  ///< of each of `patches`, between both dispatches …
    UintArray counts; ///< … and its count
    uint bladeCount;
    uint patchCount;
    uint settledAt; ///< tick of the last update of a new patch, which counts as settled in its wind
    uint isSecond;  ///< 0: moves states of blades, reads times of patches; 1: writes these
};
SHARED_LAYOUT(EditPush, 80)

SHARED_END
#endif
