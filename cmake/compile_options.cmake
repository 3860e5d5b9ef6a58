# What every target of the project is compiled with. Third-party headers are SYSTEM and stay silent.

add_library(sward_options INTERFACE)

target_compile_options(sward_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wold-style-cast
  -Wnon-virtual-dtor -Woverloaded-virtual
  # The same roots on every CPU: no fused multiply-add that the source does not spell out.
  -ffp-contract=off)
# Where several sources are compiled as one, what one of them names shadows nothing in another. Locals count.
if(CMAKE_UNITY_BUILD)
  target_compile_options(sward_options INTERFACE -Wno-shadow $<$<CXX_COMPILER_ID:GNU>:-Wshadow=local>)
endif()
# From GCC 13 on: false alarms of a std::optional that is emplaced, and of a reference from a function that takes a path by
# a temporary. GCC 12 still warns of what is uninitialized.
target_compile_options(sward_options INTERFACE
  "$<$<AND:$<COMPILE_LANG_AND_ID:CXX,GNU>,$<VERSION_GREATER_EQUAL:$<CXX_COMPILER_VERSION>,13>>:-Wno-maybe-uninitialized;-Wno-dangling-reference>")
if(SWARD_WERROR)
  target_compile_options(sward_options INTERFACE -Werror)
endif()
target_compile_definitions(sward_options INTERFACE _GLIBCXX_ASSERTIONS)

# GLM conventions, set once. Never GLM_FORCE_DEFAULT_ALIGNED_GENTYPES: it would break scalar layout.
target_compile_definitions(sward_options INTERFACE
  GLM_FORCE_DEPTH_ZERO_TO_ONE GLM_FORCE_XYZW_ONLY GLM_FORCE_EXPLICIT_CTOR)

# Repository root for terrain/… and shaders/shared/…; src/ for the rest.
target_include_directories(sward_options INTERFACE ${CMAKE_SOURCE_DIR} ${CMAKE_SOURCE_DIR}/src)

if(SWARD_SANITIZE STREQUAL "address")
  target_compile_options(sward_options INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
  target_link_options(sward_options INTERFACE -fsanitize=address,undefined)
  # Under them GCC 12 says of its own <regex> that something may be uninitialized (GCC's bug 105562).
  target_compile_options(sward_options INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
elseif(SWARD_SANITIZE STREQUAL "thread")
  target_compile_options(sward_options INTERFACE -fsanitize=thread -fno-omit-frame-pointer)
  target_link_options(sward_options INTERFACE -fsanitize=thread)
elseif(SWARD_SANITIZE STREQUAL "fuzzer")
  target_compile_options(sward_options INTERFACE -fsanitize=fuzzer-no-link,address,undefined -fno-omit-frame-pointer)
  target_link_options(sward_options INTERFACE -fsanitize=address,undefined)
elseif(NOT SWARD_SANITIZE STREQUAL "")
  message(FATAL_ERROR "SWARD_SANITIZE is '${SWARD_SANITIZE}'; known are address, thread and fuzzer")
endif()
