# Ranks of MPI render the image of one process to the bit; a killed one ends the run with a message, and its checkpoint continues.
file(REMOVE_RECURSE ${FOLDER})
file(MAKE_DIRECTORY ${FOLDER})
# More ranks than cores, also for root, as in a container.
set(ENV{OMPI_MCA_rmaps_base_oversubscribe} 1)
set(ENV{OMPI_ALLOW_RUN_AS_ROOT} 1)
set(ENV{OMPI_ALLOW_RUN_AS_ROOT_CONFIRM} 1)

function(expect ranks code pattern)
    execute_process(COMMAND ${around} ${MPIEXEC} ${MPIEXEC_COUNT} ${ranks} ${before} ${PROGRAM} --threads 1 ${ARGN}
        WORKING_DIRECTORY ${FOLDER} TIMEOUT 100 RESULT_VARIABLE status OUTPUT_VARIABLE out ERROR_VARIABLE err)
    if(NOT status EQUAL code OR NOT "${out}${err}" MATCHES "${pattern}")
        message(FATAL_ERROR "${ranks} ranks of tracer ${ARGN}: exit code ${status}, expected ${code} and '${pattern}', got:\n${out}${err}")
    endif()
    set(seen "${out}${err}" PARENT_SCOPE)
endfunction()
include(${CMAKE_CURRENT_LIST_DIR}/expect_same_files.cmake)

# Only the root speaks, whatever is wrong.
expect(2 2 "--spp: Value 0 not in range" --spp 0)
string(REGEX MATCHALL "Value 0 not in range" messages "${seen}")
list(LENGTH messages count)
if(NOT count EQUAL 1)
    message(FATAL_ERROR "the message is printed ${count} times:\n${seen}")
endif()
expect(2 1 "none\\.hdr: No such file" --scene sky --env none.hdr)
expect(2 0 "scene veach" --list)

# A number of passes that 2 and 4 do not divide, the last of which is shorter; and an end by the error, which drops passes.
set(all --scene cornell --width 24 --height 16 --seed 3)
foreach(limit IN ITEMS "--spp;300" "--spp;8" "--error;10%")
    expect(1 0 "relative error|8 of 8" ${all} ${limit} --output 1.exr --error-output 1_error.exr)
    foreach(ranks IN ITEMS 2 4)
        expect(${ranks} 0 "wrote ${ranks}\\.exr" ${all} ${limit} --output ${ranks}.exr --error-output ${ranks}_error.exr)
        expect_same_files(1.exr ${ranks}.exr)
        expect_same_files(1_error.exr ${ranks}_error.exr)
    endforeach()
endforeach()

# The time of a run is the root's.
expect(2 0 "samples a pixel, [0-9.]+ of 0\\.2 s" ${all} --seconds 0.2)

# A signal that mpirun passes on ends the rendering after its pass, at all ranks; what there is is written.
find_program(TIMEOUT timeout)
if(TIMEOUT)
    set(around ${TIMEOUT} --foreground --preserve-status --signal=USR1 5)
    expect(2 138 "wrote interrupted\\.exr.*tracer: interrupted|tracer: interrupted.*wrote interrupted\\.exr"
        ${all} --spp 16000000 --output interrupted.exr)
    set(around)
endif()

# A rank that dies takes the others along, and the last checkpoint is whole: any number of ranks continues it. Its killer waits for
# a checkpoint, and a second more for passes enough that a run of their number has passes of the same size.
file(WRITE ${FOLDER}/doom.sh [[
if [ "$OMPI_COMM_WORLD_RANK" = "$1" ]; then
    (for i in $(seq 300); do [ -e a.ckpt ] && break; sleep 0.1; done; sleep 1; kill -9 $$) &
fi
shift
exec "$@"
]])
set(long ${all} --spp 16000000 --checkpoint a.ckpt --checkpoint-seconds 0.01)
foreach(victim IN ITEMS 1 0)
    file(REMOVE ${FOLDER}/a.ckpt)
    set(before sh doom.sh ${victim})
    expect(2 137 "process rank ${victim} .*exited on signal 9" ${long})
    set(before)
    expect(4 0 "samples a pixel in" ${long} --seconds 1e-9 --resume --output 4.exr)
    string(REGEX MATCH "([0-9]+) samples a pixel in" matched "${seen}")
    expect(1 0 "wrote 1\\.exr" ${all} --spp ${CMAKE_MATCH_1} --output 1.exr)
    expect_same_files(1.exr 4.exr)
endforeach()
