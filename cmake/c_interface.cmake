# sward_c_functions(VARIABLE)
#   The functions that the headers in C declare: what the shared libraries export, and nothing else.
function(sward_c_functions output)
  set(functions "")
  foreach(header field device grass view)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/src/c/${header}.h)
    file(STRINGS ${CMAKE_SOURCE_DIR}/src/c/${header}.h lines REGEX "^[a-zA-Z].*[ *]sward_[a-z0-9_]+\\(")
    foreach(line IN LISTS lines)
      string(REGEX REPLACE ".*[ *](sward_[a-z0-9_]+)\\(.*" "\\1" name "${line}")
      list(APPEND functions ${name})
    endforeach()
  endforeach()
  set(${output} ${functions} PARENT_SCOPE)
endfunction()

# sward_add_c_library(TARGET)
#   libsward.so: the C interface for engines that open libraries (C#, Rust, Python). Programs in C and C++ link the
#   static libraries instead.
function(sward_add_c_library target)
  sward_c_functions(functions)
  list(JOIN functions "; " exported)
  set(script ${CMAKE_BINARY_DIR}/libsward.map)
  file(CONFIGURE OUTPUT ${script} CONTENT "{ global: ${exported}; local: *; };\n")
  add_library(${target} SHARED $<TARGET_OBJECTS:sward_c_field> $<TARGET_OBJECTS:sward_c>)
  target_link_libraries(${target} PRIVATE sward::c)
  # Reading fields needs no Vulkan, and drawing takes the host's loader or opens one.
  target_link_options(${target} PRIVATE LINKER:--version-script=${script} LINKER:--as-needed LINKER:--gc-sections)
  set_target_properties(${target} PROPERTIES OUTPUT_NAME sward LINKER_LANGUAGE CXX LINK_DEPENDS ${script}
    SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR} VERSION ${PROJECT_VERSION}
    LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/lib SKIP_BUILD_RPATH ON)
endfunction()
