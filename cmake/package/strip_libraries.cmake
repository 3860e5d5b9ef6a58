# Takes what only debuggers read out of the static libraries of a package. Run by cpack.
find_program(STRIP strip REQUIRED)
file(GLOB_RECURSE libraries ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/*.a)
foreach(library IN LISTS libraries)
  execute_process(COMMAND ${STRIP} --strip-debug --enable-deterministic-archives ${library}
    COMMAND_ERROR_IS_FATAL ANY)
endforeach()
