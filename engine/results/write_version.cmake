cmake_minimum_required(VERSION 3.25)

# Writes OUTPUT, a header with the version and the git commit of SOURCE_DIR. Runs in every build and
# touches the header only when it changes, so that a new commit recompiles one small file.
set(commit "unknown")
find_package(Git QUIET)
if(GIT_FOUND)
  execute_process(
    COMMAND ${GIT_EXECUTABLE} --no-optional-locks describe --always --dirty --abbrev=12 --exclude=*
    WORKING_DIRECTORY ${SOURCE_DIR}
    OUTPUT_VARIABLE described
    OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET
    RESULT_VARIABLE failed)
  if(NOT failed)
    set(commit "${described}")
  endif()
endif()
file(CONFIGURE OUTPUT ${OUTPUT}
     CONTENT "#define DRILLSTRAND_VERSION \"@VERSION@\"\n#define DRILLSTRAND_COMMIT \"@commit@\"\n"
     @ONLY)
