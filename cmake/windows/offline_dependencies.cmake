# What sward.exe needs of others beside what all programs need: compiled from Debian's sources, of the versions that the
# program of Linux links (scripts/install-dependencies --windows unpacks them). Of each library what is called, and the
# same arithmetic. Zlib is Debian's own package for mingw-w64.

# sward_add_source_library(NAME FOLDER INCLUDE folders SOURCES patterns [WITHOUT regexes] [USES libraries])
#   Adds the static library sward_NAME. Folders and patterns are relative to build/packages/sources/FOLDER/source.
function(sward_add_source_library name folder)
  cmake_parse_arguments(ARG "" "" "INCLUDE;SOURCES;WITHOUT;USES" ${ARGN})
  set(root ${CMAKE_SOURCE_DIR}/build/packages/sources/${folder}/source)
  list(TRANSFORM ARG_SOURCES PREPEND ${root}/)
  list(TRANSFORM ARG_INCLUDE PREPEND ${root}/)
  file(GLOB sources RELATIVE ${root} ${ARG_SOURCES})
  foreach(pattern IN LISTS ARG_WITHOUT)
    list(FILTER sources EXCLUDE REGEX "${pattern}")
  endforeach()
  if(NOT sources)
    message(FATAL_ERROR "${root} has no sources; scripts/install-dependencies --windows unpacks them")
  endif()
  list(TRANSFORM sources PREPEND ${root}/)
  add_library(sward_${name} STATIC ${sources})
  target_include_directories(sward_${name} SYSTEM PUBLIC ${ARG_INCLUDE})
  target_compile_definitions(sward_${name} PRIVATE NDEBUG)
  target_compile_options(sward_${name} PRIVATE -w -ffp-contract=off)
  target_link_libraries(sward_${name} PUBLIC ${ARG_USES})
  set_target_properties(sward_${name} PROPERTIES UNITY_BUILD OFF)
endfunction()

file(CREATE_LINK /usr/include/tiny_gltf.h ${included}/tiny_gltf.h SYMBOLIC)
find_package(Threads REQUIRED)
find_library(ZLIB_ARCHIVE libz.a REQUIRED)
add_library(ZLIB::ZLIB STATIC IMPORTED)
set_target_properties(ZLIB::ZLIB PROPERTIES IMPORTED_LOCATION ${ZLIB_ARCHIVE})

