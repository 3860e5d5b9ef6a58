#pragma once

#include "apps/sward/options/bake_options.h"

#include <pybind11/numpy.h>

#include <optional>
#include <string>

namespace sward::python {

/// What a bake takes from Python instead of from files. Arrays have been checked for shape and
/// type by src/python/sward/_arrays.py; they are copied here.
class Inputs {
public:
    using Doubles = pybind11::array_t<double, pybind11::array::c_style>;
    using Floats = pybind11::array_t<float, pybind11::array::c_style>;
    using Indices = pybind11::array_t<std::uint32_t, pybind11::array::c_style>;
    using Words = pybind11::array_t<std::uint16_t, pybind11::array::c_style>;

    /// A mesh: (n, 3) vertices, (m, 3) triangles; (n, 4) colours and (n, 2) texture coordinates, or
    /// none; a dict of (n, k) values by name, k from 1 to 4.
    void setMesh(const std::string& name, const Doubles& vertices, const Indices& triangles,
                 const std::optional<Floats>& colors, const std::optional<Floats>& uvs,
                 const pybind11::dict& attributes, bool isSingle);

    void setHeights(const std::string& name, const Floats& heights); ///< (z, x) [m]

    void addMask(const std::string& name, const Words& values, bool invert); ///< (v, u); 65535 is 1
    void setStrokes(const std::string& json); ///< a stroke file's text
    void setMeadow(const std::string& json);  ///< a meadow file's text

    const apps::GivenInputs& given() const { return given_; }

private:
    apps::GivenInputs given_;
};

} // namespace sward::python
