# Installs the headers of SWARD_DOORS and all that they include, below sward/: their own includes
# become "sward/…", so that a host's core/ or render/ is never mistaken for ours. Run by
# `cmake --install`; reads SWARD_SOURCE_DIR and SWARD_INCLUDE_DIR (relative to the prefix).
cmake_policy(PUSH)
cmake_policy(VERSION 3.25)
set(todo ${SWARD_DOORS})
set(done "")
while(todo)
  list(POP_FRONT todo header)
  if(header IN_LIST done)
    continue()
  endif()
  list(APPEND done ${header})

  # Ours lie below src/ or below the root.
  set(source ${SWARD_SOURCE_DIR}/src/${header})
  if(NOT EXISTS ${source})
    set(source ${SWARD_SOURCE_DIR}/${header})
  endif()
  file(STRINGS ${source} lines REGEX "^ *# *include \"")
  foreach(line IN LISTS lines)
    string(REGEX REPLACE "^ *# *include \"([^\"]+)\".*" "\\1" included "${line}")
    list(APPEND todo ${included})
  endforeach()

  file(READ ${source} text)
  string(REGEX REPLACE "(^|\n)( *# *include \")" "\\1\\2sward/" text "${text}")
  set(target ${CMAKE_INSTALL_PREFIX}/${SWARD_INCLUDE_DIR}/sward/${header})
  file(WRITE "$ENV{DESTDIR}${target}" "${text}")
  list(APPEND CMAKE_INSTALL_MANIFEST_FILES ${target})
endwhile()
list(LENGTH done count)
message(STATUS "Installing: ${count} headers below ${CMAKE_INSTALL_PREFIX}/${SWARD_INCLUDE_DIR}/sward")
cmake_policy(POP)
