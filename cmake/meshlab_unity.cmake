# SPDX-License-Identifier: GPL-3.0-or-later
# Given to MeshLab's own CMake (CMAKE_PROJECT_MeshLab_INCLUDE) when get_meshlab.sh builds it with
# CMAKE_UNITY_BUILD, which takes half the time. Files that include a header of MeshLab's that has no
# include guard cannot be compiled together: they are taken out here.
function(wavemesh_split_meshlab)
	foreach(target meshlab-common meshlab)
		if(TARGET ${target})
			get_target_property(sources ${target} SOURCES)
			get_target_property(folder ${target} SOURCE_DIR)
			foreach(source ${sources})
				get_filename_component(source ${source} ABSOLUTE BASE_DIR ${folder})
				if(source MATCHES "\\.cpp$" AND EXISTS ${source})
					file(STRINGS ${source} unguarded REGEX "#include.*GLExtensionsManager\\.h")
					if(unguarded)
						set_source_files_properties(${source} TARGET_DIRECTORY ${target}
							PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
					endif()
				endif()
			endforeach()
		endif()
	endforeach()
endfunction()
cmake_language(DEFER CALL wavemesh_split_meshlab)
