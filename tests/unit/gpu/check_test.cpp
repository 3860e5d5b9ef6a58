#include "core/error.h"
#include "gpu/context/check.h"

#include <gtest/gtest.h>

namespace sward::gpu {
namespace {

Error errorOf(VkResult result)
{
    try {
        check(result, "vkDoIt");
    } catch (const Error& error) {
        return error;
    }
    return {ErrorKind::usage, "no error"};
}

TEST(Check, NamesTheCallAndTheResult)
{
    const Error missing = errorOf(VK_ERROR_FEATURE_NOT_PRESENT);
    EXPECT_EQ(missing.kind(), ErrorKind::unsupported);
    EXPECT_TRUE(std::string_view(missing.what())
                    .starts_with("vkDoIt failed: VK_ERROR_FEATURE_NOT_PRESENT (check_test.cpp:"))
        << missing.what();
    const Error closed = errorOf(VK_ERROR_SURFACE_LOST_KHR);
    EXPECT_EQ(closed.kind(), ErrorKind::runtime);
    EXPECT_TRUE(
        std::string_view(closed.what()).starts_with("vkDoIt failed: VK_ERROR_SURFACE_LOST_KHR"))
        << closed.what();
}

TEST(Check, GivesTheNumberOfAResultWithoutAName)
{
    const Error unnamed = errorOf(static_cast<VkResult>(-1000174001));
    EXPECT_EQ(unnamed.kind(), ErrorKind::runtime);
    EXPECT_TRUE(std::string_view(unnamed.what()).starts_with("vkDoIt failed: VkResult -1000174001"))
        << unnamed.what();
}

TEST(Check, LetsSuccessPass)
{
    EXPECT_NO_THROW(check(VK_SUCCESS, "vkDoIt"));
}

} // namespace
} // namespace sward::gpu
