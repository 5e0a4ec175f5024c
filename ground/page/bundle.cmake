# Puts the page into the program (page_bundle.cpp): web/ made into one file by esbuild, with what npm's lock file names.
#
# Without Node or npm, or where npm cannot reach its registry, the rest builds all the same: the program says that it has
# no page, and the next build tries again.

set(page_folder ${CMAKE_CURRENT_BINARY_DIR}/page)
file(GLOB_RECURSE page_sources CONFIGURE_DEPENDS
  ${CMAKE_CURRENT_SOURCE_DIR}/page/web/*.ts ${CMAKE_CURRENT_SOURCE_DIR}/page/web/*.css
  ${CMAKE_CURRENT_SOURCE_DIR}/page/web/*.html ${CMAKE_CURRENT_SOURCE_DIR}/page/web/*.json
  ${CMAKE_CURRENT_SOURCE_DIR}/page/web/build.mjs)
find_program(GYRE_NODE NAMES node nodejs)
find_program(GYRE_NPM npm)
if(GYRE_NODE AND GYRE_NPM)
  # The command makes the stamp only where it made the page.
  add_custom_command(
    OUTPUT ${page_folder}/stamp
    BYPRODUCTS ${page_folder}/bundle/index.html.gz ${page_folder}/bundle/csp.txt
    COMMAND ${CMAKE_COMMAND} -DNODE=${GYRE_NODE} -DNPM=${GYRE_NPM} -DWEB=${CMAKE_CURRENT_SOURCE_DIR}/page/web
            -DFOLDER=${page_folder} -P ${CMAKE_CURRENT_SOURCE_DIR}/page/make_bundle.cmake
    DEPENDS ${page_sources} ${CMAKE_CURRENT_SOURCE_DIR}/page/make_bundle.cmake
    COMMENT "Making the page"
    VERBATIM)
  add_custom_target(gyre_page_bundle DEPENDS ${page_folder}/stamp)
  set_source_files_properties(page/page_bundle.cpp PROPERTIES
    COMPILE_DEFINITIONS GYRE_PAGE_FOLDER="${page_folder}/bundle"
    OBJECT_DEPENDS "${page_folder}/bundle/index.html.gz;${page_folder}/bundle/csp.txt")
else()
  message(STATUS "Node and npm were not both found: gyre is built without its page (deploy/install build installs them)")
endif()
