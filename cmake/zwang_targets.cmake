# What every target of zwang shares: warnings as errors, and sanitizers where a preset asks for them. Clang's
# -Wdouble-promotion would refuse the oracle's long double, too.
option(ZWANG_UNITY "Compile the files of a folder together" OFF)
set(ZWANG_TOGETHER 20 CACHE STRING "With ZWANG_UNITY: as many files at most; fewer make a change quicker to build, and all of it slower")
add_library(zwang_flags INTERFACE)
target_compile_options(zwang_flags INTERFACE
  -Wall -Wextra -Wpedantic $<$<NOT:$<BOOL:${ZWANG_UNITY}>>:-Wshadow> -Wconversion -Wsign-conversion -Wnon-virtual-dtor -Wold-style-cast
  -Woverloaded-virtual -Wnull-dereference $<$<CXX_COMPILER_ID:GNU>:-Wdouble-promotion> -Wformat=2
  $<$<BOOL:${ZWANG_WARNINGS_AS_ERRORS}>:-Werror>)
if(ZWANG_UNITY AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # So much at once fits into memory: GCC need not look for what it can throw away, which takes a tenth of the time.
  target_compile_options(zwang_flags INTERFACE -Wno-subobject-linkage
    "SHELL:--param ggc-min-expand=1000" "SHELL:--param ggc-min-heapsize=2000000")
endif()
# Designated initializers leave fields at their defaults on purpose.
target_compile_options(zwang_flags INTERFACE -Wno-missing-field-initializers)
# Eigen trips GCC's flow analysis in optimised builds; the diagnostics point into Eigen, not into this code.
target_compile_options(zwang_flags INTERFACE
  $<$<CXX_COMPILER_ID:GNU>:-Wno-null-dereference -Wno-maybe-uninitialized -Wno-array-bounds>)
option(ZWANG_SANITIZED_LINES "Line numbers in the finds of a sanitizer" OFF)
if(ZWANG_SANITIZE)
  # A find names its functions. Line numbers take 15 % of the time to compile.
  target_compile_options(zwang_flags INTERFACE -fsanitize=${ZWANG_SANITIZE} -fno-omit-frame-pointer
    -fno-sanitize-recover=all $<$<BOOL:${ZWANG_SANITIZED_LINES}>:-g1>)
  target_link_options(zwang_flags INTERFACE -fsanitize=${ZWANG_SANITIZE})
  # A null or wild pointer is found by the address sanitizer, too. Its checks at each use kept Eigen's functions from being
  # inlined: half of the time to compile the solver, four fifths of the time to run it.
  if(ZWANG_SANITIZE MATCHES "address,undefined")
    target_compile_options(zwang_flags INTERFACE
      -fno-sanitize=null,alignment,object-size,pointer-overflow,nonnull-attribute,returns-nonnull-attribute)
  endif()
endif()

# zwang_quick_under_sanitizers(<target> [SANITIZER...]): code that runs once in a test is not optimised under a sanitizer, or
# under one of these, which takes a third of the time to compile it.
function(zwang_quick_under_sanitizers target)
  if(ZWANG_SANITIZE AND (NOT ARGN OR ZWANG_SANITIZE IN_LIST ARGN))
    target_compile_options(${target} PRIVATE -O0)
    get_target_property(type ${target} TYPE)
    if(type STREQUAL "EXECUTABLE")
      zwang_optimised_first(${target})
    endif()
  endif()
endfunction()

# The archives that a target links and that are optimised, the one that is optimised most first: the rooms, and the oracle and
# the bases of the tests.
function(zwang_optimised_behind result target)
  set(pending ${target})
  set(seen "")
  while(pending)
    list(POP_FRONT pending next)
    get_target_property(behind ${next} ALIASED_TARGET)
    if(behind)
      set(next ${behind})
    endif()
    get_target_property(type ${next} TYPE)
    if(next IN_LIST seen OR NOT type MATCHES "^(STATIC_LIBRARY|EXECUTABLE)$")
      continue()
    endif()
    list(APPEND seen ${next})
    get_target_property(libraries ${next} LINK_LIBRARIES)
    foreach(library IN LISTS libraries)
      if(TARGET ${library})
        list(APPEND pending ${library})
      endif()
    endforeach()
  endwhile()
  set(optimised "")
  foreach(library zwang_solver zwang_simulation zwang_runtime zwang_lang zwang_oracle zwang_dense_dynamics zwang_test_robots)
    if(library IN_LIST seen)
      list(APPEND optimised ${library})
    endif()
  endforeach()
  set(${result} ${optimised} PARENT_SCOPE)
endfunction()

# zwang_optimised_first(<target>): of an inline function that several objects have, the linker keeps the copy that it meets
# first. A target compiled with -O0 would lend its copies to what it links: the tests of lang ran four times as long, the
# oracle six times. So the linker meets whole archives before the target's own objects. Call it after target_link_libraries.
function(zwang_optimised_first target)
  zwang_optimised_behind(optimised ${target})
  if(optimised)
    list(TRANSFORM optimised REPLACE "(.+)" "$<TARGET_FILE:\\1>")
    list(JOIN optimised " " archives)
    target_link_options(${target} PRIVATE "SHELL:-Wl,--whole-archive ${archives} -Wl,--no-whole-archive")
  endif()
endfunction()

# zwang_together(<target>): ZWANG_UNITY compiles the files of a folder together, ZWANG_TOGETHER at most. Twenty take a quarter of the time:
# their headers are read, and what these instantiate is compiled, once. The files' anonymous namespaces meet then, so that
# -Wshadow would compare the names of one file with those of another, and GCC takes a class of a file for one of a header
# (-Wsubobject-linkage); a build without it does.
function(zwang_together target)
  if(NOT ZWANG_UNITY)
    return()
  endif()
  get_target_property(sources ${target} SOURCES)
  foreach(source IN LISTS sources)
    get_filename_component(folder "${source}" DIRECTORY)
    string(MAKE_C_IDENTIFIER "${folder}" folder)
    list(APPEND of_${folder} ${source})
    list(LENGTH of_${folder} count)
    math(EXPR group "${count} / ${ZWANG_TOGETHER}")
    set_property(SOURCE ${source} PROPERTY UNITY_GROUP "${folder}_${group}")
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
endfunction()

# GCC 12 sees overlapping copies in optimised std::string sums of literals (GCC bug 105651), and writes beyond the vectors that
# a precompiled header has grown; there are neither. Targets that are full of such sums do without both warnings.
set(zwang_no_false_alarms $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict> $<$<CXX_COMPILER_ID:GNU>:-Wno-stringop-overflow>)

# zwang_precompiled(<target> [HEADER...]): the headers that most of its files include are read once for all of them. Every
# file includes what it uses all the same: preset debug compiles without, and `./dev lint` reads the files by its commands.
# zwang_precompiled(<target> REUSE_FROM <other>): those of another target with the same flags.
set(zwang_headers_of_most <Eigen/Core> <Eigen/Geometry> <algorithm> <array> <cmath> <filesystem> <functional> <limits>
  <map> <memory> <numbers> <optional> <set> <span> <sstream> <string> <vector>)
set(zwang_headers_of_solver <zwang/solver/constraint.hpp> <zwang/solver/frame.hpp> <zwang/solver/model.hpp>
  <zwang/solver/spatial.hpp> <zwang/solver/state.hpp>)
set(zwang_headers_of_lang ${zwang_headers_of_solver} <zwang/lang/diagnostic.hpp> <zwang/lang/program.hpp>
  <zwang/lang/robot.hpp> <zwang/lang/scene.hpp>)
set(zwang_headers_of_runtime ${zwang_headers_of_lang} <zwang/runtime/event.hpp> <zwang/runtime/plant.hpp>)
set(zwang_headers_of_simulation REUSE_FROM zwang_runtime)  # it has the same flags
function(zwang_precompiled target)
  if(ZWANG_PRECOMPILE AND "REUSE_FROM" IN_LIST ARGN)
    target_precompile_headers(${target} ${ARGN})
  elseif(ZWANG_PRECOMPILE)
    target_precompile_headers(${target} PRIVATE ${zwang_headers_of_most} ${ARGN})
  endif()
endfunction()

# zwang_room(<name> [FOLDER <folder>] SOURCES ... [PUBLIC ...] [PRIVATE ...]): one room, a library `zwang_<name>` with the
# alias zwang::<name>, static unless BUILD_SHARED_LIBS says otherwise. Only the room's own include/ is added to its include
# path: a later room's headers cannot be found. FOLDER: that has include/ and src/, where it is not the present one.
function(zwang_room name)
  cmake_parse_arguments(ARG "" "FOLDER" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  if(NOT ARG_FOLDER)
    set(ARG_FOLDER ${CMAKE_CURRENT_SOURCE_DIR})
  endif()
  add_library(zwang_${name} ${ARG_SOURCES})
  add_library(zwang::${name} ALIAS zwang_${name})
  target_include_directories(zwang_${name}
    PUBLIC $<BUILD_INTERFACE:${ARG_FOLDER}/include> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>
    PRIVATE ${ARG_FOLDER}/src)
  target_compile_features(zwang_${name} PUBLIC cxx_std_20)
  # Nobody replaces a single function of a library that is loaded: calls within it stay direct, and can be inlined.
  target_compile_options(zwang_${name} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-fno-semantic-interposition>)
  target_link_libraries(zwang_${name} PUBLIC ${ARG_PUBLIC} PRIVATE $<BUILD_INTERFACE:zwang_flags> ${ARG_PRIVATE})
  # Before 1.0 a minor version may break interfaces.
  set_target_properties(zwang_${name} PROPERTIES
    VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}
    CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)  # ZWANG_EXPORT shows what public headers declare
  zwang_precompiled(zwang_${name} ${zwang_headers_of_${name}})
  zwang_together(zwang_${name})
endfunction()
