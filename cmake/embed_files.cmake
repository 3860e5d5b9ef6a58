# Writes a C++ source that holds files as byte arrays. Run by sward_embed() at build time.
set(arrays "")
set(entries "")
set(index 0)
foreach(file IN LISTS FILES)
  file(READ ${file} bytes HEX)
  get_filename_component(name ${file} NAME)
  string(REGEX REPLACE "(..)" "0x\\1," bytes "${bytes}")
  string(REGEX REPLACE "((0x..,){24})" "\\1\n    " bytes "${bytes}")
  # Shaders are read as 32-bit words, hence the alignment.
  string(APPEND arrays "alignas(16) const unsigned char file${index}[] = {\n    ${bytes}\n};\n")
  string(APPEND entries "    {\"${name}\", {file${index}, sizeof file${index}}},\n")
  math(EXPR index "${index} + 1")
endforeach()
file(WRITE ${OUTPUT} "// Written by cmake/embed_files.cmake.
#include \"core/embedded.h\"

namespace {
${arrays}
const sward::EmbeddedFile files[] = {
${entries}};
} // namespace

namespace sward::embedded {
std::span<const EmbeddedFile> ${NAMESPACE}();
std::span<const EmbeddedFile> ${NAMESPACE}()
{
    return files;
}
} // namespace sward::embedded
")
