# dstylize_large_libraries(OUT TARGET): of the libraries that TARGET needs on this machine, those with tens of
# thousands of symbols, as a list of C strings for src/codec/main.cpp, which says what for. Those that need
# another of them come after it.
function(dstylize_large_libraries out target)
  get_target_property(file ${target} LOCATION)
  execute_process(COMMAND ldd ${file} OUTPUT_VARIABLE needed ERROR_QUIET)
  set(names)
  foreach(library IN ITEMS xerces-c geos dcmdata openvdb gdal opencv_videoio)
    string(REGEX MATCH "lib${library}[-.0-9]*\\.so[.0-9]*" name "${needed}")
    if(name)
      list(APPEND names "\"${name}\"")
    endif()
  endforeach()
  list(JOIN names "," names)
  set(${out} "${names}" PARENT_SCOPE)
endfunction()
