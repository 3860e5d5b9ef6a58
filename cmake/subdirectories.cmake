# The libraries that both systems build, in order of dependence: the offline half, the bridge, the running half.
foreach(folder src/core shaders assets terrain src/field src/interchange src/lidar src/trace src/bake src/gpu src/render
               src/presentation src/c)
  add_subdirectory(${folder})
endforeach()
