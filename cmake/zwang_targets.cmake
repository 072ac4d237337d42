# What every target of zwang shares: warnings as errors, and sanitizers where a preset asks for them. Clang's
# -Wdouble-promotion would refuse the oracle's long double, too.
add_library(zwang_flags INTERFACE)
target_compile_options(zwang_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wnon-virtual-dtor -Wold-style-cast
  -Woverloaded-virtual -Wnull-dereference $<$<CXX_COMPILER_ID:GNU>:-Wdouble-promotion> -Wformat=2
  $<$<BOOL:${ZWANG_WARNINGS_AS_ERRORS}>:-Werror>)
# Designated initializers leave fields at their defaults on purpose.
target_compile_options(zwang_flags INTERFACE -Wno-missing-field-initializers)
# Eigen trips GCC's flow analysis in optimised builds; the diagnostics point into Eigen, not into this code.
target_compile_options(zwang_flags INTERFACE
  $<$<CXX_COMPILER_ID:GNU>:-Wno-null-dereference -Wno-maybe-uninitialized -Wno-array-bounds>)
if(ZWANG_SANITIZE)
  target_compile_options(zwang_flags INTERFACE -fsanitize=${ZWANG_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(zwang_flags INTERFACE -fsanitize=${ZWANG_SANITIZE})
endif()

# zwang_precompiled(<target>): where a preset asks for it, what most files include is read once for all of them. Release
# does without: there each file has to include what it uses.
set(zwang_headers_of_most <Eigen/Dense> <algorithm> <array> <cmath> <filesystem> <functional> <limits> <map> <memory>
  <numbers> <optional> <sstream> <string> <vector>)
function(zwang_precompiled target)
  if(ZWANG_PRECOMPILE)
    target_precompile_headers(${target} PRIVATE ${zwang_headers_of_most})
  endif()
endfunction()

# zwang_room(<name> SOURCES ... [PUBLIC ...] [PRIVATE ...]): one room, a static library `zwang_<name>` with the alias
# zwang::<name>. Only the room's own include/ is added to its include path: a later room's headers cannot be found.
function(zwang_room name)
  cmake_parse_arguments(ARG "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  add_library(zwang_${name} STATIC ${ARG_SOURCES})
  add_library(zwang::${name} ALIAS zwang_${name})
  target_include_directories(zwang_${name}
    PUBLIC $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>
    PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/src)
  target_compile_features(zwang_${name} PUBLIC cxx_std_20)
  target_link_libraries(zwang_${name} PUBLIC ${ARG_PUBLIC} PRIVATE $<BUILD_INTERFACE:zwang_flags> ${ARG_PRIVATE})
  zwang_precompiled(zwang_${name})
endfunction()
