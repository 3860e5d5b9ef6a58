#include "apps/common/program.h"

#include "apps/common/interrupt.h"
#include "core/error.h"
#include "core/log.h"
#include "core/system/standard_streams.h"

#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>

namespace sward::apps {
namespace {

constexpr int runtimeCode = static_cast<int>(ErrorKind::runtime);

// Reports the exception being handled.
int reportException(std::string_view name)
{
    try {
        throw;
    } catch (const Error& error) {
        log::error("{}", error.what());
        return error.exitCode();
    } catch (const std::filesystem::filesystem_error& error) {
        log::error("{}: {}", error.path1().string(), error.code().message());
        return static_cast<int>(ErrorKind::io);
    } catch (const std::bad_alloc&) {
        // Formatting would allocate memory.
        std::fputs("error: not enough memory\n", stderr);
        return runtimeCode;
    } catch (const std::exception& error) {
        log::error("{} failed: {}", name, error.what());
        return runtimeCode;
    } catch (...) {
        std::fputs("error: unknown failure\n", stderr);
        return runtimeCode;
    }
}

} // namespace

int runProgram(std::string_view name, const std::function<int()>& body) noexcept
{
    prepareStandardStreams();
    const InterruptFlag flag;
    try {
        try {
            return body();
        } catch (...) {
            return reportException(name);
        }
    } catch (...) {
        // Writing the message failed; return the error code.
        return runtimeCode;
    }
}

} // namespace sward::apps
