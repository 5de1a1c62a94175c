# cmake -D PROGRAM=<executable> -D EXPECTED=<file> -P compare_output.cmake
# Fails unless the program exits with 0 and prints exactly what the file holds.
execute_process(COMMAND ${PROGRAM}
    OUTPUT_VARIABLE printed
    COMMAND_ERROR_IS_FATAL ANY)
file(READ ${EXPECTED} expected)
if(NOT printed STREQUAL expected)
    message("--- printed\n${printed}--- expected\n${expected}---")
    message(FATAL_ERROR "${PROGRAM} does not print what ${EXPECTED} says")
endif()
