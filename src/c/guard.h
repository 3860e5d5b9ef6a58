#pragma once

#include "c/field.h"
#include "core/error.h"

#include <exception>
#include <new>

namespace sward::c {

/// Keeps the message for sward_last_error().
sward_status failed(sward_status status, const char* message) noexcept;

/// The same for an Error, in the words of the C interface.
sward_status failed(const Error& error) noexcept;

/// Clears what sward_last_error() returns.
sward_status succeeded() noexcept;

/// Runs `work`; turns what it throws into a status.
template <class Work>
sward_status guarded(const Work& work) noexcept
{
    try {
        work();
        return succeeded();
    } catch (const Error& error) {
        return failed(error);
    } catch (const std::bad_alloc&) {
        return failed(SWARD_ERROR_RUNTIME, "memory does not suffice");
    } catch (const std::exception& error) {
        return failed(SWARD_ERROR_INTERNAL, error.what());
    } catch (...) {
        return failed(SWARD_ERROR_INTERNAL, "an unknown exception");
    }
}

template <class Handle>
Handle* checked(Handle* handle, const char* name)
{
    if (handle == nullptr)
        fail(ErrorKind::usage, "{} is null", name);
    return handle;
}

} // namespace sward::c
