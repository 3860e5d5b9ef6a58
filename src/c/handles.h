#pragma once

#include "c/field_handle.h"
#include "c/sward.h"
#include "gpu/device/features.h"
#include "render/grass.h"

#include <memory>

struct sward_features {
    sward::gpu::FeatureChain chain;
    sward::gpu::OptionalFeatures optional;
};

struct sward_context {
    sward::gpu::DeviceContext context;
};

struct sward_resident {
    std::shared_ptr<sward::render::ResidentField> field;
};

struct sward_settings {
    sward::render::FrameSettings settings;
};

struct sward_target {
    sward::render::BladeTarget target;
};

struct sward_grass {
    sward::render::Grass grass;
};
