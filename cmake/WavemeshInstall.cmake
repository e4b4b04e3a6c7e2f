# SPDX-License-Identifier: GPL-3.0-or-later
# What `cmake --install` puts where, and packages (`cpack`). Three components:
#   codec    libwavemesh_codec.a, headers, find_package(Wavemesh)
#   tool     wmc, its manual page and completion, the file type, its thumbnailer
#   plugins  io_wavemesh and filter_wavemesh, into MeshLab's plugin folder
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

# Debian's own MeshLab looks in its multiarch folder, whatever the prefix of ours.
set(plugin_folder ${CMAKE_INSTALL_LIBDIR})
if(EXISTS /etc/debian_version AND CMAKE_LIBRARY_ARCHITECTURE)
	set(plugin_folder lib/${CMAKE_LIBRARY_ARCHITECTURE})
endif()
set(plugin_folder ${plugin_folder}/meshlab/plugins)
set(WAVEMESH_PLUGIN_INSTALL_DIR ${plugin_folder} CACHE STRING
	"Where MeshLab looks for its plugins, below the prefix")

set_target_properties(wavemesh_codec PROPERTIES EXPORT_NAME codec)
install(TARGETS wavemesh_codec EXPORT WavemeshTargets
	ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT codec)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/wavemesh/include/wavemesh
	DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT codec)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/Wavemesh)
install(EXPORT WavemeshTargets NAMESPACE Wavemesh:: DESTINATION ${package_folder} COMPONENT codec)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/WavemeshConfig.cmake.in
	${PROJECT_BINARY_DIR}/WavemeshConfig.cmake INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/WavemeshConfigVersion.cmake
	COMPATIBILITY SameMinorVersion)
install(FILES
	${PROJECT_BINARY_DIR}/WavemeshConfig.cmake ${PROJECT_BINARY_DIR}/WavemeshConfigVersion.cmake
	DESTINATION ${package_folder} COMPONENT codec)

if(TARGET wmc)
	install(TARGETS wmc RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT tool)
	install(FILES ${PROJECT_BINARY_DIR}/wmc.1
		DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT tool)
	install(FILES ${PROJECT_SOURCE_DIR}/packaging/wmc.bash-completion
		DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME wmc COMPONENT tool)
	install(FILES ${PROJECT_SOURCE_DIR}/packaging/wavemesh.xml
		DESTINATION ${CMAKE_INSTALL_DATADIR}/mime/packages COMPONENT tool)
endif()
if(TARGET wmc-thumbnailer)
	install(TARGETS wmc-thumbnailer RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT tool)
	install(FILES ${PROJECT_SOURCE_DIR}/packaging/wavemesh.thumbnailer
		DESTINATION ${CMAKE_INSTALL_DATADIR}/thumbnailers COMPONENT tool)
endif()
if(TARGET io_wavemesh)
	install(TARGETS io_wavemesh filter_wavemesh
		LIBRARY DESTINATION ${WAVEMESH_PLUGIN_INSTALL_DIR} COMPONENT plugins)
	install(FILES ${PROJECT_SOURCE_DIR}/packaging/meshlab-wmc.desktop
		DESTINATION ${CMAKE_INSTALL_DATADIR}/applications COMPONENT plugins)
endif()
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/docs/wmc_format.md
	DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT codec)

# One .deb for each component, one .tar.gz for all.
set(CPACK_GENERATOR "TGZ;DEB")
set(CPACK_PACKAGE_NAME wavemesh)
set(CPACK_PACKAGE_VENDOR Wavemesh)
set(CPACK_PACKAGE_CONTACT "Wavemesh <wavemesh@localhost>" CACHE STRING "Maintainer of the packages")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY ${PROJECT_DESCRIPTION})
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_CODEC_PACKAGE_NAME libwavemesh-dev)
set(CPACK_DEBIAN_CODEC_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_TOOL_PACKAGE_NAME wavemesh-tools)
set(CPACK_DEBIAN_TOOL_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PLUGINS_PACKAGE_NAME meshlab-wavemesh)
# A plugin loads into the MeshLab whose headers it was compiled with, and no other: Debian's, whose
# version may be a repacked one (2025.07~dfsg), if the plugins go where that looks for them.
if(meshlab_version)
	set(CPACK_DEBIAN_PLUGINS_PACKAGE_DEPENDS libqt5widgets5)
	if(WAVEMESH_PLUGIN_INSTALL_DIR STREQUAL plugin_folder)
		string(PREPEND CPACK_DEBIAN_PLUGINS_PACKAGE_DEPENDS
			"meshlab (>= ${meshlab_version}~), meshlab (<< ${meshlab_version}.99), ")
	endif()
	set(CPACK_COMPONENT_PLUGINS_DESCRIPTION "Opens and saves .wmc in MeshLab ${meshlab_version}")
endif()
set(CPACK_COMPONENT_TOOL_DESCRIPTION "wmc, the command line, the file type and its thumbnailer")
set(CPACK_COMPONENT_CODEC_DESCRIPTION "The codec as a static library with headers")
include(CPack)
