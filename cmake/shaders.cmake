# Compiles each shader module with true dependencies (--depfile), validates it, and collects the modules in the property
# SWARD_SPIRV of a target. Neither -g, which puts the text of every header into each module (10 MB in all), nor -gV,
# with which glslang 12 writes modules that spirv-val rejects.
#
# sward_add_shaders(TARGET SOURCES …)
#   A module of each source, named as the source with its suffix.
#
# sward_add_shader_modules(TARGET TABLE)
#   The modules of a table such as shaders/modules.def, beside which their sources lie.
find_program(GLSLANG_VALIDATOR glslangValidator REQUIRED)
find_program(SPIRV_VAL spirv-val REQUIRED)
# The viewer compiles with the same, where it reloads shaders.
set(SWARD_GLSLANG_FLAGS --quiet -V --target-env vulkan1.3)
set(SWARD_SPIRV_VAL_FLAGS --target-env vulkan1.3 --scalar-block-layout)

# Compiles SOURCE with DEFINITIONS … into the module NAME.spv, and appends its path to the list OUTPUT.
function(sward_compile_shader output name source)
  set(module ${CMAKE_CURRENT_BINARY_DIR}/${name}.spv)
  list(TRANSFORM ARGN PREPEND -D OUTPUT_VARIABLE definitions)
  add_custom_command(OUTPUT ${module}
    COMMAND ${GLSLANG_VALIDATOR} ${SWARD_GLSLANG_FLAGS} ${definitions} -I${CMAKE_CURRENT_FUNCTION_LIST_DIR}/..
            --depfile ${module}.d -o ${module} ${CMAKE_CURRENT_SOURCE_DIR}/${source}
    COMMAND ${SPIRV_VAL} ${SWARD_SPIRV_VAL_FLAGS} ${module}
    DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${source}
    DEPFILE ${module}.d
    COMMENT "Compiling shader ${name}"
    VERBATIM)
  set(${output} ${${output}} ${module} PARENT_SCOPE)
endfunction()

function(sward_add_shaders target)
  set(modules "")
  foreach(source IN LISTS ARGN)
    get_filename_component(name ${source} NAME)
    sward_compile_shader(modules ${name} ${source})
  endforeach()
  add_custom_target(${target} DEPENDS ${modules})
  set_target_properties(${target} PROPERTIES SWARD_SPIRV "${modules}")
endfunction()

function(sward_add_shader_modules target table)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${table})
  file(STRINGS ${table} lines REGEX "^SHADER_MODULE")
  set(modules "")
  foreach(line IN LISTS lines)
    if(NOT line MATCHES [[^SHADER_MODULE\(([A-Za-z]+), "([a-z_/.]+)", "([A-Za-z0-9_= ]*)"\)$]])
      message(FATAL_ERROR "${table}: not a name, a source and definitions: ${line}")
    endif()
    set(name ${CMAKE_MATCH_1})
    set(source ${CMAKE_MATCH_2})
    string(REPLACE " " ";" definitions "${CMAKE_MATCH_3}")
    sward_compile_shader(modules ${name} ${source} ${definitions})
  endforeach()
  add_custom_target(${target} DEPENDS ${modules})
  set_target_properties(${target} PROPERTIES SWARD_SPIRV "${modules}")
endfunction()
