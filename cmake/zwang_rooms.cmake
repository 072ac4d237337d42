# zwang_rooms: those that ZWANG_ROOMS names, and the ones that these stand on. In the order in which they do:
set(zwang_all_rooms solver lang runtime simulation cli)

# zwang_rooms_below(<variable> <room>...): the rooms, and all before the last of them.
function(zwang_rooms_below variable)
  set(below "")
  foreach(room IN LISTS ARGN)
    list(FIND zwang_all_rooms "${room}" place)
    if(place EQUAL -1)
      list(JOIN zwang_all_rooms ", " known)
      message(FATAL_ERROR "zwang has no room ${room}; it has ${known}")
    endif()
    math(EXPR count "${place} + 1")
    list(SUBLIST zwang_all_rooms 0 ${count} with_earlier)
    list(APPEND below ${with_earlier})
  endforeach()
  list(REMOVE_DUPLICATES below)
  set(${variable} ${below} PARENT_SCOPE)
endfunction()

if(NOT ZWANG_ROOMS)
  message(FATAL_ERROR "ZWANG_ROOMS is empty: name solver, lang, runtime, simulation or cli")
endif()
zwang_rooms_below(zwang_rooms ${ZWANG_ROOMS})
