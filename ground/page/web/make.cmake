# Makes the page, in the build's own folder: nothing of npm's ever lies in the tree. Called with NODE, NPM, WEB (the
# sources), WORK. Leaves index.html, index.html.gz and csp.txt in WORK/out, and WORK/made.
#
# Where npm cannot bring what the lock file names, the page is left out, empty, and said to be: the rest of a program
# that flies shall not hang on a registry. Without WORK/made the next build tries again.

file(MAKE_DIRECTORY ${WORK}/out)
file(REMOVE_RECURSE ${WORK}/src ${WORK}/test)
foreach(part src test index.html style.css build.mjs tsconfig.json package.json package-lock.json)
  file(COPY ${WEB}/${part} DESTINATION ${WORK})
endforeach()

# What npm installs stays until the lock file is another one.
file(SHA256 ${WEB}/package-lock.json lock)
set(installed "")
if(EXISTS ${WORK}/installed)
  file(READ ${WORK}/installed installed)
endif()
if(NOT installed STREQUAL lock)
  # No package's own scripts: nothing that is downloaded runs but esbuild, when it is asked to.
  execute_process(
    COMMAND ${NPM} ci --ignore-scripts --no-audit --no-fund --loglevel=error --fetch-retries=1
            --fetch-retry-mintimeout=1000 --fetch-timeout=60000
    WORKING_DIRECTORY ${WORK} TIMEOUT 300 RESULT_VARIABLE failed OUTPUT_VARIABLE words ERROR_VARIABLE words)
  if(NOT failed EQUAL 0)
    message(WARNING "gyre is built without its page: npm ci failed; the next build tries again\n${words}")
    foreach(file index.html index.html.gz csp.txt)
      file(WRITE ${WORK}/out/${file} "")
    endforeach()
    return()
  endif()
  file(WRITE ${WORK}/installed ${lock})
endif()

execute_process(COMMAND ${NODE} build.mjs out
  WORKING_DIRECTORY ${WORK} TIMEOUT 120 RESULT_VARIABLE failed OUTPUT_VARIABLE words ERROR_VARIABLE words)
if(NOT failed EQUAL 0)
  message(FATAL_ERROR "the page cannot be made:\n${words}")
endif()
file(TOUCH ${WORK}/made)
