// Reads a visibility: see put_sample.glsl.
layout(binding = 9) buffer Seen { uvec2 seenSamples[]; };
