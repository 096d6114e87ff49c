# Flags and target helpers shared by all folders.
#
# -ffp-contract=off: the same integer deposit gave other bits when the compiler fused a*b+c in one inlining and
# not in another; with it off the traced path is the same arithmetic everywhere.
# -fno-math-errno: lets sqrt and rounding compile to instructions instead of library calls. Neither changes a value.
# Command lines and tests only call what works hard, and most of their code runs once: a target with the property
# LUCARNE_RUNS_ONCE compiles in two thirds of the time.
add_library(lucarne_flags INTERFACE)
target_compile_options(lucarne_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Wold-style-cast -Wcast-align -Woverloaded-virtual
  -ffp-contract=off -fno-math-errno $<$<CONFIG:Release>:$<IF:$<BOOL:$<TARGET_PROPERTY:LUCARNE_RUNS_ONCE>>,-O1,-O3>>
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>)  # GCC 12 warns of std::string's own operator+ (its bug 105651)
# SSE4.2 multiplies four 32-bit words at once, which the baseline of x86-64 must imitate; every processor since 2009 has it.
# It changes no value. (v3 would bring fused multiply-adds, which contraction, off above, must not make.)
set(LUCARNE_X86_LEVEL v2 CACHE STRING "Level of x86-64 to compile for: v2, v3, … as in -march=x86-64-v2; empty: the compiler's choice")
if(LUCARNE_X86_LEVEL AND CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64)$")
  target_compile_options(lucarne_flags INTERFACE -march=x86-64-${LUCARNE_X86_LEVEL})
endif()
if(LUCARNE_WERROR)
  target_compile_options(lucarne_flags INTERFACE -Werror)
