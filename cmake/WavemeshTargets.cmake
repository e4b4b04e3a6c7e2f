# SPDX-License-Identifier: GPL-3.0-or-later
# What every target of ours is compiled with, and VCGLib as a target.

# Warnings, hidden symbols, and no fused multiply-add: the encoder's search uses doubles and must
# choose the same on every processor.
function(wavemesh_target target)
	if(MSVC)
		target_compile_options(${target} PRIVATE /W3 /fp:precise /utf-8)
	else()
		target_compile_options(${target} PRIVATE
			-Wall -Wextra -Wshadow -Wconversion -ffp-contract=off)
	endif()
	set_target_properties(${target} PROPERTIES
		POSITION_INDEPENDENT_CODE ON
		CXX_VISIBILITY_PRESET hidden
		VISIBILITY_INLINES_HIDDEN ON)
endfunction()

if(WAVEMESH_BUILD_TOOLS OR WAVEMESH_BUILD_TESTS OR WAVEMESH_BUILD_PLUGINS)
	find_path(WAVEMESH_VCGLIB_FOUND vcg/complex/complex.h
		HINTS ${WAVEMESH_VCGLIB_DIR} ENV VCGLIB_DIR PATH_SUFFIXES vcglib)
	find_path(WAVEMESH_EIGEN_FOUND Eigen/Core PATH_SUFFIXES eigen3)
	if(NOT WAVEMESH_VCGLIB_FOUND OR NOT WAVEMESH_EIGEN_FOUND)
		message(FATAL_ERROR
			"VCGLib (and Eigen, which it needs) was not found. Pass -DWAVEMESH_VCGLIB_DIR=<folder "
			"that holds vcg/ and wrap/>, or switch tools, tests and plugins off to build the codec alone.")
	endif()
	add_library(wavemesh_vcglib INTERFACE)
	add_library(Wavemesh::vcglib ALIAS wavemesh_vcglib)
	target_include_directories(wavemesh_vcglib SYSTEM INTERFACE
		${WAVEMESH_VCGLIB_FOUND} ${WAVEMESH_EIGEN_FOUND})
endif()
