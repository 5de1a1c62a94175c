# Files of FOLDER have the same bytes.
function(expect_same_files a b)
    file(SHA256 ${FOLDER}/${a} hash_a)
    file(SHA256 ${FOLDER}/${b} hash_b)
    if(NOT hash_a STREQUAL hash_b)
        message(FATAL_ERROR "${a} and ${b} differ")
    endif()
endfunction()
