#pragma once

#include "gpu/context/context.h"
#include "gpu/pipeline/shared_objects.h"

namespace sward::gpu {

/// A copy of a host's context that makes equal pipelines once, on any thread. What is made with it
/// must not outlive it.
struct SharingContext {
    explicit SharingContext(const DeviceContext& host)
        : context(host)
        , objects(context)
    {
        if (context.shared == nullptr)
            context.shared = &objects;
    }
    SharingContext(const SharingContext&) = delete;
    SharingContext& operator=(const SharingContext&) = delete;

    DeviceContext context;
    SharedObjects objects; ///< unused if the host's context shares objects already
};

} // namespace sward::gpu
