# sward_embed(TARGET VARIABLE_NAMESPACE FILES …)
#   Links files into TARGET as a function
#     std::span<const sward::EmbeddedFile> sward::embedded::NAMESPACE();
#   declared in "core/embedded.h"; the name of each entry is the file's name without folders.
#   The assembler reads the files (.incbin): arrays of numbers take the compiler a hundred times longer.
function(sward_embed target namespace)
  set(output ${CMAKE_CURRENT_BINARY_DIR}/embedded_${namespace}.cpp)
  set(blobs "")
  set(declarations "")
  set(entries "")
  set(index 0)
  # The section of constants: in ELF, and in the format of Windows, whose assembler knows no stack of sections.
  set(begin ".pushsection .rodata")
  set(end ".popsection")
  if(WIN32)
    set(begin ".section .rdata,\\\"dr\\\"")
    set(end ".text")
  endif()
  foreach(file IN LISTS ARGN)
    get_filename_component(name ${file} NAME)
    set(symbol sward_embedded_${namespace}_${index})
    # Shaders are read as 32-bit words, hence the alignment.
    string(APPEND blobs "    \".balign 16\\n\"\n    \"${symbol}: .incbin \\\"${file}\\\"\\n\"\n    \"${symbol}_end:\\n\"\n")
    string(APPEND declarations "extern const unsigned char ${symbol}[];\nextern const unsigned char ${symbol}_end[];\n")
    string(APPEND entries "        {\"${name}\", {${symbol}, ${symbol}_end}},\n")
    math(EXPR index "${index} + 1")
  endforeach()
  file(CONFIGURE OUTPUT ${output} @ONLY CONTENT [[// Written by cmake/embed.cmake.
#include "core/embedded.h"

asm("@begin@\n"
@blobs@    "@end@\n");

extern "C" {
@declarations@}

namespace sward::embedded {
std::span<const EmbeddedFile> @namespace@();
std::span<const EmbeddedFile> @namespace@()
{
    static const EmbeddedFile files[] = {
@entries@    };
    return files;
}
} // namespace sward::embedded
]])
  set_property(SOURCE ${output} PROPERTY OBJECT_DEPENDS "${ARGN}")
  set_property(SOURCE ${output} PROPERTY SKIP_UNITY_BUILD_INCLUSION ON)
  target_sources(${target} PRIVATE ${output})
endfunction()
