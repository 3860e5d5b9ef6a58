#pragma once

#include "gpu/device/device.h"
#include "gpu/device/instance.h"

#include <gtest/gtest.h>

namespace sward::test {

/// A test on a headless device, made once per program, with validation and synchronisation
/// validation. Any validation message fails the test. SWARD_GPU_ENVIRONMENT (tests/CMakeLists.txt)
/// selects lavapipe.
class GpuTest : public testing::Test {
protected:
    void SetUp() override;
    void TearDown() override;

    static const gpu::Instance& instance();
    static const gpu::Device& device();
    static const gpu::DeviceContext& context() { return device().context(); }
    static gpu::ValidationLog& validationLog() { return instance().validationLog(); }
};

} // namespace sward::test
