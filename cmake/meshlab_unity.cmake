# SPDX-License-Identifier: GPL-3.0-or-later
# Given to MeshLab's own CMake (CMAKE_PROJECT_MeshLab_INCLUDE) when get_meshlab.sh builds it with
# CMAKE_UNITY_BUILD, which takes half the time. Files that cannot be compiled together are taken out
# here: those that include a header of MeshLab's that has no include guard, and those that want GLEW
# before any other OpenGL header (VCGLib's among them).
function(wavemesh_split_meshlab)
	foreach(target meshlab-common meshlab)
		if(TARGET ${target})
			get_target_property(sources ${target} SOURCES)
			get_target_property(folder ${target} SOURCE_DIR)
			foreach(source ${sources})
				get_filename_component(source ${source} ABSOLUTE BASE_DIR ${folder})
				if(source MATCHES "\\.cpp$" AND EXISTS ${source})
					file(STRINGS ${source} unguarded REGEX "#include.*(GLExtensionsManager|glew)\\.h")
					if(unguarded OR source MATCHES "/vcglib/")
						set_source_files_properties(${source} TARGET_DIRECTORY ${target}
							PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
					endif()
				endif()
			endforeach()
		endif()
	endforeach()
endfunction()
cmake_language(DEFER CALL wavemesh_split_meshlab)
