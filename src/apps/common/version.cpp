#include "apps/common/version.h"

namespace sward::apps {

std::string versionText(const std::string& program)
{
    return program + " " SWARD_VERSION;
}

} // namespace sward::apps
