# SPDX-License-Identifier: Apache-2.0
# `cmake --install build --prefix FOLDER`: the library, its headers, the built-in scenes, and the CMake package `halfway`.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/halfway)
set(scenes_folder ${CMAKE_INSTALL_DATADIR}/halfway/scenes)

# The program is called halfway, so the target has another name than its file.
set_target_properties(libhalfway PROPERTIES OUTPUT_NAME halfway EXPORT_NAME halfway)
target_link_libraries(libhalfway PRIVATE fmt::fmt Threads::Threads)
target_include_directories(libhalfway INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)

install(TARGETS libhalfway EXPORT halfway ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(FILES sim/extras/library/halfway.h sim/extras/library/halfway_core.h
  ${CMAKE_BINARY_DIR}/generated/sim/extras/library/halfway_core_registers.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
file(GLOB scenes CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/sim/scenes/*.toml)
install(FILES ${scenes} DESTINATION ${scenes_folder})

install(EXPORT halfway NAMESPACE halfway:: FILE halfway-targets.cmake DESTINATION ${package_folder})
configure_package_config_file(scripts/halfway-config.cmake.in halfway-config.cmake
  INSTALL_DESTINATION ${package_folder} PATH_VARS scenes_folder)
write_basic_package_version_file(halfway-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/halfway-config.cmake ${CMAKE_CURRENT_BINARY_DIR}/halfway-config-version.cmake
  DESTINATION ${package_folder})
