# What `cmake --install` puts where: the programs with manual pages and completions (component
# runtime); the Python module (component python); documentation and examples (component documentation); and for other programs (component
# development) static libraries, headers below sward/, a CMake package and pkg-config files for the
# three link targets field, bake and render.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

install(TARGETS sward sward_view RUNTIME COMPONENT runtime)
# All libraries lie where the dynamic linker looks, even if the build names another folder for one.
# scripts/bundle packs the programs of the build, and they must not look there either.
set_target_properties(sward sward_view PROPERTIES SKIP_BUILD_RPATH ON)
install(FILES LICENSE RENAME copyright
  DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/sward COMPONENT runtime)
install(FILES LICENSE RENAME copyright
  DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/sward-dev COMPONENT development)
install(FILES LICENSE RENAME copyright
  DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/sward-doc COMPONENT documentation)
# The target sward_pages has written them (src/apps/CMakeLists.txt).
install(DIRECTORY ${CMAKE_BINARY_DIR}/share/man/man1
  DESTINATION ${CMAKE_INSTALL_MANDIR} COMPONENT runtime)
install(DIRECTORY ${CMAKE_BINARY_DIR}/share/bash-completion
  DESTINATION ${CMAKE_INSTALL_DATAROOTDIR} COMPONENT runtime)

# Pages lie as in the source tree, so that links from one to another hold.
set(SWARD_DOC_DIR ${CMAKE_INSTALL_DATAROOTDIR}/doc/sward)
install(FILES README.md ARCHITECTURE.md CONTRIBUTING.md CHANGELOG.md
  DESTINATION ${SWARD_DOC_DIR} COMPONENT documentation)
install(DIRECTORY docs examples DESTINATION ${SWARD_DOC_DIR} USE_SOURCE_PERMISSIONS
  COMPONENT documentation PATTERN Doxyfile.in EXCLUDE PATTERN __pycache__ EXCLUDE)
install(DIRECTORY assets/meadows assets/meshes assets/scenes assets/settings assets/terrains
  DESTINATION ${SWARD_DOC_DIR}/assets COMPONENT documentation PATTERN __pycache__ EXCLUDE)
install(FILES assets/LICENSES.md DESTINATION ${SWARD_DOC_DIR}/assets COMPONENT documentation)
install(FILES terrain/README.md DESTINATION ${SWARD_DOC_DIR}/terrain COMPONENT documentation)

# The Python module (component python), where Debian's Python looks for modules below /usr.
if(SWARD_PYTHON)
  set(SWARD_PYTHON_DIR lib/python3/dist-packages/sward)
  install(TARGETS sward_python LIBRARY DESTINATION ${SWARD_PYTHON_DIR} COMPONENT python)
  install(DIRECTORY ${CMAKE_BINARY_DIR}/python/sward/ DESTINATION ${SWARD_PYTHON_DIR} COMPONENT python
    FILES_MATCHING PATTERN "*.py" PATTERN "*.pyi" PATTERN "py.typed" PATTERN __pycache__ EXCLUDE)
  install(FILES LICENSE RENAME copyright
    DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/python3-sward COMPONENT python)
endif()

# Libraries. Each export is one component of find_package(sward).
set(SWARD_PACKAGE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/sward)
function(sward_install_component name)
  install(TARGETS ${ARGN} EXPORT sward${name}
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development
    INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
  install(EXPORT sward${name} NAMESPACE sward:: FILE sward${name}Targets.cmake
    DESTINATION ${SWARD_PACKAGE_DIR} COMPONENT development)
endfunction()
sward_install_component(Field sward_core sward_shared sward_field sward_c_field)
sward_install_component(Bake sward_assets sward_terrain sward_stb sward_bake)
# What reads maps: programs look for it beside themselves and where the system does.
if(TARGET sward_maps)
  install(TARGETS sward_maps LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT maps)
endif()
# The C interface for programs that open libraries: libsward.so.
install(TARGETS sward_library LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
sward_install_component(Render sward_gpu sward_render sward_presentation sward_c)

# Headers: the doors that docs/engine.md and the examples name, and whatever they include.
# tests/architecture/doors_test.py bounds their number.
set(doors
  core/error.h
  field/delta.h field/owned_field.h field/read.h field/write.h
  terrain/load.h
  bake/bake.h bake/settings/meadow.h bake/settings/stroke_file.h bake/session/session.h
  gpu/context/check.h gpu/context/host_device.h gpu/device/device_choice.h gpu/device/features.h
  gpu/memory/readback.h gpu/pipeline/graphics_pipeline.h gpu/recording/commands.h gpu/recording/rendering.h
  render/layers/frame_layers.h render/viewer/field_renderer.h render/grass.h presentation/camera_presets.h presentation/settings_file.h
  c/sward.h)
install(CODE "set(SWARD_DOORS \"${doors}\")
set(SWARD_SOURCE_DIR \"${CMAKE_SOURCE_DIR}\")
set(SWARD_INCLUDE_DIR \"${CMAKE_INSTALL_INCLUDEDIR}\")" COMPONENT development)
install(SCRIPT ${CMAKE_SOURCE_DIR}/cmake/install_headers.cmake COMPONENT development)
configure_file(cmake/package/version.h.in package/version.h @ONLY)
install(FILES ${CMAKE_BINARY_DIR}/package/version.h
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/sward COMPONENT development)

# The CMake package. Before 1.0 each minor version is a different library.
configure_package_config_file(cmake/package/swardConfig.cmake.in package/swardConfig.cmake
  INSTALL_DESTINATION ${SWARD_PACKAGE_DIR})
write_basic_package_version_file(package/swardConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/package/swardConfig.cmake
              ${CMAKE_BINARY_DIR}/package/swardConfigVersion.cmake
  DESTINATION ${SWARD_PACKAGE_DIR} COMPONENT development)

# pkg-config: sward-field, sward-bake, sward-render. Embree, OpenMesh and others describe themselves
# incompletely, so their libraries are named.
function(sward_install_pc name description requires libraries)
  set(PC_NAME ${name})
  set(PC_DESCRIPTION ${description})
  set(PC_REQUIRES ${requires})
  set(PC_LIBS ${libraries})
  file(RELATIVE_PATH PC_PREFIX /prefix/${CMAKE_INSTALL_LIBDIR}/pkgconfig /prefix)
  configure_file(cmake/package/sward.pc.in package/sward-${name}.pc @ONLY)
  install(FILES ${CMAKE_BINARY_DIR}/package/sward-${name}.pc
    DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)
endfunction()
sward_install_pc(field "Field files of grass: reading, verifying, writing"
  "glm fmt spdlog libxxhash libzstd" "-lsward_c_field -lsward_field -lsward_core")
sward_install_pc(bake "Grows grass on any ground"
  "sward-field tbb OpenEXR libpng tinygltf"
  "-lsward_bake -lsward_terrain -lsward_assets -lembree${embree_VERSION_MAJOR} -lOpenMeshCore -lmeshoptimizer -ldraco -lstb")
sward_install_pc(render "Draws fields of grass with Vulkan"
  "sward-field vulkan" "-lsward_c -lsward_presentation -lsward_render -lsward_gpu")
