# The site of docs/, and of the public headers: `cmake --build build/dev --target docs` writes
# build/dev/site/html. A public name without a word about it is an error, and so is a link that leads
# nowhere.
set(SWARD_DOCS_OUTPUT ${CMAKE_BINARY_DIR}/site)
file(GLOB pages CONFIGURE_DEPENDS RELATIVE ${CMAKE_SOURCE_DIR}
  docs/*.md docs/algorithms/*.md docs/decisions/*.md docs/lab/*.md)
list(PREPEND pages README.md ARCHITECTURE.md CONTRIBUTING.md CHANGELOG.md assets/LICENSES.md
  examples/blender/sward_addon/README.md examples/cluster/README.md docs/bench/README.md)
# What a host includes: the doors, and what it fills in for them.
set(headers ${doors} field/display_ground.h render/frame/camera.h render/frame/colliders.h
  render/frame/frame_settings.h render/frame/wind.h)
set(SWARD_DOCS_INPUT "")
foreach(file IN LISTS pages headers)
  set(path ${CMAKE_SOURCE_DIR}/src/${file})
  if(NOT EXISTS ${path})
    set(path ${CMAKE_SOURCE_DIR}/${file})
  endif()
  string(APPEND SWARD_DOCS_INPUT " \\\n    \"${path}\"")
endforeach()
configure_file(docs/Doxyfile.in ${SWARD_DOCS_OUTPUT}/Doxyfile @ONLY)
find_program(DOXYGEN_PROGRAM doxygen) # needed by nothing else
add_custom_target(docs
  COMMAND ${DOXYGEN_PROGRAM} ${SWARD_DOCS_OUTPUT}/Doxyfile
  COMMENT "Writing ${SWARD_DOCS_OUTPUT}/html/index.html" VERBATIM)
