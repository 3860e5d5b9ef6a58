# cmake -DNAME=… -DLIBRARY=… -DFOLDER=… -DTEMPLATE=… -DEXTRA=… -P collect.cmake
#   Puts the libraries that an extension needs and a system may lack beside it, by the names it asks for, and writes the
#   .gdextension that names them: an export of a game takes them along.
file(GET_RUNTIME_DEPENDENCIES LIBRARIES ${LIBRARY} RESOLVED_DEPENDENCIES_VAR found CONFLICTING_DEPENDENCIES_PREFIX twice
  PRE_EXCLUDE_REGEXES "^lib(c|m|dl|pthread|rt|stdc\\+\\+|gcc_s|vulkan)\\.so" "^ld-linux")
# Those that an earlier build has put there are found there, and in the system.
list(APPEND found ${twice_FILENAMES})
set(names ${EXTRA})
foreach(path IN LISTS found)
  get_filename_component(name ${path} NAME)
  list(APPEND names ${name})
  if(IS_ABSOLUTE ${path} AND NOT path STREQUAL "${FOLDER}/${name}")
    file(REAL_PATH ${path} real)
    file(COPY_FILE ${real} ${FOLDER}/${name} ONLY_IF_DIFFERENT)
  endif()
endforeach()
list(REMOVE_DUPLICATES names)
list(SORT names)
list(TRANSFORM names REPLACE "(.+)" "\"\\1\": \"\"")
list(JOIN names ", " DEPENDENCIES)
configure_file(${TEMPLATE} ${FOLDER}/sward_${NAME}.gdextension @ONLY)
