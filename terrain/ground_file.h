#pragma once

#include "terrain/ground_mesh.h"
#include "terrain/record_file.h"

namespace sward::terrain {

/// Appends a ground to a record, everything of it but the pixels of its images.
void write(RecordWriter& writer, const GroundMesh& ground);

/// Reads it back and checks it as an importer would; `place` names it in messages. A ground without
/// triangles is allowed. Its images have a size and no pixels. Throws Error{input}.
GroundMesh readGround(RecordReader& reader, const std::string& place);

/// Appends the pixels of an image.
void writePixels(RecordWriter& writer, const GroundImage& image);

/// Reads them back into the image. Throws Error{input} if they are of another size.
void readPixels(RecordReader& reader, GroundImage& image, const std::string& place);

} // namespace sward::terrain
