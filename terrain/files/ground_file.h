#pragma once

#include "terrain/files/record_file.h"
#include "terrain/ground_mesh.h"

namespace sward::terrain {

/// Appends a ground to a record, without the pixels of its images.
void write(RecordWriter& writer, const GroundMesh& ground);

/// Reads a ground and validates it as an importer does; messages name `place`. Allows a ground
/// without triangles. Its images have a size and no pixels. Throws Error{input}.
GroundMesh readGround(RecordReader& reader, const std::string& place);

/// Appends the pixels of an image.
void writePixels(RecordWriter& writer, const GroundImage& image);

/// Reads the pixels of an image. Throws Error{input} if their size differs.
void readPixels(RecordReader& reader, GroundImage& image, const std::string& place);

} // namespace sward::terrain
