# SPDX-License-Identifier: GPL-3.0-or-later
# The same bytes from g++ and clang++, at -O0 and -O3: the codec is compiled anew for each, when the
# tests are built, and the hashes they print are compared when the tests run. Not with sanitizers.
if(CMAKE_CXX_FLAGS MATCHES "-fsanitize")
	return()
endif()

add_executable(determinism_this determinism_main.cpp)
target_link_libraries(determinism_this PRIVATE wavemesh_test_meshes)
wavemesh_target(determinism_this)

get_target_property(codec_sources wavemesh_codec SOURCES)
list(TRANSFORM codec_sources PREPEND ${PROJECT_SOURCE_DIR}/wavemesh/)
get_target_property(mesh_sources wavemesh_test_meshes SOURCES)
find_program(WAVEMESH_GXX g++)
find_program(WAVEMESH_CLANGXX NAMES clang++ clang++-18 clang++-16 clang++-14)
mark_as_advanced(WAVEMESH_GXX WAVEMESH_CLANGXX)

# determinism_variant(<name> <compiler> <flags>...)
function(determinism_variant name compiler)
	add_custom_command(
		OUTPUT ${name}
		COMMAND ${compiler} -std=c++17 ${ARGN} -ffp-contract=off
			-I${PROJECT_SOURCE_DIR}/wavemesh/include -I${PROJECT_SOURCE_DIR}/wavemesh/src
			-I${PROJECT_SOURCE_DIR}/tests/common -idirafter ${WAVEMESH_XXHASH_DIR}
			${codec_sources} ${mesh_sources} ${CMAKE_CURRENT_SOURCE_DIR}/determinism_main.cpp
			-o ${name}
		DEPENDS determinism_this wavemesh_codec # what these depend on, headers too
		COMMENT "Compiling the codec with ${compiler} ${ARGN}"
		VERBATIM)
	add_custom_target(${name}_program ALL DEPENDS ${name})
	add_test(NAME unit.determinism.${name} COMMAND ${CMAKE_COMMAND}
		-DA=$<TARGET_FILE:determinism_this> -DB=${CMAKE_CURRENT_BINARY_DIR}/${name}
		-P ${CMAKE_CURRENT_SOURCE_DIR}/compare_output.cmake)
endfunction()

if(WAVEMESH_GXX)
	determinism_variant(determinism_gcc_O0 ${WAVEMESH_GXX} -O0)
	if(NOT CMAKE_CXX_COMPILER_ID STREQUAL "GNU" OR NOT CMAKE_BUILD_TYPE STREQUAL "Release")
		determinism_variant(determinism_gcc_O3 ${WAVEMESH_GXX} -O3)
	endif() # else it is the codec of this build
endif()
if(WAVEMESH_CLANGXX)
	determinism_variant(determinism_clang_O0 ${WAVEMESH_CLANGXX} -O0)
	determinism_variant(determinism_clang_O3 ${WAVEMESH_CLANGXX} -O3)
else()
	add_test(NAME unit.determinism.determinism_clang COMMAND ${CMAKE_COMMAND} -E echo
		"skipped: clang++ is not installed, only g++'s bytes were compared")
	set_tests_properties(unit.determinism.determinism_clang PROPERTIES
		SKIP_REGULAR_EXPRESSION "^skipped:")
endif()
