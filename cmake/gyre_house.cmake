# The house rules as build settings. Our own code is held to them; third-party headers are SYSTEM and are not.

add_library(gyre_house INTERFACE)
target_compile_options(gyre_house INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wnon-virtual-dtor -Werror)
target_include_directories(gyre_house INTERFACE ${CMAKE_SOURCE_DIR})
# Debian 13's Fast CDR defines it for those who use it, whom headers precompiled without it would not fit.
target_compile_definitions(gyre_house INTERFACE _FILE_OFFSET_BITS=64)
# GCC sees uninitialised members in what the sanitizers put into an optional, and since 13 in an optional that is empty;
# with Debian 12's, and without them, the warning holds.
if(CMAKE_CXX_FLAGS MATCHES "-fsanitize" OR CMAKE_CXX_COMPILER_VERSION VERSION_GREATER_EQUAL 13)
  target_compile_options(gyre_house INTERFACE -Wno-maybe-uninitialized)
endif()

# What nearly every source of ours parses, compiled once for all: half of a build was parsing it again and again. Sources
# include what they use all the same: clang-tidy and the embedding test read them without this.
file(WRITE ${CMAKE_BINARY_DIR}/empty.cpp "")
function(gyre_precompiled name)
  cmake_parse_arguments(arg "" "" "HEADERS;USES" ${ARGN})
  add_library(${name} OBJECT ${CMAKE_BINARY_DIR}/empty.cpp)
  target_link_libraries(${name} PRIVATE ${arg_USES} gyre_house)
  target_precompile_headers(${name} PRIVATE ${arg_HEADERS})
endfunction()
set(gyre_common_headers <algorithm> <array> <chrono> <cmath> <cstdint> <cstdio> <deque> <functional> <map> <memory>
    <optional> <string> <utility> <variant> <vector> <Eigen/Core> <Eigen/Geometry>)
gyre_precompiled(gyre_headers HEADERS ${gyre_common_headers} USES Eigen3::Eigen)
if(GYRE_TESTS)
  gyre_precompiled(gyre_test_headers
    HEADERS ${gyre_common_headers} <fstream> <sstream> <gmock/gmock.h> <gtest/gtest.h> <rapidcheck.h> <rapidcheck/gtest.h>
    USES Eigen3::Eigen GTest::gmock rapidcheck rapidcheck_gtest)
endif()

# gyre_library(NAME SOURCES... [USES...] [PRIVATELY...]): a static library of our own code. USES are its public
# dependencies; what it uses PRIVATELY its headers do not mention.
function(gyre_library name)
  cmake_parse_arguments(arg "" "" "SOURCES;USES;PRIVATELY" ${ARGN})
  if(arg_SOURCES)
    add_library(${name} STATIC ${arg_SOURCES})
    target_link_libraries(${name} PUBLIC ${arg_USES} PRIVATE ${arg_PRIVATELY} $<BUILD_INTERFACE:gyre_house>)
    target_include_directories(${name} PUBLIC $<BUILD_INTERFACE:${CMAKE_SOURCE_DIR}>)
    target_compile_features(${name} PUBLIC cxx_std_17)
    target_precompile_headers(${name} REUSE_FROM gyre_headers)
  else()
    add_library(${name} INTERFACE)
    target_link_libraries(${name} INTERFACE ${arg_USES})
    target_include_directories(${name} INTERFACE ${CMAKE_SOURCE_DIR})
  endif()
endfunction()

# gyre_executable(NAME SOURCES... USES...): a program, in build/bin.
function(gyre_executable name)
  cmake_parse_arguments(arg "" "" "SOURCES;USES" ${ARGN})
  add_executable(${name} ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE ${arg_USES} gyre_house)
  target_precompile_headers(${name} REUSE_FROM gyre_headers)
endfunction()

# gyre_test(NAME SOURCES... USES... [TIMEOUT s]): a GoogleTest program, one ctest entry per program.
# Its room, the folder's name under tests/, is its label: `ctest -L mechanics`.
function(gyre_test name)
  cmake_parse_arguments(arg "" "TIMEOUT" "SOURCES;USES" ${ARGN})
  add_executable(${name} ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE ${arg_USES} gyre_test_places gyre_house GTest::gmock GTest::gtest_main)
  target_precompile_headers(${name} REUSE_FROM gyre_test_headers)
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
  add_test(NAME ${name} COMMAND ${name})
  if(NOT arg_TIMEOUT)
    set(arg_TIMEOUT 300)  # twenty seconds, under a sanitizer and beside others
  endif()
  file(RELATIVE_PATH room ${CMAKE_SOURCE_DIR}/tests ${CMAKE_CURRENT_SOURCE_DIR})
  set_tests_properties(${name} PROPERTIES TIMEOUT ${arg_TIMEOUT} LABELS ${room})
  if(room STREQUAL "dds")
    set_tests_properties(${name} PROPERTIES RUN_SERIAL ON)  # real time on few cores: alone on the machine
  endif()
endfunction()

# gyre_benchmark(NAME SOURCES... USES...): a program that prints its table, in build/bench; `./tests/run --bench` runs it.
function(gyre_benchmark name)
  cmake_parse_arguments(arg "" "" "SOURCES;USES" ${ARGN})
  add_executable(${name} ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE ${arg_USES} gyre_test_places gyre_house)
  target_precompile_headers(${name} REUSE_FROM gyre_headers)
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bench)
endfunction()
