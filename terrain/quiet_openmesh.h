#pragma once

#include <OpenMesh/Core/System/omstream.hh>

namespace sward::terrain {

/// OpenMesh reports on stderr what it refuses; while one of these lives it keeps silent, and the
/// caller says in its own words what failed.
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
