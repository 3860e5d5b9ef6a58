#pragma once

#include "gpu/context/context.h"
#include "gpu/context/handle.h"
#include "gpu/pipeline/pipeline_layout.h"

#include <vulkan/vulkan.h>

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace sward::gpu {

using SetLayout = Owned<VkDescriptorSetLayout, &DeviceFunctions::DestroyDescriptorSetLayout>;

/// Everything that an object is made of, as bytes.
class ObjectKey {
public:
    template <typename T>
    ObjectKey& add(const T& value)
    {
        return add(std::span<const T>(&value, 1));
    }

    /// Also adds their number.
    template <typename T>
    ObjectKey& add(std::span<const T> values)
    {
        static_assert(std::has_unique_object_representations_v<T>, "there are no other bytes");
        const std::size_t count = values.size();
        bytes_.append(reinterpret_cast<const char*>(&count), sizeof count);
        bytes_.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
        return *this;
    }

    const std::string& bytes() const { return bytes_; }

private:
    std::string bytes_;
};

/// Set layouts and pipelines of a Device by their keys. They live as long as the device. May be
/// used by several threads.
class SharedObjects {
public:
    template <typename Object>
    using Make = std::function<Object(const DeviceContext& context)>;

    explicit SharedObjects(const DeviceContext& context) ///< must outlive it
        : context_(context)
    {
    }

    std::shared_ptr<const SetLayout> get(const ObjectKey& key, const Make<SetLayout>& make)
    {
        return find(setLayouts_, key, make);
    }
    std::shared_ptr<const Pipeline> get(const ObjectKey& key, const Make<Pipeline>& make)
    {
        return find(pipelines_, key, make);
    }

private:
    template <typename Object>
    using Objects = std::map<std::string, std::shared_ptr<const Object>>;

    template <typename Object>
    std::shared_ptr<const Object> find(Objects<Object>& objects, const ObjectKey& key,
                                       const Make<Object>& make)
    {
        {
            const std::lock_guard lock(mutex_);
            if (const auto found = objects.find(key.bytes()); found != objects.end())
                return found->second;
        }
        // Others need not wait; of two that are made at the same time the first stays.
        auto made = std::make_shared<const Object>(make(context_));
        const std::lock_guard lock(mutex_);
        return objects.try_emplace(key.bytes(), std::move(made)).first->second;
    }

    const DeviceContext& context_;
    std::mutex mutex_;
    Objects<SetLayout> setLayouts_;
    Objects<Pipeline> pipelines_;
};

/// A set layout with these bindings, without immutable samplers: the device's, if it shares
/// objects.
std::shared_ptr<const SetLayout>
sharedSetLayout(const DeviceContext& context, const std::string& name,
                const std::vector<VkDescriptorSetLayoutBinding>& bindings);

/// The object with this key: the device's, if it shares objects, else a new one.
template <typename Object>
std::shared_ptr<const Object> madeOnce(const DeviceContext& context, const ObjectKey& key,
                                       const SharedObjects::Make<Object>& make)
{
    return context.shared != nullptr ? context.shared->get(key, make)
                                     : std::make_shared<const Object>(make(context));
}

} // namespace sward::gpu
