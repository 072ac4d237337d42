# The imported target mujoco::mujoco. Distributions' own package files for MuJoCo are not usable everywhere (some name paths
# that exist on the packager's machine only), so the header and the library are looked for directly.
find_path(ZWANG_MUJOCO_INCLUDE_DIR mujoco/mujoco.h DOC "Folder that holds mujoco/mujoco.h")
find_library(ZWANG_MUJOCO_LIBRARY NAMES mujoco DOC "MuJoCo's library")
mark_as_advanced(ZWANG_MUJOCO_INCLUDE_DIR ZWANG_MUJOCO_LIBRARY)

if(ZWANG_MUJOCO_INCLUDE_DIR)
  file(STRINGS ${ZWANG_MUJOCO_INCLUDE_DIR}/mujoco/mujoco.h zwang_mujoco_version REGEX "^#define mjVERSION_HEADER [0-9]+")
  string(REGEX MATCH "[0-9]+" zwang_mujoco_version "${zwang_mujoco_version}")
endif()

if(NOT ZWANG_MUJOCO_INCLUDE_DIR OR NOT ZWANG_MUJOCO_LIBRARY)
  message(FATAL_ERROR "zwang's simulated plant needs MuJoCo 2.2 or newer (Debian: apt install libmujoco-dev)")
elseif(zwang_mujoco_version LESS 220)
  message(FATAL_ERROR "zwang's simulated plant needs MuJoCo 2.2 or newer, found version number ${zwang_mujoco_version}")
endif()

add_library(mujoco::mujoco UNKNOWN IMPORTED GLOBAL)
set_target_properties(mujoco::mujoco PROPERTIES
  IMPORTED_LOCATION ${ZWANG_MUJOCO_LIBRARY}
  INTERFACE_INCLUDE_DIRECTORIES ${ZWANG_MUJOCO_INCLUDE_DIR})