endif()
if(LUCARNE_SANITIZE)
  target_compile_options(lucarne_flags INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(lucarne_flags INTERFACE -fsanitize=address,undefined)
endif()

# What many files include takes longer to read than the files themselves: it is compiled once for the libraries that
# use JSON throughout and once for all tests (executables differ from libraries in the kind of their
# position-independent code). Every file still includes what it uses.
set(LUCARNE_COMMON_HEADERS <algorithm> <array> <cmath> <cstdint> <filesystem> <fstream> <functional> <map> <memory>
    <optional> <random> <span> <sstream> <string> <vector> <nlohmann/json.hpp>)
if(LUCARNE_CCACHE AND CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  target_compile_options(lucarne_flags INTERFACE -fpch-preprocess)  # ccache needs it to know what is in there
endif()

file(WRITE "${PROJECT_BINARY_DIR}/common_headers.cpp.new" "// Holds the compiled headers of the libraries.\n")
file(COPY_FILE "${PROJECT_BINARY_DIR}/common_headers.cpp.new" "${PROJECT_BINARY_DIR}/common_headers.cpp" ONLY_IF_DIFFERENT)
add_library(lucarne_common_headers OBJECT "${PROJECT_BINARY_DIR}/common_headers.cpp")
target_link_libraries(lucarne_common_headers PRIVATE lucarne_flags)
target_precompile_headers(lucarne_common_headers PRIVATE ${LUCARNE_COMMON_HEADERS})

# Reading headers is most of the time that a file takes: several are compiled as one. What a test names for itself lies
# in a namespace of its file's name, so that the names of several do not meet.
function(lucarne_compile_together target)
  if(LUCARNE_UNITY)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 8)
    target_compile_options(${target} PRIVATE -Wno-subobject-linkage)  # of classes in what is then no main file
  endif()
endfunction()

# lucarne_library(NAME): a static library of every .cpp below the current folder, target lucarne::NAME, headers
# included as "NAME/file.h" and installed under include/lucarne/NAME. EXCLUDE REGEX leaves sources out; PRECOMPILED
# takes the common headers.
function(lucarne_library name)
  cmake_parse_arguments(arg "PRECOMPILED" "EXCLUDE" "" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/*.cpp")
  if(arg_EXCLUDE)
    list(FILTER sources EXCLUDE REGEX "${arg_EXCLUDE}")
  endif()
  add_library(lucarne_${name} STATIC ${sources})
  add_library(lucarne::${name} ALIAS lucarne_${name})
  lucarne_compile_together(lucarne_${name})
  set_target_properties(lucarne_${name} PROPERTIES EXPORT_NAME ${name})
  target_include_directories(lucarne_${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
                                                    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/lucarne>)
  target_link_libraries(lucarne_${name} PRIVATE $<BUILD_INTERFACE:lucarne_flags>)
  if(arg_PRECOMPILED)
    target_precompile_headers(lucarne_${name} REUSE_FROM lucarne_common_headers)
  endif()
  install(TARGETS lucarne_${name} ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(DIRECTORY "${CMAKE_CURRENT_SOURCE_DIR}/" DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/lucarne/${name}
          FILES_MATCHING PATTERN "*.h")
endfunction()

# Half of the time that a sanitized build takes goes into tests, whose own code is not what is examined: given the
# folder of another build of the same sources, their objects are taken from there and only linked anew.
set(LUCARNE_TEST_OBJECTS "" CACHE PATH "Build folder to take the compiled tests from; empty: compile them")

# lucarne_test_sources(VARIABLE NAME): every .cpp in tests/NAME, or its objects in the other build.
function(lucarne_test_sources variable name)
  if(LUCARNE_TEST_OBJECTS)
    file(STRINGS "${LUCARNE_TEST_OBJECTS}/tests/test_${name}.objects" sources)
    set_source_files_properties(${sources} PROPERTIES EXTERNAL_OBJECT TRUE GENERATED TRUE)
  else()
    file(GLOB_RECURSE sources CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/${name}/*.cpp")
  endif()
  set(${variable} ${sources} PARENT_SCOPE)
endfunction()

# All tests of a build share what the first of them has compiled.
function(lucarne_precompile_test_headers target)
  get_property(first GLOBAL PROPERTY LUCARNE_PRECOMPILED_TEST)
  if(first)
    target_precompile_headers(${target} REUSE_FROM ${first})
  else()
    target_precompile_headers(${target} PRIVATE ${LUCARNE_COMMON_HEADERS} <gtest/gtest.h> <gmock/gmock.h>)
    set_property(GLOBAL PROPERTY LUCARNE_PRECOMPILED_TEST ${target})
  endif()
endfunction()

# lucarne_test(NAME LIBS… [ENVIRONMENT VAR=VALUE]): one GoogleTest program of every .cpp in tests/NAME, its cases known to
# CTest one by one.
function(lucarne_test name)
  cmake_parse_arguments(arg "" "ENVIRONMENT" "" ${ARGN})
  lucarne_test_sources(sources ${name})
  if(NOT sources)
    return()
  endif()
  add_executable(test_${name} ${sources})
  set_target_properties(test_${name} PROPERTIES LUCARNE_RUNS_ONCE ON LINKER_LANGUAGE CXX)
  target_include_directories(test_${name} PRIVATE ${PROJECT_SOURCE_DIR})
  target_link_libraries(test_${name} PRIVATE lucarne_flags ${arg_UNPARSED_ARGUMENTS} GTest::gmock GTest::gtest_main)
  target_compile_definitions(test_${name} PRIVATE LUCARNE_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  if(NOT LUCARNE_TEST_OBJECTS)
    lucarne_precompile_test_headers(test_${name})
    lucarne_compile_together(test_${name})
    # What a build that links the same objects must name.
    file(GENERATE OUTPUT "${CMAKE_CURRENT_BINARY_DIR}/test_${name}.objects" CONTENT "$<JOIN:$<TARGET_OBJECTS:test_${name}>,\n>\n")
  endif()
  gtest_discover_tests(test_${name} TEST_PREFIX "${name}/" DISCOVERY_TIMEOUT 120
                       PROPERTIES TIMEOUT 900 ENVIRONMENT "${arg_ENVIRONMENT}")
endfunction()
