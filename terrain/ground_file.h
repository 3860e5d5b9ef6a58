#pragma once

#include "terrain/ground_mesh.h"
#include "terrain/record_file.h"

namespace sward::terrain {

/// Appends a ground to a record, everything of it.
void write(RecordWriter& writer, const GroundMesh& ground);

/// Reads it back and checks it as an importer would; `place` names it in messages. A ground without
/// triangles is allowed. Throws Error{input}.
GroundMesh readGround(RecordReader& reader, const std::string& place);

} // namespace sward::terrain
