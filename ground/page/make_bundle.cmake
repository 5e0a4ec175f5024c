# Called by bundle.cmake: NODE, NPM, WEB (the sources), FOLDER (where to work). Leaves FOLDER/bundle, empty files in it
# where there is no page.

set(work ${FOLDER}/work)
file(MAKE_DIRECTORY ${work} ${FOLDER}/bundle)

function(give_up why)
  message(WARNING "gyre is built without its page: ${why}")
  file(WRITE ${FOLDER}/bundle/index.html.gz "")
  file(WRITE ${FOLDER}/bundle/csp.txt "")
endfunction()

# What npm installs stays until the lock file is another one.
file(GLOB sources LIST_DIRECTORIES true ${WEB}/*)
list(FILTER sources EXCLUDE REGEX "/(node_modules|test)$")
file(COPY ${sources} DESTINATION ${work})
file(SHA256 ${WEB}/package-lock.json lock)
set(installed "")
if(EXISTS ${work}/installed)
  file(READ ${work}/installed installed)
endif()
if(NOT installed STREQUAL lock)
  # No package's own scripts: nothing that is downloaded runs but esbuild, when it is asked to.
  execute_process(COMMAND ${NPM} ci --ignore-scripts --no-audit --no-fund --loglevel=error --fetch-retries=1
            --fetch-retry-mintimeout=1000 --fetch-timeout=60000
    WORKING_DIRECTORY ${work} TIMEOUT 300 RESULT_VARIABLE failed OUTPUT_VARIABLE words ERROR_VARIABLE words)
  if(NOT failed EQUAL 0)
    give_up("npm ci failed\n${words}")
    return()
  endif()
  file(WRITE ${work}/installed ${lock})
endif()
execute_process(COMMAND ${NODE} build.mjs ${FOLDER}/bundle
  WORKING_DIRECTORY ${work} TIMEOUT 120 RESULT_VARIABLE failed OUTPUT_VARIABLE words ERROR_VARIABLE words)
if(NOT failed EQUAL 0)
  # This is no missing tool but a mistake in the sources.
  message(FATAL_ERROR "the page cannot be made:\n${words}")
endif()
file(TOUCH ${FOLDER}/stamp)
