# dstylize_room(NAME USES room... LINKS target...): one room of the house, as an object library.
# USES are rooms (tests/house/include_rule.cmake checks that includes keep to them); LINKS are
# third-party targets, private to the room.
function(dstylize_room name)
  cmake_parse_arguments(ROOM "" "" "USES;LINKS" ${ARGN})
  set(dir ${PROJECT_SOURCE_DIR}/src/${name})
  file(GLOB sources CONFIGURE_DEPENDS ${dir}/*.cpp)
  file(GLOB headers CONFIGURE_DEPENDS ${dir}/*.h)
  file(GLOB lists CONFIGURE_DEPENDS ${dir}/*.def)
  set(public_headers ${headers} ${lists})
  list(FILTER public_headers EXCLUDE REGEX "/detail_[^/]*$")
  add_library(dstylize_${name} OBJECT ${sources})
  target_sources(dstylize_${name} PUBLIC FILE_SET HEADERS BASE_DIRS ${PROJECT_SOURCE_DIR}/src FILES ${headers})
  set_target_properties(dstylize_${name} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  list(TRANSFORM ROOM_USES PREPEND dstylize_)
  foreach(room IN LISTS ROOM_USES)
    target_include_directories(dstylize_${name} PRIVATE $<TARGET_PROPERTY:${room},INTERFACE_INCLUDE_DIRECTORIES>)
  endforeach()
  target_link_libraries(dstylize_${name} PRIVATE ${ROOM_LINKS})
  target_link_libraries(dstylize PRIVATE ${ROOM_LINKS})
  target_sources(dstylize PRIVATE $<TARGET_OBJECTS:dstylize_${name}>
    PUBLIC FILE_SET dstylize_${name} TYPE HEADERS BASE_DIRS ${PROJECT_SOURCE_DIR}/src FILES ${public_headers})
endfunction()
