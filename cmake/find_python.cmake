# find_python_with(<variable> <module>...): a python3 that can import the modules, or <variable>-NOTFOUND. The first one on
# the path may lack the packages that the system's own has: look on.
function(find_python_with variable)
    list(JOIN ARGN ", " modules)
    function(imports result python)
        execute_process(COMMAND ${python} -c "import ${modules}" RESULT_VARIABLE status OUTPUT_QUIET ERROR_QUIET)
        if(NOT status EQUAL 0)
            set(${result} FALSE PARENT_SCOPE)
        endif()
    endfunction()
    find_program(${variable} python3 VALIDATOR imports DOC "A Python that has ${modules}")
endfunction()
