# What all programs need of others, for Windows. Libraries of headers are those of the Linux build: only they, not
# all of /usr/include, may be seen by the cross compiler. Zstandard is compiled from Debian's source, which
# scripts/install-dependencies --windows unpacks. Vulkan's loader is on the machine of the user, or is not.

set(included ${CMAKE_BINARY_DIR}/include)
file(MAKE_DIRECTORY ${included})
foreach(header fmt spdlog glm nlohmann CLI stb vulkan vk_video xxhash.h xxh3.h)
  if(NOT EXISTS /usr/include/${header})
    message(FATAL_ERROR "/usr/include/${header} is missing; scripts/install-dependencies --windows installs it")
  endif()
  file(CREATE_LINK /usr/include/${header} ${included}/${header} SYMBOLIC)
endforeach()

# Windows 10 1903, whose calls end_requests, atomic_file and others use. Lines end as on Linux.
add_library(sward_windows_headers INTERFACE)
target_include_directories(sward_windows_headers SYSTEM INTERFACE ${included})
target_compile_definitions(sward_windows_headers INTERFACE
  NOMINMAX WIN32_LEAN_AND_MEAN _WIN32_WINNT=0x0A00 NTDDI_VERSION=0x0A000007
  SPDLOG_HEADER_ONLY SPDLOG_FMT_EXTERNAL SPDLOG_EOL="\\n" XXH_INLINE_ALL)
foreach(name spdlog::spdlog glm::glm nlohmann_json::nlohmann_json CLI11::CLI11 PkgConfig::xxhash Vulkan::Headers)
  add_library(${name} INTERFACE IMPORTED GLOBAL)
  target_link_libraries(${name} INTERFACE sward_windows_headers)
endforeach()

# Compiled once: as a library of headers it would take every source some seconds.
set(fmt_source ${CMAKE_SOURCE_DIR}/build/packages/sources/fmt/source/src/format.cc)
if(NOT EXISTS ${fmt_source})
  message(FATAL_ERROR "${fmt_source} is missing; scripts/install-dependencies --windows unpacks it")
endif()
add_library(sward_fmt STATIC ${fmt_source})
target_link_libraries(sward_fmt PUBLIC sward_windows_headers)
add_library(fmt::fmt ALIAS sward_fmt)

set(zstd ${CMAKE_SOURCE_DIR}/build/packages/sources/zstd/source/lib)
file(GLOB zstd_sources ${zstd}/common/*.c ${zstd}/compress/*.c ${zstd}/decompress/*.c)
if(NOT zstd_sources)
  message(FATAL_ERROR "${zstd} has no sources; scripts/install-dependencies --windows unpacks them")
endif()
add_library(sward_zstd STATIC ${zstd_sources})
target_compile_definitions(sward_zstd PRIVATE ZSTD_DISABLE_ASM=1)
target_include_directories(sward_zstd SYSTEM INTERFACE ${zstd})
set_target_properties(sward_zstd PROPERTIES UNITY_BUILD OFF)
add_library(zstd::libzstd_shared ALIAS sward_zstd)

# Debian's stb is compiled for Linux.
file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/stb_image_write.c
  CONTENT "#define STB_IMAGE_WRITE_IMPLEMENTATION\n#include <stb/stb_image_write.h>\n")
file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/stb_image.c
  CONTENT "#define STB_IMAGE_IMPLEMENTATION\n#include <stb/stb_image.h>\n")
add_library(sward_stb STATIC ${CMAKE_BINARY_DIR}/stb_image_write.c ${CMAKE_BINARY_DIR}/stb_image.c)
target_link_libraries(sward_stb PUBLIC sward_windows_headers)

# The loader is opened at the first call: what reads fields, or says that there is no Vulkan, runs without it.
set(vulkan_functions "")
file(STRINGS /usr/include/vulkan/vulkan_core.h lines REGEX "VKAPI_CALL vk[A-Za-z0-9]+\\(")
foreach(line IN LISTS lines)
  string(REGEX REPLACE ".*VKAPI_CALL (vk[A-Za-z0-9]+)\\(.*" "\\1" name "${line}")
  string(APPEND vulkan_functions "${name}\n")
endforeach()
file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/vulkan-1.def CONTENT "LIBRARY vulkan-1.dll\nEXPORTS\n${vulkan_functions}")
find_program(DLLTOOL x86_64-w64-mingw32-dlltool REQUIRED)
set(vulkan_delayed ${CMAKE_BINARY_DIR}/libvulkan-1-delayed.a)
add_custom_command(OUTPUT ${vulkan_delayed}
  COMMAND ${DLLTOOL} --input-def ${CMAKE_BINARY_DIR}/vulkan-1.def --output-delaylib ${vulkan_delayed}
  DEPENDS ${CMAKE_BINARY_DIR}/vulkan-1.def
  COMMENT "Writing the import library of Vulkan's loader"
  VERBATIM)
add_custom_target(sward_vulkan_delayed DEPENDS ${vulkan_delayed})
add_library(Vulkan::Vulkan INTERFACE IMPORTED GLOBAL)
target_link_libraries(Vulkan::Vulkan INTERFACE Vulkan::Headers ${vulkan_delayed} delayimp)
add_dependencies(Vulkan::Vulkan sward_vulkan_delayed)
