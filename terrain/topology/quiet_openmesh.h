#pragma once

#include <OpenMesh/Core/System/omstream.hh>

namespace sward::terrain {

/// Silences OpenMesh's messages on stderr during its lifetime; the caller reports failures itself.
class QuietOpenMesh {
public:
    QuietOpenMesh()
        : errors_(omerr().is_enabled())
        , log_(omlog().is_enabled())
    {
        omerr().disable();
        omlog().disable();
    }
    QuietOpenMesh(const QuietOpenMesh&) = delete;
    QuietOpenMesh& operator=(const QuietOpenMesh&) = delete;
    ~QuietOpenMesh()
    {
        if (errors_)
            omerr().enable();
        if (log_)
            omlog().enable();
    }

private:
    bool errors_;
    bool log_;
};

} // namespace sward::terrain
