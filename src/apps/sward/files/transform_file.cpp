#include "apps/sward/files/transform_file.h"

#include "core/error.h"
#include "core/files/mapped_file.h"
#include "core/json/json_text.h"
#include "core/json/settings_json.h"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/mat3x3.hpp>
#include <nlohmann/json.hpp>

#include <cmath>
#include <vector>

namespace sward::apps {
namespace {

using nlohmann::json;

constexpr std::size_t largestFile = std::size_t(1) << 20; ///< [bytes] a matrix is far smaller
constexpr double largestNumber = 1e12;
// Relative tolerance of orthogonal, equally long columns: six written digits.
constexpr double looseness = 1e-5;

// The numbers of an array, all of them finite and bounded.
std::vector<double> numbersOf(const json& array, std::size_t size, const std::string& place)
{
    if (!array.is_array() || array.size() != size)
        fail(ErrorKind::input, "{}: expected {} numbers, found {}", place, size, jsonText(array));
    std::vector<double> numbers;
    for (const json& entry : array) {
        if (!entry.is_number())
            fail(ErrorKind::input, "{}: expected a number, found {}", place, jsonText(entry));
        numbers.push_back(entry.get<double>());
        // The negation also catches NaN.
        if (!(std::abs(numbers.back()) <= largestNumber))
            fail(ErrorKind::input, "{}: {} is beyond {}", place, numbers.back(), largestNumber);
    }
    return numbers;
}

glm::dmat4 matrixOf(const json& array, const std::string& place)
{
    if (!array.is_array())
        fail(ErrorKind::input, "{}: expected an array of numbers or rows, found {}", place,
             array.type_name());
    glm::dmat4 matrix(1.0);
    const std::size_t rows = array.size();

    // Read sixteen numbers, column by column.
    if (rows == 16) {
        const std::vector<double> numbers = numbersOf(array, 16, place);
        return glm::make_mat4(numbers.data());
    }

    // Read rows of a 4×4 matrix or of a rotation.
    if (rows != 3 && rows != 4)
        fail(ErrorKind::input, "{}: expected 4 rows, 3 rows or 16 numbers, found {} entries", place,
             rows);
    for (std::size_t row = 0; row < rows; ++row) {
        const std::vector<double> numbers =
            numbersOf(array[row], rows, fmt::format("{}: row {}", place, row));
        for (std::size_t column = 0; column < rows; ++column)
            matrix[int(column)][int(row)] = numbers[column];
    }
    return matrix;
}

glm::dmat4 composed(SettingsReader& reader, const json& object, const std::string& place)
{
    glm::dvec3 translation(0.0);
    double scale = 1.0;
    reader.read("translation", translation, -largestNumber, largestNumber);
    reader.read("scale", scale, 1e-9, 1e9);
    glm::dmat4 matrix(1.0);
    if (object.contains("rotation")) {
        const std::vector<double> q = numbersOf(reader.child("rotation"), 4, place + ": rotation");
        const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
        if (std::abs(length - 1.0) > 1e-3)
            fail(ErrorKind::input, "{}: rotation has length {:.6g}, a unit quaternion has 1", place,
                 length);
        matrix = glm::dmat4(
            glm::mat3_cast(glm::dquat(q[3] / length, q[0] / length, q[1] / length, q[2] / length)));
    }
    for (glm::length_t column = 0; column < 3; ++column)
        matrix[column] *= scale;
    matrix[3] = glm::dvec4(translation, 1.0);
    return matrix;
}

void checkSimilarity(const glm::dmat4& matrix, const std::string& place)
{
    if (glm::dvec4(matrix[0].w, matrix[1].w, matrix[2].w, matrix[3].w) !=
        glm::dvec4(0.0, 0.0, 0.0, 1.0))
        fail(ErrorKind::input, "{}: the last row is ({}, {}, {}, {}), not (0, 0, 0, 1)", place,
             matrix[0].w, matrix[1].w, matrix[2].w, matrix[3].w);
    const glm::dmat3 linear(matrix);
    const double determinant = glm::determinant(linear);
    if (!(determinant > 0.0))
        fail(ErrorKind::input,
             "{}: the determinant is {:.6g}; a rotation with scale has a positive one", place,
             determinant);
    // MᵀM = s²·1 for a rotation with scale s.
    const double square = std::cbrt(determinant) * std::cbrt(determinant);
    const glm::dmat3 product = glm::transpose(linear) * linear;
    for (glm::length_t i = 0; i < 3; ++i)
        for (glm::length_t j = 0; j < 3; ++j)
            if (std::abs(product[i][j] / square - (i == j ? 1.0 : 0.0)) > looseness)
                fail(ErrorKind::input,
                     "{}: is not a rotation with uniform scale (columns {} and {})", place, i, j);
}

} // namespace

glm::dmat4 readTransform(const std::filesystem::path& path)
{
    const std::vector<std::byte> bytes = readFile(path, largestFile);
    return parseTransform({reinterpret_cast<const char*>(bytes.data()), bytes.size()},
                          path.string());
}

glm::dmat4 parseTransform(std::string_view text, const std::string& place)
{
    const json file = parseJson(text, place);
    glm::dmat4 matrix(1.0);
    if (file.is_object()) {
        SettingsReader reader(file, place);
        matrix = reader.has("matrix") ? matrixOf(reader.child("matrix"), place + ": matrix")
                                      : composed(reader, file, place);
        reader.finish();
    } else {
        matrix = matrixOf(file, place);
    }
    checkSimilarity(matrix, place);
    return matrix;
}

} // namespace sward::apps
