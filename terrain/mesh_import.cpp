#include "terrain/mesh_import.h"

#include "core/error.h"
#include "terrain/openmesh_soup.h"

#include <OpenMesh/Core/IO/Options.hh>
#include <OpenMesh/Core/IO/reader/OBJReader.hh>
#include <OpenMesh/Core/IO/reader/OFFReader.hh>
#include <OpenMesh/Core/IO/reader/PLYReader.hh>
#include <OpenMesh/Core/IO/reader/STLReader.hh>
#include <OpenMesh/Core/System/omstream.hh>

namespace sward::terrain {

Soup importMesh(const std::filesystem::path& path, Diagnostics&)
{
    using OpenMesh::IO::Options;
    Options options(Options::VertexNormal | Options::VertexColor | Options::VertexTexCoord |
                    Options::FaceTexCoord);
    OpenMeshSoup soup(path.string());
    if (!OpenMesh::IO::OBJReader().read(path.string(), soup, options))
        fail(ErrorKind::input, "{}: cannot be read", path.string());
    return soup.take();
}

} // namespace sward::terrain
