# SPDX-License-Identifier: GPL-3.0-or-later
# MeshLab as something to link against, and how a plugin of ours is built.
#
# Given (cache variables):
#   MESHLAB_SOURCE_DIR  MeshLab's source tree, 2022.02 or newer (holds src/common and src/vcglib)
#   MESHLAB_BUILD_DIR   where that tree was built; empty: link against an empty stub that only
#                       carries the name libmeshlab-common.so. That takes no build of MeshLab and
#                       gives a plugin that loads just as well, but leaves calls into MeshLab
#                       unproved until then.
#   MESHLAB_LIBRARY     instead of a build: the libmeshlab-common.so of an installed MeshLab
#
# Leaves:
#   MeshLab::common     headers (as <common/...> and VCGLib, both SYSTEM), MESHLAB_VERSION,
#                       MESHLAB_SCALAR, Qt, and libmeshlab-common.so (or the stub)
#   wavemesh_meshlab_plugin(<name> <sources>...)
#                       one plugin, built as <build>/plugins/lib<name>.so (the name MeshLab's own
#                       plugins have) with AUTOMOC, our warnings and Wavemesh::codec linked in.
#                       Link more with target_link_libraries(<name> PRIVATE ...).
#   WAVEMESH_PLUGIN_DIR the folder they are built in, that holds nothing else
#
# A plugin fits one version and scalar type of MeshLab (its loader insists).

set(MESHLAB_SOURCE_DIR "" CACHE PATH "MeshLab's source tree, 2022.02 or newer")
set(MESHLAB_BUILD_DIR "" CACHE PATH "Where MeshLab was built; empty: link against a stub")
set(MESHLAB_LIBRARY "" CACHE FILEPATH "libmeshlab-common.so of an installed MeshLab")
set(WAVEMESH_MESHLAB_SCALAR float CACHE STRING "MeshLab's scalar: float; double for PyMeshLab")
set_property(CACHE WAVEMESH_MESHLAB_SCALAR PROPERTY STRINGS float double)
set(WAVEMESH_PLUGIN_DIR ${PROJECT_BINARY_DIR}/plugins)

if(NOT EXISTS ${MESHLAB_SOURCE_DIR}/src/common/plugins/interfaces/io_plugin.h)
	message(FATAL_ERROR
		"MESHLAB_SOURCE_DIR is '${MESHLAB_SOURCE_DIR}', where there is no MeshLab 2022.02 or newer. "
		"Pass a checkout made by 'git clone --recursive', or run samples/run.sh, which obtains one.")
endif()
file(READ ${MESHLAB_SOURCE_DIR}/ML_VERSION meshlab_version)
string(STRIP "${meshlab_version}" meshlab_version)

# The plugins share meshes with MeshLab: its VCGLib and no other, whatever was found before.
set(WAVEMESH_VCGLIB_DIR ${MESHLAB_SOURCE_DIR}/src/vcglib)
unset(WAVEMESH_VCGLIB_FOUND CACHE)

find_package(Qt5 5.11 REQUIRED COMPONENTS Core Gui Widgets OpenGL Xml)

# libmeshlab-common.so: the built one proves our calls at link time; the stub has its name only.
add_library(wavemesh_meshlab_common INTERFACE)
add_library(MeshLab::common ALIAS wavemesh_meshlab_common)
target_include_directories(wavemesh_meshlab_common SYSTEM INTERFACE ${MESHLAB_SOURCE_DIR}/src)
target_compile_definitions(wavemesh_meshlab_common INTERFACE
	MESHLAB_VERSION=${meshlab_version} MESHLAB_SCALAR=${WAVEMESH_MESHLAB_SCALAR})
target_link_libraries(wavemesh_meshlab_common INTERFACE
	Wavemesh::vcglib Qt5::Core Qt5::Gui Qt5::Widgets Qt5::OpenGL Qt5::Xml)

set(meshlab_common_library ${MESHLAB_LIBRARY})
if(MESHLAB_BUILD_DIR)
	if(WIN32)
		set(meshlab_common_library ${MESHLAB_BUILD_DIR}/src/common/meshlab-common.lib)
	else()
		set(meshlab_common_library
			${MESHLAB_BUILD_DIR}/src/distrib/libmeshlab-common${CMAKE_SHARED_LIBRARY_SUFFIX})
	endif()
endif()
if(meshlab_common_library)
	if(NOT EXISTS ${meshlab_common_library})
		message(FATAL_ERROR "There is no ${meshlab_common_library}. Build MeshLab's target "
			"meshlab-common, or leave MESHLAB_BUILD_DIR and MESHLAB_LIBRARY empty.")
	endif()
	add_library(wavemesh_meshlab_library SHARED IMPORTED)
	set_property(TARGET wavemesh_meshlab_library
		PROPERTY IMPORTED_IMPLIB ${meshlab_common_library}) # what Windows links
	set_target_properties(wavemesh_meshlab_library PROPERTIES
		IMPORTED_LOCATION ${meshlab_common_library}
		IMPORTED_SONAME libmeshlab-common.so)
	target_link_libraries(wavemesh_meshlab_common INTERFACE wavemesh_meshlab_library)
	message(STATUS "MeshLab ${meshlab_version}: ${meshlab_common_library}")
else()
	file(WRITE ${PROJECT_BINARY_DIR}/meshlab_stub/stub.cpp "")
	add_library(wavemesh_meshlab_stub SHARED ${PROJECT_BINARY_DIR}/meshlab_stub/stub.cpp)
	set_target_properties(wavemesh_meshlab_stub PROPERTIES
		OUTPUT_NAME meshlab-common
		LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/meshlab_stub)
	add_dependencies(wavemesh_meshlab_common wavemesh_meshlab_stub)
	# Nothing of the stub is used, so the linker has to be told to note its name.
	target_link_libraries(wavemesh_meshlab_common INTERFACE
		-Wl,--push-state,--no-as-needed $<TARGET_FILE:wavemesh_meshlab_stub> -Wl,--pop-state)
	message(STATUS "MeshLab ${meshlab_version}: headers only, linking against a stub")
endif()

function(wavemesh_meshlab_plugin name)
	add_library(${name} MODULE ${ARGN})
	target_include_directories(${name} PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
	target_link_libraries(${name} PRIVATE Wavemesh::codec MeshLab::common)
	wavemesh_target(${name})
	# --as-needed keeps Qt's and MeshLab's own dependencies (OpenGL, GLEW) out of the plugin, so that
	# it loads wherever MeshLab itself does. No run path: the host has libmeshlab-common.so loaded.
	# What it leaves on a layer is destroyed by its code, which has to outlive an unloaded plugin.
	if(CMAKE_SYSTEM_NAME STREQUAL Linux)
		target_link_options(${name} PRIVATE LINKER:--as-needed LINKER:-z,nodelete
			$<$<BOOL:${meshlab_common_library}>:LINKER:--no-undefined>)
	endif()
	set_target_properties(${name} PROPERTIES
		AUTOMOC ON
		SKIP_BUILD_RPATH ON
		LIBRARY_OUTPUT_DIRECTORY ${WAVEMESH_PLUGIN_DIR})
endfunction()
