// Moves the blades of the visible patches: a point each, at the blade's place in the texture of states.
#include "web/shaders/blades.glsl"
#include "shaders/shared/physics.h"
#include "shaders/shared/visibility.h"

uniform float elapsed;     // [s] since the frame before
uniform float stateRows;   // of the texture

flat out uint outTurn;

void main()
{
    outTurn = 0u;
    gl_PointSize = 1.0;
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    if (uint(gl_VertexID) >= group.z)
        return;
    const Patch cell = fetchPatchArray(group.x);
    const uint index = cell.firstBlade + group.y + uint(gl_VertexID);
    const Blade blade = unpackBlade(fetchBladeArray(index), cell);
    const uint before = fetchUintArray(index);
    const bool isNew = before == unsettledTurn;
    const BladeState state = BladeState(isNew ? 0u : before, 0.0);
    ColliderMask none;
    outTurn = before;
    const float since = isNew ? settlingTime : elapsed;
    if (since > 0.0)
        outTurn = advanceBlade(blade, FRAME.environment, none, state, 0.0, since).turn;
    const ivec2 place = placeInTable(index);
    gl_Position = vec4((vec2(place) + 0.5) / vec2(float(tableWidth), stateRows) * 2.0 - 1.0, 0.0, 1.0);
}
