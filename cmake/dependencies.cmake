# Every find_package of the project, in one place. All of it is packaged by Debian 12 and
# 13 (scripts/install-dependencies holds the lists).

find_package(Threads REQUIRED)
find_package(Vulkan REQUIRED)
find_package(glm REQUIRED)
find_package(fmt REQUIRED)
find_package(spdlog REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(CLI11 REQUIRED)
find_package(glfw3 REQUIRED)
find_package(TBB REQUIRED)
# Embree 4 where the distribution has it, else Embree 3.
find_package(embree 4 QUIET)
if(NOT embree_FOUND)
  find_package(embree 3 REQUIRED)
endif()
# scripts/install-dependencies unpacks OpenMesh's headers; otherwise their package is installed.
set(openmesh ${CMAKE_SOURCE_DIR}/build/packages/openmesh)
if(EXISTS ${openmesh}/done)
  add_library(OpenMeshCore SHARED IMPORTED)
  set_target_properties(OpenMeshCore PROPERTIES IMPORTED_LOCATION ${openmesh}/libOpenMeshCore.so
    INTERFACE_INCLUDE_DIRECTORIES ${openmesh}/usr/include)
else()
  find_package(OpenMesh REQUIRED)
endif()
find_package(TinyGLTF REQUIRED)
find_package(PNG REQUIRED)
find_package(meshoptimizer REQUIRED)
find_package(draco REQUIRED)
find_package(OpenEXR 3 REQUIRED)
# Maps (docs/maps.md); without it they are refused.
find_package(GDAL QUIET)
find_package(zstd REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(xxhash REQUIRED IMPORTED_TARGET libxxhash)

# Debian's stb is a compiled library without a CMake or complete pkg-config description.
find_library(STB_LIBRARY stb REQUIRED)
add_library(sward_stb INTERFACE)
target_link_libraries(sward_stb INTERFACE $<BUILD_INTERFACE:${STB_LIBRARY}> $<INSTALL_INTERFACE:stb>)
set_target_properties(sward_stb PROPERTIES EXPORT_NAME stb)

# Debian's Dear ImGui is a static library; its Vulkan backend calls the linked loader, as we do.
pkg_check_modules(imgui REQUIRED imgui)
find_library(IMGUI_LIBRARY imgui REQUIRED)
add_library(sward_imgui INTERFACE)
target_include_directories(sward_imgui SYSTEM INTERFACE ${imgui_INCLUDE_DIRS})
target_link_libraries(sward_imgui INTERFACE ${IMGUI_LIBRARY} glfw Vulkan::Vulkan sward_stb)

include(fonts)

# The Python module, for the distribution's own Python, whichever comes first in PATH. Not under sanitizers, whose
# libraries Python would have to load first.
set(SWARD_PYTHON FALSE)
if(SWARD_BUILD_PYTHON AND SWARD_SANITIZE STREQUAL "")
  find_program(Python_EXECUTABLE python3 PATHS /usr/bin NO_DEFAULT_PATH)
  find_package(Python QUIET COMPONENTS Interpreter Development.Module)
  if(Python_FOUND)
    execute_process(COMMAND ${Python_EXECUTABLE} -c "import numpy" RESULT_VARIABLE without_numpy ERROR_QUIET)
    find_package(pybind11 QUIET CONFIG)
    if(pybind11_FOUND AND NOT without_numpy)
      set(SWARD_PYTHON TRUE)
    endif()
  endif()
  if(NOT SWARD_PYTHON)
    message(STATUS "The Python module is left out: pybind11-dev, python3-dev or python3-numpy is missing")
  endif()
endif()

if(SWARD_BUILD_TESTS)
  find_package(GTest REQUIRED)
  find_package(Python3 REQUIRED COMPONENTS Interpreter)
  find_package(Doxygen REQUIRED)
endif()
