// For builds without the program that bakes.
#include "apps/sward_view/fields/baking.h"

namespace sward::view {

bool wantsBaking(const std::string&)
{
    return false;
}

Baking::Baking(std::vector<std::string>)
{
    fail(ErrorKind::unsupported,
         "this build bakes no fields; bake on Linux, or name the folder of baked fields");
}

Baking::~Baking() = default;

bool Baking::poll()
{
    return true;
}

void Baking::cancel() {}

bool Baking::succeeded() const
{
    return false;
}

int Baking::exitCode() const
{
    return static_cast<int>(errorKind());
}

ErrorKind Baking::errorKind() const
{
    return ErrorKind::unsupported;
}

std::string Baking::complaint() const
{
    return {};
}

} // namespace sward::view
