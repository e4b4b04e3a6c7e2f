# SPDX-License-Identifier: GPL-3.0-or-later
# cmake -DA=<program> -DB=<program> -P compare_output.cmake: both must print the same and succeed.
foreach(program A B)
	execute_process(COMMAND ${${program}} OUTPUT_VARIABLE ${program}_output RESULT_VARIABLE result)
	if(NOT result EQUAL 0 OR ${program}_output STREQUAL "")
		message(FATAL_ERROR "${${program}} failed: ${result}")
	endif()
endforeach()
if(NOT A_output STREQUAL B_output)
	message(FATAL_ERROR "the bytes differ\n${A}:\n${A_output}\n${B}:\n${B_output}")
endif()
