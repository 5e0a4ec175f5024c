# Answers every find_package: whoever asks for more than the mechanics need is refused, though it may be installed.
macro(gyre_only_mechanics method package)
  if(NOT "${package}" MATCHES "^(gyre|Eigen3|Boost|boost_headers)$")
    message(FATAL_ERROR "${package} is asked for, and the mechanics stand on Eigen and Boost alone")
  endif()
endmacro()
cmake_language(SET_DEPENDENCY_PROVIDER gyre_only_mechanics SUPPORTED_METHODS FIND_PACKAGE)
