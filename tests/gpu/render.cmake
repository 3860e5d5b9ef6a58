# The running half: shaders and passes against the CPU, and whole frames.
if(NOT TARGET sward_gpu_test_support)
  add_subdirectory(${CMAKE_SOURCE_DIR}/tests/support/gpu gpu_support)
endif()
if(NOT TARGET sward_field_test_support)
  add_subdirectory(${CMAKE_SOURCE_DIR}/tests/support/fields field_support)
endif()

sward_add_shaders(sward_render_test_shaders shaders/layout_echo.comp)
sward_add_tests(sward_render_tests LABEL gpu
  SOURCES camera_test.cpp culling_test.cpp walk_test.cpp detail_test.cpp grass_test.cpp grass_view_test.cpp ground_test.cpp opaque_test.cpp stored_target_test.cpp host_picture.cpp large_blades_test.cpp layout_test.cpp visible_patch_bound_test.cpp look_test.cpp luminance_test.cpp occlusion_test.cpp patch_sizes_test.cpp physics_test.cpp picture.cpp picture_parts_test.cpp raster_for_cpu_test.cpp preset_test.cpp exposure_test.cpp
          renderer_test.cpp residency_test.cpp shading_test.cpp shadow_contents_test.cpp streaming_test.cpp thicket.cpp update_bench.cpp
  USES sward::render sward_gpu_test_support sward_field_test_support
  ENVIRONMENT ${SWARD_GPU_ENVIRONMENT})
get_target_property(render_test_spirv sward_render_test_shaders SWARD_SPIRV)
sward_embed(sward_render_tests renderTestShaders ${render_test_spirv})
add_dependencies(sward_render_tests sward_render_test_shaders)

# A running field that is edited.
sward_add_tests(sward_edit_tests LABEL gpu
  SOURCES edit_test.cpp picture.cpp grass_edit_test.cpp host_paints_test.cpp host_picture.cpp
  USES sward::bake sward::render sward_gpu_test_support sward_field_test_support sward_test_support
  ENVIRONMENT ${SWARD_GPU_ENVIRONMENT})

add_executable(sward_edit_bench edit_bench.cpp)
target_link_libraries(sward_edit_bench PRIVATE sward_options sward::render sward_field_test_support)
