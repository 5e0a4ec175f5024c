# Here a header is named after its folder, "common/mechanics/plan.hpp"; outside, where others may have a `common` of
# their own, after its namespace, "gyre/mechanics/plan.hpp". The name is changed on the way out, so that no file bends
# for it. Told by gyre_install.cmake: `common`, where they are; `staged`, where they may be written; `include`.

file(REMOVE_RECURSE ${staged})
foreach(room base mechanics)
  file(GLOB headers RELATIVE ${common} ${common}/${room}/*.hpp)
  list(FILTER headers EXCLUDE REGEX "^base/(interrupts|log)[.]hpp$")  # for mains, which are not in the package
  foreach(header IN LISTS headers)
    file(READ ${common}/${header} content)
    string(REPLACE "#include \"common/" "#include \"gyre/" content "${content}")
    file(WRITE ${staged}/${header} "${content}")
  endforeach()
endforeach()
file(INSTALL DESTINATION ${include} TYPE DIRECTORY FILES ${staged})
