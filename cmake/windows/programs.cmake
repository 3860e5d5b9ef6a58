# The programs for 64-bit Windows: sward.dll (the C interface, for C and C++ of any compiler) with its import libraries,
# sward-view.exe, and sward.exe. `scripts/build windows` builds them on Linux; docs/windows.md.

enable_language(C)
include(compile_options)
include(windows/dependencies)
include(windows/offline_dependencies)
include(windows/window_dependencies)
include(libraries)
include(c_interface)
include(embed)
include(shaders)
# No DLL of the compiler beside ours.
add_link_options(-static)

include(subdirectories)

sward_c_functions(functions)
list(JOIN functions "\n    " exported)
set(definition ${CMAKE_BINARY_DIR}/bin/sward.def)
file(CONFIGURE OUTPUT ${definition} CONTENT "LIBRARY sward.dll\nEXPORTS\n    ${exported}\n")
add_library(sward_dll SHARED ${definition} $<TARGET_OBJECTS:sward_c_field> $<TARGET_OBJECTS:sward_c>)
target_link_libraries(sward_dll PRIVATE sward::c)
set_target_properties(sward_dll PROPERTIES PREFIX "" OUTPUT_NAME sward LINKER_LANGUAGE CXX
  ARCHIVE_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin IMPORT_PREFIX lib)
# Microsoft's linker looks for sward.lib.
add_custom_command(TARGET sward_dll POST_BUILD
  COMMAND ${DLLTOOL} --input-def ${definition} --dllname sward.dll --output-lib ${CMAKE_BINARY_DIR}/bin/sward.lib
  BYPRODUCTS ${CMAKE_BINARY_DIR}/bin/sward.lib
  VERBATIM)

add_subdirectory(src/apps/common)
add_subdirectory(src/apps/lidar)
add_subdirectory(src/apps/sward)
add_subdirectory(src/apps/sward_view)
if(SWARD_BUILD_TESTS)
  add_subdirectory(tests/windows)
endif()
