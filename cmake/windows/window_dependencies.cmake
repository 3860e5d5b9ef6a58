# What the window of sward-view.exe needs of others beside what all programs need, from Debian's sources: GLFW for
# windows of Windows, and Dear ImGui with its parts for GLFW and Vulkan.

include(fonts)

sward_add_source_library(glfw glfw
  INCLUDE include
  SOURCES src/context.c src/init.c src/input.c src/monitor.c src/vulkan.c src/window.c src/win32_*.c src/wgl_context.c
          src/egl_context.c src/osmesa_context.c
  USES gdi32)
target_compile_definitions(sward_glfw PRIVATE _GLFW_WIN32 UNICODE _UNICODE)
add_library(glfw ALIAS sward_glfw)

# Where Debian's package has its headers.
set(imgui ${CMAKE_SOURCE_DIR}/build/packages/sources/imgui/source)
file(CREATE_LINK ${imgui} ${included}/imgui SYMBOLIC)
file(CREATE_LINK ${imgui}/misc/cpp/imgui_stdlib.h ${included}/imgui_stdlib.h SYMBOLIC)
sward_add_source_library(imgui imgui
  INCLUDE .
  SOURCES imgui.cpp imgui_draw.cpp imgui_tables.cpp imgui_widgets.cpp backends/imgui_impl_glfw.cpp
          backends/imgui_impl_vulkan.cpp misc/cpp/imgui_stdlib.cpp
  USES sward_glfw sward_windows_headers Vulkan::Vulkan)
