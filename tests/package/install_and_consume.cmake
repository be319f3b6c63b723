# Installs the build tree into an empty prefix, then configures, builds and runs the consumer
# against it. Run by ctest with -D build, generator, compiler, flags, version, consumer, scratch.
file(REMOVE_RECURSE ${scratch})
set(prefix ${scratch}/prefix)

function(run)
  execute_process(COMMAND ${ARGV} COMMAND_ECHO STDOUT COMMAND_ERROR_IS_FATAL ANY)
endfunction()

run(${CMAKE_COMMAND} --install ${build} --prefix ${prefix})
run(${prefix}/bin/drillstrand --version)

run(${CMAKE_COMMAND} -S ${consumer} -B ${scratch}/build -G ${generator}
    -D CMAKE_CXX_COMPILER=${compiler} -D CMAKE_CXX_FLAGS=${flags} -D CMAKE_BUILD_TYPE=Release
    -D CMAKE_PREFIX_PATH=${prefix} -D expected_version=${version})
run(${CMAKE_COMMAND} --build ${scratch}/build)
run(${scratch}/build/consumer)
