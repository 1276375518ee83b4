# cmake -DBUILD=<build dir> -DSOURCE=<source dir> -DCOMPILER=... -DFLAGS=... -DTYPE=... -P install.cmake
# What a packager and a stranger do: install, move the prefix, draw with the installed program, find_package
# from another project and draw from C++.
cmake_minimum_required(VERSION 3.25)
set(work ${BUILD}/consumer)
set(prefix "${work}/moved here")
file(REMOVE_RECURSE ${work})

function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    list(JOIN ARGV " " command)
    message(FATAL_ERROR "${command}: ${result}\n${output}")
  endif()
endfunction()

run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${work}/prefix)
file(RENAME ${work}/prefix "${prefix}")

run("${prefix}/bin/dstylize" ${SOURCE}/samples/stone.png ${work}/stone.png --style ink --detail 200)
if(NOT EXISTS ${work}/stone.png)
  message(FATAL_ERROR "the installed program drew nothing")
endif()
foreach(file share/dstylize/styles/vine.toml share/man/man1/dstylize.1 share/bash-completion/completions/dstylize)
  if(NOT EXISTS "${prefix}/${file}")
    message(FATAL_ERROR "${file} is not installed")
  endif()
endforeach()

run(${CMAKE_COMMAND} -G Ninja -S ${SOURCE}/tests/consumer -B ${work}/build "-DCMAKE_PREFIX_PATH=${prefix}"
    -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_CXX_FLAGS=${FLAGS} -DCMAKE_BUILD_TYPE=${TYPE})
run(${CMAKE_COMMAND} --build ${work}/build)
run(${work}/build/consumer)
