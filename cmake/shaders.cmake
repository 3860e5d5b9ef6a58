# sward_add_shaders(TARGET SOURCES …)
#   Compiles each GLSL stage with true dependencies (--depfile), validates it, and collects the
#   modules in the property SWARD_SPIRV of TARGET.
#   Neither -g, which puts the text of every header into each module (10 MB in all), nor -gV, with which
#   glslang 12 writes modules that spirv-val rejects.
find_program(GLSLANG_VALIDATOR glslangValidator REQUIRED)
find_program(SPIRV_VAL spirv-val REQUIRED)
# The viewer compiles with the same, where it reloads shaders.
set(SWARD_GLSLANG_FLAGS --quiet -V --target-env vulkan1.3)
set(SWARD_SPIRV_VAL_FLAGS --target-env vulkan1.3 --scalar-block-layout)

function(sward_add_shaders target)
  set(modules "")
  foreach(source IN LISTS ARGN)
    get_filename_component(name ${source} NAME)
    set(module ${CMAKE_CURRENT_BINARY_DIR}/${name}.spv)
    add_custom_command(OUTPUT ${module}
      COMMAND ${GLSLANG_VALIDATOR} ${SWARD_GLSLANG_FLAGS} -I${CMAKE_CURRENT_FUNCTION_LIST_DIR}/..
              --depfile ${module}.d -o ${module} ${CMAKE_CURRENT_SOURCE_DIR}/${source}
      COMMAND ${SPIRV_VAL} ${SWARD_SPIRV_VAL_FLAGS} ${module}
      DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${source}
      DEPFILE ${module}.d
      COMMENT "Compiling shader ${source}"
      VERBATIM)
    list(APPEND modules ${module})
  endforeach()
  add_custom_target(${target} DEPENDS ${modules})
  set_target_properties(${target} PROPERTIES SWARD_SPIRV "${modules}")
endfunction()
