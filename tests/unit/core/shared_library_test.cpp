#include "core/system/shared_library.h"

#include <gtest/gtest.h>

namespace sward {
namespace {

TEST(SharedLibrary, GivesAFunctionOrNull)
{
    using Cosine = double (*)(double);
    const auto cosine = reinterpret_cast<Cosine>(functionOf("libm.so.6", "cos"));
    ASSERT_NE(cosine, nullptr);
    EXPECT_EQ(cosine(0.0), 1.0);
    EXPECT_EQ(functionOf("libm.so.6", "no_such_function"), nullptr);
    EXPECT_EQ(functionOf("libno-such-library.so.9", "cos"), nullptr);
}

TEST(SharedLibrary, HasTheFileNameOfItsVersion)
{
    EXPECT_EQ(libraryFile("m", 6), "libm.so.6");
}

} // namespace
} // namespace sward
