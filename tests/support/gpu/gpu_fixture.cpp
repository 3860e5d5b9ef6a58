#include "support/gpu/gpu_fixture.h"

#include <optional>

namespace sward::test {
namespace {

// Keeps the device from its first use to the end of the tests, not longer: at exit the driver may
// be unloaded.
class HeadlessEnvironment : public testing::Environment {
public:
    void TearDown() override
    {
        if (!instance_)
            return;
        // The destructor of the device reports leaks.
        device_.reset();
        const gpu::ValidationLog& log = instance_->validationLog();
        EXPECT_EQ(log.count(), 0U) << log.text();
        instance_.reset();
    }

    const gpu::Instance& instance()
    {
        if (!instance_)
            instance_.emplace(
                gpu::InstanceSettings{.application = "sward tests", .validation = true});
        return *instance_;
    }

    const gpu::Device& device()
    {
        if (!device_)
            device_.emplace(instance());
        return *device_;
    }

private:
    std::optional<gpu::Instance> instance_;
    std::optional<gpu::Device> device_;
};

HeadlessEnvironment& environment()
{
    // GoogleTest owns the environment.
    static auto* const environment = new HeadlessEnvironment;
    static const testing::Environment* const added = testing::AddGlobalTestEnvironment(environment);
    static_cast<void>(added);
    return *environment;
}

// Register before main(): GoogleTest accepts no environments later.
[[maybe_unused]] const HeadlessEnvironment& registered = environment();

} // namespace

const gpu::Instance& GpuTest::instance()
{
    return environment().instance();
}

const gpu::Device& GpuTest::device()
{
    return environment().device();
}

void GpuTest::SetUp()
{
    ASSERT_TRUE(instance().isValidating()) << "the tests need Debian's vulkan-validationlayers";
    ASSERT_EQ(validationLog().count(), 0U) << validationLog().text();
}

void GpuTest::TearDown()
{
    device().waitIdle();
    EXPECT_EQ(validationLog().count(), 0U) << validationLog().text();
    validationLog().clear();
}

} // namespace sward::test
