# What `cmake --install` lays down: the mechanics as a package for somebody else's project, and the programs.
#
#   find_package(gyre)  ->  gyre::mechanics        #include <gyre/mechanics/certificate.hpp>

include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(package ${CMAKE_INSTALL_LIBDIR}/cmake/gyre)
set_target_properties(gyre_base PROPERTIES EXPORT_NAME base)
set_target_properties(gyre_mechanics PROPERTIES EXPORT_NAME mechanics)
install(TARGETS gyre_base gyre_mechanics EXPORT gyreTargets
  ARCHIVE COMPONENT mechanics
  INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT gyreTargets NAMESPACE gyre:: DESTINATION ${package} COMPONENT mechanics)

configure_package_config_file(cmake/gyreConfig.cmake.in ${CMAKE_BINARY_DIR}/package/gyreConfig.cmake
  INSTALL_DESTINATION ${package})
# Before 1.0 a minor version may change what a header says.
write_basic_package_version_file(${CMAKE_BINARY_DIR}/package/gyreConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/package/gyreConfig.cmake ${CMAKE_BINARY_DIR}/package/gyreConfigVersion.cmake
  DESTINATION ${package} COMPONENT mechanics)

install(CODE "
  set(common \"${CMAKE_SOURCE_DIR}/common\")
  set(staged \"${CMAKE_BINARY_DIR}/package/gyre\")
  set(include \"\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_INCLUDEDIR}\")" COMPONENT mechanics)
install(SCRIPT cmake/install_headers.cmake COMPONENT mechanics)

if(NOT GYRE_MECHANICS_ONLY)
  # `gyre fly` looks for the others beside itself.
  install(TARGETS gyre gyre-agent gyre-coordinator gyre-simulator RUNTIME COMPONENT programs)
  install(DIRECTORY deploy/missions DESTINATION ${CMAKE_INSTALL_DATADIR}/gyre COMPONENT programs
    FILES_MATCHING PATTERN *.textproto)
endif()
