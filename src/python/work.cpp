#include "python/work.h"

#include <chrono>
#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>

namespace sward::python {
namespace {

namespace py = pybind11;

// Time between two looks for signals.
constexpr std::chrono::milliseconds signalPause{50};

/// What the thread of the task tells the calling one.
struct Told {
    std::mutex mutex;
    std::condition_variable changed;
    std::deque<std::pair<double, std::string>> steps;
    bool hasEnded = false;
    std::exception_ptr fault;
};

// Waits for news, without the interpreter's lock. Returns the steps; whether the task has ended.
std::pair<std::deque<std::pair<double, std::string>>, bool> wait(Told& told)
{
    const py::gil_scoped_release released;
    std::unique_lock lock(told.mutex);
    told.changed.wait_for(lock, signalPause, [&] { return told.hasEnded || !told.steps.empty(); });
    return {std::exchange(told.steps, {}), told.hasEnded};
}

} // namespace

py::object textOf(const std::string& text)
{
    PyObject* const decoded =
        PyUnicode_DecodeUTF8(text.data(), static_cast<Py_ssize_t>(text.size()), "surrogateescape");
    if (decoded == nullptr)
        throw py::error_already_set();
    return py::reinterpret_steal<py::object>(decoded);
}

void work(const py::object& callback, const std::function<void(Progress&)>& task)
{
    Told told;
    Progress::Callback tell;
    if (!callback.is_none())
        tell = [&told](const std::string& stage, double share) {
            const std::lock_guard lock(told.mutex);
            told.steps.emplace_back(share, stage);
            told.changed.notify_one();
        };
    Progress progress(std::move(tell));
    std::jthread thread([&] {
        try {
            task(progress);
        } catch (...) {
            told.fault = std::current_exception();
        }
        const std::lock_guard lock(told.mutex);
        told.hasEnded = true;
        told.changed.notify_one();
    });

    // The first exception of Python cancels the task, which ends by itself.
    std::optional<py::error_already_set> raised;
    for (bool hasEnded = false; !hasEnded;) {
        auto [steps, isOver] = wait(told);
        hasEnded = isOver;
        if (raised)
            continue;
        try {
            if (PyErr_CheckSignals() != 0)
                throw py::error_already_set();
            for (const auto& [share, stage] : steps)
                callback(share, stage);
        } catch (py::error_already_set& error) {
            raised.emplace(std::move(error));
            progress.cancel();
        }
    }
    {
        const py::gil_scoped_release released;
        thread.join();
    }
    if (raised)
        throw std::move(*raised);
    if (told.fault)
        std::rethrow_exception(told.fault);
}

void issueWarnings(const Diagnostics& diagnostics)
{
    if (diagnostics.warnings().empty())
        return;
    constexpr int ofCaller = 2; // the line that calls the module
    const py::object category = py::module_::import("sward._errors").attr("Warning");
    const py::object warn = py::module_::import("warnings").attr("warn");
    for (const std::string& text : diagnostics.warnings())
        warn(textOf(text), category, ofCaller);
}

} // namespace sward::python
