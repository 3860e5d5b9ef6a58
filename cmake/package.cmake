# `cpack -G DEB` in the build folder: sward (the programs), sward-maps (what reads maps for them, where there is GDAL),
# sward-doc (documentation and examples), python3-sward (the Python module, if it is built) and sward-dev (for programs
# that draw, bake or read fields). Debian's own tools find out which shared
# libraries the programs need, and what the packages are called that hold them.
set(CPACK_PACKAGE_NAME sward)
set(CPACK_PACKAGE_CONTACT "Sward's authors <sward@invalid>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_COMPONENTS_ALL runtime development documentation)
if(TARGET sward_maps)
  list(APPEND CPACK_COMPONENTS_ALL maps)
endif()
set(CPACK_STRIP_FILES ON)
# Static libraries are left alone by the former.
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_SOURCE_DIR}/cmake/package/strip_libraries.cmake)
set(CPACK_VERBATIM_VARIABLES ON)

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_COMPONENT_RUNTIME_DESCRIPTION "sward bakes blades of grass onto meshes and heightmaps; sward-view shows them
with Vulkan.")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME sward)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SHLIBDEPS ON)
# Any Vulkan driver will do; this one needs no GPU.
set(CPACK_DEBIAN_RUNTIME_PACKAGE_RECOMMENDS mesa-vulkan-drivers)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SUGGESTS "sward-doc, sward-maps")

set(CPACK_COMPONENT_MAPS_DESCRIPTION "Reads GeoTIFF, GeoJSON and GeoPackage for sward bake.")
set(CPACK_DEBIAN_MAPS_PACKAGE_NAME sward-maps)
set(CPACK_DEBIAN_MAPS_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_MAPS_PACKAGE_SHLIBDEPS ON)

set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "Libraries and headers for programs that read field files, bake them, or draw
them on a Vulkan device of their own.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME sward-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
# What every component needs; then what baking and drawing need, which is taken unless declined.
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "libglm-dev, libfmt-dev, libspdlog-dev, \
nlohmann-json3-dev, libxxhash-dev, libzstd-dev, pkg-config")
# libsward.so needs what it links.
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_RECOMMENDS "libvulkan-dev, libembree-dev, libopenmesh-dev, \
libtinygltf-dev, libtbb-dev, libstb-dev, libpng-dev, libopenexr-dev, libdraco-dev, \
libmeshoptimizer-dev")

set(CPACK_COMPONENT_DOCUMENTATION_DESCRIPTION "Documentation of Sward, with examples, meadows, scenes and settings.")
set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_NAME sward-doc)
set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_SECTION doc)
set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_ARCHITECTURE all)

if(SWARD_PYTHON)
  list(APPEND CPACK_COMPONENTS_ALL python)
  set(CPACK_COMPONENT_PYTHON_DESCRIPTION "Python module that bakes, reads, edits and draws fields of grass as numpy arrays.")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-sward)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
  # The native module is for one version of Python.
  math(EXPR next_python "${Python_VERSION_MINOR} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
    "python3 (>= ${Python_VERSION_MAJOR}.${Python_VERSION_MINOR}), python3 (<< ${Python_VERSION_MAJOR}.${next_python}), python3-numpy")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS mesa-vulkan-drivers)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS python3-matplotlib)
endif()
include(CPack)
