# Every find_package of the project, in one place. All of it is packaged by Debian 12
# (scripts/install-dependencies holds the list).

find_package(Threads REQUIRED)
find_package(Vulkan REQUIRED)
find_package(glm REQUIRED)
find_package(fmt REQUIRED)
find_package(spdlog REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(CLI11 REQUIRED)
find_package(glfw3 REQUIRED)
find_package(TBB REQUIRED)
find_package(embree 3 REQUIRED)
find_package(OpenMesh REQUIRED)
find_package(TinyGLTF REQUIRED)
find_package(PNG REQUIRED)
find_package(meshoptimizer REQUIRED)
find_package(draco REQUIRED)
find_package(OpenEXR 3 REQUIRED)
find_package(zstd REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(xxhash REQUIRED IMPORTED_TARGET libxxhash)

# Debian's stb is a compiled library without a CMake or complete pkg-config description.
find_library(STB_LIBRARY stb REQUIRED)
add_library(sward_stb INTERFACE)
target_link_libraries(sward_stb INTERFACE ${STB_LIBRARY})

if(SWARD_BUILD_TESTS)
  find_package(GTest REQUIRED)
  find_package(Python3 REQUIRED COMPONENTS Interpreter)
endif()
