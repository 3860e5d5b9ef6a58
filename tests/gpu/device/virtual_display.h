#pragma once

#include <sys/types.h>

#include <string>

namespace sward::test {

/// An X server without a screen; the destructor ends it.
class VirtualDisplay {
public:
    /// Throws std::runtime_error if Xvfb does not start.
    VirtualDisplay();
    VirtualDisplay(const VirtualDisplay&) = delete;
    VirtualDisplay& operator=(const VirtualDisplay&) = delete;
    ~VirtualDisplay();

    /// Value of DISPLAY for it.
    const std::string& name() const { return name_; }

private:
    pid_t server_ = -1;
    std::string name_;
};

} // namespace sward::test
