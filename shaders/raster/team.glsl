// Large blades are drawn by teams of threads.
#ifndef SWARD_RASTER_TEAM_GLSL
#define SWARD_RASTER_TEAM_GLSL

/// Threads of a team, and teams of a work-group.
const uint teamThreads = 16u;
const uint teamsOfGroup = largeThreads / teamThreads;

#endif
