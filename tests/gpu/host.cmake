# What hosts have done their own way, and what they are told of motion.
sward_add_shaders(sward_host_test_shaders shaders/nearest_sample.comp)
sward_add_tests(sward_host_tests LABEL gpu
  SOURCES grass_light_test.cpp grass_misuse_test.cpp grass_motion_test.cpp grass_raster_test.cpp grass_shadow_test.cpp grass_store_test.cpp
          grass_streaming_test.cpp host_device_test.cpp host_picture.cpp shadow_map.cpp store_canvas.cpp
  USES sward::render sward_gpu_test_support sward_field_test_support
  ENVIRONMENT ${SWARD_GPU_ENVIRONMENT})
get_target_property(host_test_spirv sward_host_test_shaders SWARD_SPIRV)
sward_embed(sward_host_tests hostTestShaders ${host_test_spirv})
add_dependencies(sward_host_tests sward_host_test_shaders)

# What a host's frames take; measured by hand (docs/BENCHMARKS.md).
add_executable(sward_host_bench host_bench.cpp)
target_link_libraries(sward_host_bench
  PRIVATE sward_options sward::render nlohmann_json::nlohmann_json)
