# Flags that every target shares, and the helpers by which a room becomes a target.

set(CMAKE_CXX_STANDARD 23)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
set(CMAKE_LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/lib)
# A tool finds its plug-in (images) beside itself, wherever the tree is moved to.
set(CMAKE_BUILD_RPATH "$ORIGIN/../lib")
set(CMAKE_INSTALL_RPATH "$ORIGIN/../lib/copse")

option(COPSE_TESTS "build the tests" ON)
option(COPSE_BENCH "build the benchmarks" OFF)
option(COPSE_FUZZ "build the libFuzzer targets (clang)" OFF)
set(COPSE_SANITIZE "" CACHE STRING "sanitizers, comma separated: address,undefined or thread")

find_program(CCACHE ccache)
if(CCACHE)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE})
endif()

add_library(copse_flags INTERFACE)
target_compile_options(copse_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Werror
  # The same bytes on every machine: no contraction into fused multiply-add, no fast-math.
  -ffp-contract=off)
target_include_directories(copse_flags INTERFACE ${PROJECT_SOURCE_DIR})
target_compile_definitions(copse_flags INTERFACE COPSE_VERSION="${PROJECT_VERSION}")
if(COPSE_SANITIZE)
  # GCC takes what the sanitizers add for reads of uninitialised memory (GCC bug 105562).
  target_compile_options(copse_flags INTERFACE -fsanitize=${COPSE_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all
    $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
  target_link_options(copse_flags INTERFACE -fsanitize=${COPSE_SANITIZE})
endif()

# copse_library(NAME [LINK libraries shown in headers] [PRIVATE libraries hidden inside .cpp files])
# makes a static library of every .cpp in the folder.
function(copse_library name)
  cmake_parse_arguments(ARG "" "" "LINK;PRIVATE" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS *.cpp)
  if(NOT sources)
    add_library(${name} INTERFACE)
    target_link_libraries(${name} INTERFACE copse_flags ${ARG_LINK})
    return()
  endif()
  add_library(${name} STATIC ${sources})
  target_link_libraries(${name} PUBLIC copse_flags ${ARG_LINK} PRIVATE ${ARG_PRIVATE})
endfunction()

# copse_tool(NAME [LINK libraries]) makes a program of every .cpp in the folder.
function(copse_tool name)
  cmake_parse_arguments(ARG "" "" "LINK" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS *.cpp)
  if(sources)
    add_executable(${name} ${sources})
    target_link_libraries(${name} PRIVATE copse_tool_common ${ARG_LINK})
  endif()
endfunction()

# copse_tests(ROOM [LINK libraries]) makes one GoogleTest program of every .cpp in the folder.
function(copse_tests room)
  cmake_parse_arguments(ARG "" "" "LINK" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${room}/*.cpp)
  if(NOT sources)
    return()
  endif()
  add_executable(test_${room} ${sources})
  target_link_libraries(test_${room} PRIVATE ${ARG_LINK} copse_flags GTest::gtest_main GTest::gmock Threads::Threads)
  target_compile_definitions(test_${room} PRIVATE
    COPSE_SOURCE_DIR="${PROJECT_SOURCE_DIR}" COPSE_BIN_DIR="${PROJECT_BINARY_DIR}/bin")
  set(environment)
  if(COPSE_SANITIZE)
    # What is under test is optimised as ever; the tests' own code is half of the build, and only called once.
    target_compile_options(test_${room} PRIVATE -O1 -g1)
    # The leak checker misreads the thread-local blocks of glibc 2.36 that it follows, and dies of it. A leak of
    # OpenImageIO's is only told by callers behind libstdc++, which has no frame pointers: it is unwound in full.
    set(asan intercept_tls_get_addr=0)
    if(room STREQUAL import)
      string(APPEND asan :fast_unwind_on_malloc=0)
    endif()
    set(environment ENVIRONMENT LSAN_OPTIONS=suppressions=${PROJECT_SOURCE_DIR}/cmake/leaks.supp:print_suppressions=0
                    ENVIRONMENT_MODIFICATION ASAN_OPTIONS=set:${asan})
  endif()
  gtest_discover_tests(test_${room} TEST_PREFIX ${room}. DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 300 ${environment})
endfunction()
