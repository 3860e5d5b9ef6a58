# What hosts have done their own way, and what they are told of motion.
sward_add_tests(sward_host_tests LABEL gpu
  SOURCES grass_motion_test.cpp grass_raster_test.cpp host_device_test.cpp host_picture.cpp
  USES sward::render sward_gpu_test_support sward_field_test_support
  ENVIRONMENT ${SWARD_GPU_ENVIRONMENT})
