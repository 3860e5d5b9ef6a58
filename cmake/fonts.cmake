# The letters of the viewer's panels, compiled in: SWARD_FONTS.
set(SWARD_FONTS "")
foreach(font Roboto-Regular.ttf Roboto-Medium.ttf)
  find_file(font_file ${font} PATHS /usr/share/fonts/truetype/roboto/unhinted/RobotoTTF
            NO_CACHE NO_CMAKE_FIND_ROOT_PATH REQUIRED)
  list(APPEND SWARD_FONTS ${font_file})
  unset(font_file)
endforeach()
