# cmake -DNPM=... -DWORK=... -P fetch.cmake: the libraries of package-lock.json into WORK, or why not and the way round.
# No package's own script runs: none of them needs one.

execute_process(
  COMMAND ${NPM} ci --ignore-scripts --no-audit --no-fund --loglevel=error
  WORKING_DIRECTORY ${WORK} RESULT_VARIABLE failed)
if(failed)
  message(FATAL_ERROR "npm could not fetch the page's libraries. Without a network, build without the page: -DGYRE_PAGE=OFF")
endif()
