#include "bake/session/session.h"

#include "apps/sward/options/ground_input.h"
#include "bake/patches/cell_tree.h"
#include "bake/settings/stroke_file.h"
#include "core/error.h"
#include "core/files/mapped_file.h"
#include "python/field.h"
#include "python/inputs.h"
#include "python/option_table.h"
#include "python/python_module.h"
#include "python/work.h"

#include <CLI/CLI.hpp>
#include <pybind11/stl.h>

#include <algorithm>
#include <atomic>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace sward::python {
namespace {

namespace py = pybind11;

/// A bake that stays open; see bake::Session. One call at a time: another one, of a second thread
/// or of a progress callback, is an Error{usage}.
class Session {
public:
    /// One call.
    class Turn {
    public:
        explicit Turn(const Session& session)
            : isBusy_(session.isBusy_)
        {
            requireUsage(!isBusy_.exchange(true), "the session is busy with another call");
        }
        Turn(const Turn&) = delete;
        Turn& operator=(const Turn&) = delete;
        ~Turn() { isBusy_.store(false); }

    private:
        std::atomic<bool>& isBusy_;
    };

    Session(const std::vector<std::string>& arguments, const Inputs& inputs,
            const std::shared_ptr<Field>& baked, const py::object& callback)
    {
        CLI::App app;
        apps::BakeOptions options;
        options.add(app);
        options.needsOutput = false;
        options.given = inputs.given();
        parseOptions(app, arguments);
        forgetReadFiles();
        Diagnostics diagnostics;
        work(callback, [&](Progress& progress) {
            request_ = options.request();
            if (request_.settings.seeds == bake::SeedUse::automatic)
                request_.settings.seeds = bake::SeedUse::never;
            ground_ = std::make_unique<terrain::GroundMesh>(loadGround(request_, diagnostics));
            session_.emplace(*ground_, request_.settings, request_.threads, diagnostics, progress,
                             baked ? &baked->view() : nullptr);
        });
        request_.moveStrokes = 0.0; // those of the session are on the ground, and stay
        bladesBefore_ = session_->bladeCount();
        issueWarnings(diagnostics);
    }

    /// For a call that holds a Turn.
    const bake::Session& open() const { return *session_; }

    /// Replaces the strokes from number `keep` on by those of a stroke file's text.
    py::dict paint(const std::string& json, std::size_t keep, const py::object& callback)
    {
        const Turn turn(*this);
        bake::Strokes next = session_->strokes();
        requireUsage(keep <= next.list.size(), "keep is {}, and there are {} strokes", keep,
                     next.list.size());
        next.list.resize(keep);
        bake::Strokes added = bake::parseStrokes(json, "strokes");
        bake::resolveSpecies(added, speciesNames());
        std::move(added.list.begin(), added.list.end(), std::back_inserter(next.list));
        bake::requireStrokeCount(next, "strokes");

        const bake::Strokes before = session_->strokes();
        bake::Session::Change change;
        work(callback, [&](Progress& progress) {
            change = session_->apply(std::move(next), progress);
            try {
                bake::requireBlades(session_->bladeCount(), bladesBefore_,
                                    request_.settings.maxBlades);
            } catch (const Error&) {
                session_->apply(before, progress);
                throw;
            }
        });
        try {
            warnOfLost(keep);
        } catch (const py::error_already_set&) {
            work(py::none(), [&](Progress& progress) { session_->apply(before, progress); });
            throw;
        }
        return tell(change);
    }

    /// Replaces the ground: by arrays, or by the session's files as they are now.
    py::dict replaceGround(const std::optional<Inputs>& inputs, const py::object& callback)
    {
        const Turn turn(*this);
        apps::BakeRequest request = request_;
        if (inputs)
            request.given.ground = inputs->given().ground;
        forgetReadFiles();
        Diagnostics diagnostics;
        bake::Session::Change change;
        std::unique_ptr<terrain::GroundMesh> next;
        work(py::none(), [&](Progress&) {
            next = std::make_unique<terrain::GroundMesh>(loadGround(request, diagnostics));
        });
        issueWarnings(diagnostics); // which may throw: before the change
        work(callback, [&](Progress& progress) {
            change = session_->replaceGround(*next, progress);
            ground_ = std::move(next);
        });
        request_.given.ground = request.given.ground;
        return tell(change);
    }

    std::shared_ptr<Field> field() const
    {
        const Turn turn(*this);
        field::Field whole;
        work(py::none(), [&](Progress&) { whole = session_->field(); });
        return std::make_shared<Field>(std::move(whole), request_.inputs.front());
    }

    std::vector<std::string> speciesNames() const
    {
        std::vector<std::string> names;
        for (const bake::SpeciesTraits& species : request_.settings.meadow.species)
            names.push_back(species.name);
        return names;
    }

private:
    static py::dict tell(const bake::Session::Change& change)
    {
        py::list cells;
        for (const field::CellIndex& cell : change.cells)
            cells.append(py::make_tuple(cell[0], cell[1], cell[2]));
        py::dict result;
        result["cells"] = cells;
        result["blades"] = change.blades;
        return result;
    }

    void warnOfLost(std::size_t first) const
    {
        Diagnostics diagnostics;
        bake::warnOfContacts(std::span(session_->strokes().list).subspan(first),
                             session_->contacts(first), first, "strokes",
                             "move_strokes moves strokes onto the ground", diagnostics);
        issueWarnings(diagnostics);
    }

    apps::BakeRequest request_;
    std::unique_ptr<terrain::GroundMesh> ground_;
    std::optional<bake::Session> session_;
    std::uint64_t bladesBefore_ = 0;
    mutable std::atomic<bool> isBusy_ = false;
};

// A property of the session as it is now.
template <typename Read>
auto whenFree(Read read)
{
    return [read](const Session& session) {
        const Session::Turn turn(session);
        return read(session.open());
    };
}

} // namespace

void addSession(py::module_& module)
{
    py::class_<Session>(module, "Session")
        .def(py::init<const std::vector<std::string>&, const Inputs&, const std::shared_ptr<Field>&,
                      const py::object&>())
        .def("paint", &Session::paint)
        .def("replace_ground", &Session::replaceGround)
        .def("field", &Session::field)
        .def_property_readonly("species", &Session::speciesNames)
        .def_property_readonly("strokes", whenFree([](const bake::Session& session) {
                                   return bake::toJson(session.strokes());
                               }))
        .def_property_readonly(
            "count", whenFree([](const bake::Session& session) { return session.bladeCount(); }))
        .def_property_readonly("has_reused", whenFree([](const bake::Session& session) {
                                   return session.hasReused();
                               }))
        .def_property_readonly("origin", whenFree([](const bake::Session& session) {
                                   const glm::dvec3& origin = session.ground().origin;
                                   return py::make_tuple(origin.x, origin.y, origin.z);
                               }));
}

} // namespace sward::python
