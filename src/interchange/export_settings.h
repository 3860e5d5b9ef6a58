#pragma once

#include <string>

namespace sward::interchange {

/// What every export is told beside the field and the file's name.
struct ExportSettings {
    std::string source = "field";    ///< what the field is called in messages
    bool overwrite = false;          ///< replace an existing file
    bool withGround = false;         ///< .glb only: the drawn ground beneath the blades
    std::string generator = "Sward"; ///< the program's name and version, for the file's own notes
};

} // namespace sward::interchange
