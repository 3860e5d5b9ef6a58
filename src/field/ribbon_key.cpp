#include "field/field.h"
#include "field/organs.h"

namespace sward::field {
namespace {

// Below the highest bit, which tells the sides of a triangle apart.
constexpr unsigned numberBit = 25;

} // namespace

BladeKey ribbonKey(BladeKey stalk, std::uint32_t number)
{
    return {stalk.triangle, stalk.candidate ^ (number << numberBit)};
}

} // namespace sward::field
