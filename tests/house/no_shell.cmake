# cmake -DSRC=<src dir> -P no_shell.cmake
# Fails when a source calls what starts a shell, or could fall back on one: a file's name could be a command there.
cmake_minimum_required(VERSION 3.25)
set(files_seen 0)
file(GLOB_RECURSE files "${SRC}/*.h" "${SRC}/*.cpp")
foreach(file IN LISTS files)
  math(EXPR files_seen "${files_seen} + 1")
  file(STRINGS "${file}" calls
    REGEX "(^|[^A-Za-z0-9_.>])(system|popen|wordexp|execlp|execvp|execvpe) *\\(")
  if(calls)
    message(SEND_ERROR "${file}: may start a shell: ${calls}")
  endif()
endforeach()
if(files_seen LESS 20)
  message(FATAL_ERROR "only ${files_seen} files found below ${SRC}: is SRC right?")
endif()
