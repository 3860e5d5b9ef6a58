// Quads that are large on the screen, for raster_quads.comp: five vec4 each, and blocks of eight rows of them.
#ifndef SWARD_WEB_WEBGPU_LISTED_QUADS_GLSL
#define SWARD_WEB_WEBGPU_LISTED_QUADS_GLSL

const uint quadBits = 18u;
const uint maxQuads = 1u << quadBits;
const uint maxRowBlocks = 1u << 20u;
const uint noRowBlock = 0xffffffffu;
const uint rowsOfBlock = 8u;
const uint rowBlocksOfGroup = 8u;

layout(binding = 17) buffer Quads { vec4 quads[]; };
layout(binding = 18) buffer RowBlocks { uint rowBlocks[]; }; // 0–17 the quad, 18–31 number of the block

#endif