sward_add_source_library(tbb tbb
  INCLUDE include
  SOURCES src/tbb/*.cpp
  USES Threads::Threads)
target_compile_definitions(sward_tbb PRIVATE __TBB_BUILD __TBB_DYNAMIC_LOAD_ENABLED=0 __TBB_SOURCE_DIRECTLY_INCLUDED=1)
target_compile_options(sward_tbb PRIVATE -mrtm -mwaitpkg -flifetime-dse=1)
# This header of it includes windows.h, which takes names such as near and far.
file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/tbb/tbb/enumerable_thread_specific.h
  CONTENT "#pragma once\n#include_next <tbb/enumerable_thread_specific.h>\n#undef near\n#undef far\n#undef small\n#undef ERROR\n\
#undef IN\n#undef OUT\n")
add_library(TBB::tbb INTERFACE IMPORTED GLOBAL)
target_include_directories(TBB::tbb SYSTEM INTERFACE ${CMAKE_BINARY_DIR}/tbb)
target_link_libraries(TBB::tbb INTERFACE sward_tbb)

# Embree 3 for the lowest instruction set, which all bakes ask for (terrain/query/surface_query.cpp), with triangles and
# quadrilaterals, one ray at a time.
set(embree_VERSION_MAJOR 3)
set(embree ${CMAKE_SOURCE_DIR}/build/packages/sources/embree/source)
sward_add_source_library(embree embree
  INCLUDE include
  SOURCES kernels/common/*.cpp kernels/geometry/*.cpp kernels/builders/*.cpp kernels/bvh/*.cpp
          common/sys/*.cpp common/math/*.cpp common/simd/*.cpp common/lexers/*.cpp common/tasking/taskschedulertbb.cpp
  WITHOUT subdiv hybrid _stream bvh8 primitive8 grid curve line_segments points hair
  USES sward_tbb)
file(STRINGS ${embree}/CMakeLists.txt lines REGEX "SET\\(EMBREE_VERSION_(MAJOR|MINOR|PATCH) ")
foreach(line IN LISTS lines)
  string(REGEX REPLACE ".*(EMBREE_VERSION_[A-Z]+) ([0-9]+).*" "\\1;\\2" line "${line}")
  list(GET line 0 variable)
  list(GET line 1 ${variable})
endforeach()
math(EXPR EMBREE_VERSION_NUMBER "10000 * ${EMBREE_VERSION_MAJOR} + 100 * ${EMBREE_VERSION_MINOR} + ${EMBREE_VERSION_PATCH}")
foreach(chosen FILTER_FUNCTION GEOMETRY_TRIANGLE GEOMETRY_QUAD DISC_POINT_SELF_INTERSECTION_AVOIDANCE STATIC_LIB)
  set(EMBREE_${chosen} ON)
endforeach()
set(EMBREE_MAX_INSTANCE_LEVEL_COUNT 1)
set(EMBREE_CURVE_SELF_INTERSECTION_AVOIDANCE_FACTOR 2.0)
set(EMBREE_HASH 0)
# Where Embree's own build writes them.
configure_file(${embree}/kernels/config.h.in ${embree}/kernels/config.h)
configure_file(${embree}/kernels/rtcore_config.h.in ${embree}/include/embree3/rtcore_config.h)
configure_file(${embree}/kernels/hash.h.in ${embree}/kernels/hash.h)
target_compile_definitions(sward_embree PUBLIC EMBREE_STATIC_LIB PRIVATE EMBREE_TARGET_SSE2 EMBREE_LOWEST_ISA TASKING_TBB)
target_compile_options(sward_embree PRIVATE -msse2 -fno-strict-overflow -fno-delete-null-pointer-checks -fwrapv -fno-strict-aliasing
  -fno-tree-vectorize)
add_library(embree ALIAS sward_embree)

sward_add_source_library(openmesh openmesh
  INCLUDE src
  SOURCES src/OpenMesh/Core/Mesh/*.cc src/OpenMesh/Core/System/*.cc src/OpenMesh/Core/Utils/*.cc)
target_compile_definitions(sward_openmesh PUBLIC _USE_MATH_DEFINES OM_STATIC_BUILD)
add_library(OpenMeshCore ALIAS sward_openmesh)

set(png ${CMAKE_SOURCE_DIR}/build/packages/sources/png/source)
set(png_made ${CMAKE_BINARY_DIR}/png)
configure_file(${png}/scripts/pnglibconf.h.prebuilt ${png_made}/pnglibconf.h COPYONLY)
sward_add_source_library(png png
  INCLUDE .
  SOURCES png*.c
  WITHOUT pngtest\\.c
  USES ZLIB::ZLIB)
target_include_directories(sward_png SYSTEM PUBLIC ${png_made})
add_library(PNG::PNG ALIAS sward_png)

sward_add_source_library(meshoptimizer meshoptimizer
  INCLUDE src
  SOURCES src/indexcodec.cpp src/vertexcodec.cpp src/vertexfilter.cpp)
add_library(meshoptimizer::meshoptimizer ALIAS sward_meshoptimizer)

# Only what decodes meshes.
file(MAKE_DIRECTORY ${included}/draco)
file(CREATE_LINK /usr/include/draco/draco_features.h ${included}/draco/draco_features.h SYMBOLIC)
sward_add_source_library(draco draco
  INCLUDE src
  SOURCES src/draco/attributes/*.cc src/draco/compression/*.cc src/draco/compression/*/*.cc src/draco/compression/*/*/*.cc
          src/draco/core/*.cc src/draco/material/*.cc src/draco/mesh/*.cc src/draco/metadata/*.cc src/draco/point_cloud/*.cc
          src/draco/texture/*.cc
  WITHOUT _test encod expert "draco/mesh/mesh_(are|cleanup|connected|misc|splitter|stripifier|utils)" triangle_soup cycle_timer
          texture_utils
  USES sward_windows_headers)
set_target_properties(sward_draco PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 12)
add_library(draco::draco ALIAS sward_draco)

# Debian's libtinygltf, of its header.
file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/tiny_gltf.cpp
  CONTENT "#define TINYGLTF_IMPLEMENTATION\n#define TINYGLTF_NO_INCLUDE_STB_IMAGE\n#define TINYGLTF_NO_INCLUDE_STB_IMAGE_WRITE\n\
#include <stb/stb_image.h>\n#include <stb/stb_image_write.h>\n#include <tiny_gltf.h>\n")
add_library(sward_tinygltf STATIC ${CMAKE_BINARY_DIR}/tiny_gltf.cpp)
target_compile_options(sward_tinygltf PRIVATE -w)
target_link_libraries(sward_tinygltf PUBLIC sward_stb)
add_library(TinyGLTF::TinyGLTF ALIAS sward_tinygltf)
