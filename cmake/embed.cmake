# sward_embed(TARGET VARIABLE_NAMESPACE FILES …)
#   Compiles files into TARGET as a function
#     std::span<const sward::EmbeddedFile> sward::embedded::NAMESPACE();
#   declared in "core/embedded.h"; the name of each entry is the file's name without folders.
function(sward_embed target namespace)
  set(output ${CMAKE_CURRENT_BINARY_DIR}/embedded_${namespace}.cpp)
  add_custom_command(OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} "-DOUTPUT=${output}" "-DNAMESPACE=${namespace}" "-DFILES=${ARGN}"
            -P ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/embed_files.cmake
    DEPENDS ${ARGN} ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/embed_files.cmake
    COMMENT "Embedding ${namespace}"
    VERBATIM)
  target_sources(${target} PRIVATE ${output})
endfunction()
