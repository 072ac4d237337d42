# What `cmake --install` leaves, and what find_package(zwang) then finds. Each room has an export set of its own, so that
# who asks for the solver need not have what the language and the runtime need.
include(CMakePackageConfigHelpers)

set(zwang_package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/zwang)

# The program finds shared libraries where it was installed with them.
if(BUILD_SHARED_LIBS AND TARGET zwang)
  file(RELATIVE_PATH zwang_from_program_to_libraries ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_LIBDIR})
  set_target_properties(zwang PROPERTIES INSTALL_RPATH "$ORIGIN/${zwang_from_program_to_libraries}")
endif()
foreach(room IN ITEMS solver lang runtime simulation)
  if(TARGET zwang_${room})
    set_target_properties(zwang_${room} PROPERTIES EXPORT_NAME ${room} INSTALL_RPATH "$ORIGIN")
    install(TARGETS zwang_${room} EXPORT zwang_${room}
      ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development
      LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
    install(EXPORT zwang_${room} NAMESPACE zwang:: DESTINATION ${zwang_package_folder} COMPONENT development)
  endif()
  if(TARGET zwang_${room} AND IS_DIRECTORY ${PROJECT_SOURCE_DIR}/${room}/include)
    install(DIRECTORY ${PROJECT_SOURCE_DIR}/${room}/include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development)
  endif()
endforeach()

if(TARGET zwang)
  install(TARGETS zwang RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
endif()
# The parts of a run's page, where `./dev web` has built them.
install(FILES ${PROJECT_SOURCE_DIR}/web/dist/report.html DESTINATION ${CMAKE_INSTALL_DATADIR}/zwang/web COMPONENT program OPTIONAL)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/specs DESTINATION ${CMAKE_INSTALL_DATADIR}/zwang COMPONENT program)
if(TARGET zwang_python)
  install(TARGETS zwang_python LIBRARY DESTINATION lib/python3/dist-packages/zwang COMPONENT python)
  install(FILES ${PROJECT_SOURCE_DIR}/runtime/python/zwang/__init__.py ${PROJECT_SOURCE_DIR}/runtime/python/zwang/__init__.pyi
    ${PROJECT_SOURCE_DIR}/runtime/python/zwang/py.typed DESTINATION lib/python3/dist-packages/zwang COMPONENT python)
endif()

configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/zwangConfig.cmake.in
  ${PROJECT_BINARY_DIR}/zwangConfig.cmake INSTALL_DESTINATION ${zwang_package_folder})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/zwangConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/zwangConfig.cmake ${PROJECT_BINARY_DIR}/zwangConfigVersion.cmake
  ${PROJECT_SOURCE_DIR}/cmake/zwang_mujoco.cmake DESTINATION ${zwang_package_folder} COMPONENT development)

install(FILES ${PROJECT_SOURCE_DIR}/package.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/zwang COMPONENT development)

# What pkg-config tells hosts that are not built by CMake.
file(RELATIVE_PATH zwang_from_pc_to_prefix ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
foreach(file IN ITEMS zwang zwang-simulation)
  if(NOT file STREQUAL "zwang-simulation" OR TARGET zwang_simulation)
    configure_file(${PROJECT_SOURCE_DIR}/cmake/${file}.pc.in ${PROJECT_BINARY_DIR}/${file}.pc @ONLY)
    install(FILES ${PROJECT_BINARY_DIR}/${file}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)
  endif()
endforeach()

if(ZWANG_PACKAGES)
  include(${PROJECT_SOURCE_DIR}/cmake/packages.cmake)
endif()
