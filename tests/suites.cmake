# How tests are registered: a ctest is a suite, one process for all of its tests. A suite is a fixture of GoogleTest
# (TEST(Suite, …)) or a Python file. Its label is the first folder below tests/, and its name begins with all folders
# ("unit.bake.Session", "cli.view.geometry"). The label "long" is added to what scripts/test --long runs alone.
# `scripts/test --one NAME` runs a single test.

# The folders between tests/ and the current list, joined by dots: "unit.bake".
function(sward_suite_prefix output)
  cmake_path(RELATIVE_PATH CMAKE_CURRENT_SOURCE_DIR BASE_DIRECTORY ${CMAKE_SOURCE_DIR}/tests OUTPUT_VARIABLE path)
  string(REPLACE "/" "." path "${path}")
  set(${output} ${path} PARENT_SCOPE)
endfunction()

# sward_add_tests(TARGET SOURCES … USES … [UNITY] [DEFINITIONS …])
#   One GoogleTest program; each of its suites becomes a ctest. Suites whose names begin with Long are long. With UNITY
#   the sources may be compiled as one (preset release); without it, each alone: they use the same names for other things.
#   The preset release compiles a dozen at a time, so that one that changes is compiled soon, and with -O1, in half the time
#   of -O2; what is tested has -O2.
function(sward_add_tests target)
  cmake_parse_arguments(PARSE_ARGV 1 ARG "UNITY" "" "SOURCES;USES;DEFINITIONS")
  add_executable(${target} ${ARG_SOURCES})
  if(CMAKE_UNITY_BUILD)
    set_target_properties(${target} PROPERTIES UNITY_BUILD "${ARG_UNITY}" UNITY_BUILD_BATCH_SIZE 12)
    target_compile_options(${target} PRIVATE -O1)
  endif()
  target_link_libraries(${target} PRIVATE sward_options ${ARG_USES} GTest::gtest_main GTest::gmock)
  target_include_directories(${target} PRIVATE ${CMAKE_SOURCE_DIR}/tests)
  target_compile_definitions(${target} PRIVATE ${ARG_DEFINITIONS})

  # The program itself is asked for its suites, when ctest starts: no list of names can be forgotten.
  sward_suite_prefix(SWARD_SUITE_PREFIX)
  string(REGEX REPLACE "\\..*" "" SWARD_SUITE_LABEL ${SWARD_SUITE_PREFIX})
  set(SWARD_SUITE_PROGRAM $<TARGET_FILE:${target}>)
  set(SWARD_SUITE_ENVIRONMENT "${SWARD_TEST_ENVIRONMENT}")
  configure_file(${CMAKE_SOURCE_DIR}/tests/suites.ctest.in ${CMAKE_CURRENT_BINARY_DIR}/${target}.suites.in @ONLY)
  file(GENERATE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/${target}.suites.cmake
    INPUT ${CMAKE_CURRENT_BINARY_DIR}/${target}.suites.in TARGET ${target})
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${CMAKE_CURRENT_BINARY_DIR}/${target}.suites.cmake)
endfunction()

# sward_add_python_suite(FILE [ALONE] [SMOKE] [NAME name] [ENVIRONMENT …] [ARGUMENTS …] [PROPERTIES …])
#   FILE_test.py as one ctest; folders in FILE are no part of its name. Classes whose names begin with Long make a second
#   one, NAME.long, which is long and runs alone. With ALONE nothing runs beside the first one either: it measures time, or bounds it. With SMOKE `scripts/test --quick` runs it, too.
#   ARGUMENTS stand between the file and the classes.
function(sward_add_python_suite file)
  cmake_parse_arguments(PARSE_ARGV 1 ARG "ALONE;SMOKE" "NAME" "ENVIRONMENT;ARGUMENTS;PROPERTIES")
  set(source ${CMAKE_CURRENT_SOURCE_DIR}/${file}_test.py)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${source})
  sward_suite_prefix(prefix)
  string(REGEX REPLACE "\\..*" "" label ${prefix})
  if(NOT ARG_NAME)
    cmake_path(GET file FILENAME ARG_NAME)
  endif()
  set(name ${prefix}.${ARG_NAME})

  # Only classes that hold tests of their own, or inherit them, are suites; the others have no "test_".
  set(short "")
  set(long "")
  file(STRINGS ${source} lines REGEX "^class |^    def test_")
  set(class "")
  foreach(line IN LISTS lines)
    if(line MATCHES "^class ([A-Za-z0-9_]+)")
      set(class ${CMAKE_MATCH_1})
    elseif(class MATCHES "^Long")
      list(APPEND long ${class})
    else()
      list(APPEND short ${class})
    endif()
  endforeach()
  foreach(kind short long)
    list(REMOVE_DUPLICATES ${kind})
    if(${kind})
      set(suite ${name})
      set(labels ${label})
      if(ARG_SMOKE)
        list(APPEND labels smoke)
      endif()
      set(timeout 900)
      if(kind STREQUAL "long")
        set(suite ${name}.long)
        list(APPEND labels long)
        set(timeout 7200)
        set(ARG_ALONE TRUE)
      endif()
      add_test(NAME ${suite} COMMAND ${SWARD_TEST_PYTHON} ${source} ${ARG_ARGUMENTS} ${${kind}})
      set_tests_properties(${suite} PROPERTIES LABELS "${labels}" TIMEOUT ${timeout}
        SKIP_REGULAR_EXPRESSION "${SWARD_SKIPPED}" RUN_SERIAL "${ARG_ALONE}"
        ENVIRONMENT "${SWARD_TEST_ENVIRONMENT};${ARG_ENVIRONMENT}" ${ARG_PROPERTIES})
    endif()
  endforeach()
endfunction()

# What Python prints when a test was left out and none has failed (tests/support/needs.py).
set(SWARD_SKIPPED "OK \\(skipped=")
