# The Debian packages that `./dev package` makes: the program, the libraries with their headers, the Python module.
# What each holds is said where it is installed, by its COMPONENT: program, ros2, development, python, mpi.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME zwang)
set(CPACK_PACKAGE_VENDOR "zwang")
set(CPACK_PACKAGE_CONTACT "zwang maintainers <maintainers@zwang.invalid>" CACHE STRING "Maintainer of the packages, with an address")
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
# Each package has a summary of its own; this one would stand above it.
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL program development)
if(ZWANG_CONNECT)
  list(APPEND CPACK_COMPONENTS_ALL ros2)
endif()
if(ZWANG_PYTHON)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()
if(ZWANG_MPI)
  list(APPEND CPACK_COMPONENTS_ALL mpi)
endif()
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

function(zwang_package component name section depends summary description)
  string(TOUPPER ${component} key)
  set(CPACK_DEBIAN_${key}_PACKAGE_NAME ${name} PARENT_SCOPE)
  set(CPACK_DEBIAN_${key}_PACKAGE_SECTION ${section} PARENT_SCOPE)
  set(CPACK_DEBIAN_${key}_PACKAGE_DEPENDS "${depends}" PARENT_SCOPE)
  set(CPACK_DEBIAN_${key}_DESCRIPTION "${summary}\n${description}" PARENT_SCOPE)
  set(documents ${PROJECT_BINARY_DIR}/packaging/${name})
  file(MAKE_DIRECTORY ${documents})
  file(CONFIGURE OUTPUT ${documents}/changelog CONTENT
"zwang (${PROJECT_VERSION}) unstable; urgency=medium

  * The changes of each version are in /usr/share/doc/zwang/CHANGELOG.md.gz.

 -- ${CPACK_PACKAGE_CONTACT}  ${zwang_package_date}
")
  execute_process(COMMAND gzip -9nkf ${documents}/changelog)
  install(FILES ${documents}/changelog.gz DESTINATION share/doc/${name} COMPONENT ${component})
  install(FILES ${PROJECT_SOURCE_DIR}/packaging/copyright DESTINATION share/doc/${name} COMPONENT ${component})
endfunction()

# The day of the last commit, so that two builds of one commit are the same; without git, today.
execute_process(COMMAND git -C ${PROJECT_SOURCE_DIR} log -1 --format=%cD OUTPUT_VARIABLE zwang_package_date
  OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE zwang_no_git)
if(zwang_no_git)
  execute_process(COMMAND date -R OUTPUT_VARIABLE zwang_package_date OUTPUT_STRIP_TRAILING_WHITESPACE)
endif()

zwang_package(program zwang science ""
"task language and runtime for mobile robots that touch the world" "A YAML file declares force, acceleration, velocity and position on the axes of
a robot's frames, with units. zwang checks it against the robot, and runs it
on a simulated base.")
zwang_package(development libzwang-dev libdevel
  "libeigen3-dev (>= 3.4), libyaml-cpp-dev, liburdfdom-dev, libzstd-dev, zlib1g-dev, libmujoco-dev, pkg-config"
"task language and runtime for mobile robots - libraries and headers" "What a host links to run zwang tasks in its own loop: the solver, the
language, the runtime without a simulator, and the simulation on MuJoCo.")
zwang_package(mpi zwang-mpi science "zwang (= ${PROJECT_VERSION})"
"task language and runtime for mobile robots - studies on many machines" "Runs a study on many machines, under mpirun or srun: each rank runs cells, and
rank 0 keeps the results.")
zwang_package(ros2 zwang-ros2 science "zwang (= ${PROJECT_VERSION})"
"task language and runtime for mobile robots - ROS 2 robots" "Runs a task on a robot over its ROS 2 topics, by DDS, and simulates such a
robot. Neither needs an installation of ROS.")
zwang_package(python python3-zwang python "python3 (>= 3.11), python3 (<< 3.12), python3-numpy"
"task language and runtime for mobile robots - Python module" "Checks and runs task files, sweeps parameters, reads logs as numpy arrays,
and steps a plant that is written in Python.")
set(CPACK_DEBIAN_MPI_PACKAGE_RECOMMENDS openmpi-bin)  # for mpirun; srun needs no such program
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_MPI_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_ROS2_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)

# The manual page and the completions come from the program itself.
set(zwang_outlines ${PROJECT_BINARY_DIR}/packaging/outlines)
add_custom_command(OUTPUT ${zwang_outlines}/zwang.1.gz
  COMMAND ${CMAKE_COMMAND} -E make_directory ${zwang_outlines}
  COMMAND sh -c "./zwang completion bash > ${zwang_outlines}/zwang && ./zwang completion zsh > ${zwang_outlines}/_zwang && ./zwang completion fish > ${zwang_outlines}/zwang.fish && ./zwang completion man | gzip -9n > ${zwang_outlines}/zwang.1.gz && gzip -9nc ${PROJECT_SOURCE_DIR}/CHANGELOG.md > ${zwang_outlines}/CHANGELOG.md.gz"
  WORKING_DIRECTORY ${PROJECT_BINARY_DIR} DEPENDS zwang ${PROJECT_SOURCE_DIR}/CHANGELOG.md VERBATIM)
add_custom_target(zwang_outlines ALL DEPENDS ${zwang_outlines}/zwang.1.gz)
install(FILES ${zwang_outlines}/zwang DESTINATION share/bash-completion/completions COMPONENT program)
install(FILES ${zwang_outlines}/_zwang DESTINATION share/zsh/vendor-completions COMPONENT program)
install(FILES ${zwang_outlines}/zwang.fish DESTINATION share/fish/vendor_completions.d COMPONENT program)
install(FILES ${zwang_outlines}/zwang.1.gz DESTINATION share/man/man1 COMPONENT program)
install(FILES ${zwang_outlines}/CHANGELOG.md.gz DESTINATION share/doc/zwang COMPONENT program)
install(FILES ${PROJECT_SOURCE_DIR}/README.md DESTINATION share/doc/zwang COMPONENT program)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/docs DESTINATION share/doc/zwang COMPONENT program PATTERN "*.py" EXCLUDE)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/examples DESTINATION share/doc/libzwang-dev COMPONENT development)

include(CPack)
