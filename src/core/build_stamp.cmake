# Writes OUTPUT, a header with the stamp of a build: the hash of all headers in FOLDERS of SOURCE, and of what
# else the layout of their types hangs on (WITH: the compiler, its sanitizers, LibTorch). A stamp that is the
# same leaves the file as it is: then nothing is built anew.
#   cmake -DSOURCE=src -DFOLDERS=core,io -DWITH="GNU 12" -DOUTPUT=build_stamp_value.h -P build_stamp.cmake
string(REPLACE "," ";" folders "${FOLDERS}")
list(TRANSFORM folders REPLACE "(.+)" "${SOURCE}/\\1/*.h")
file(GLOB_RECURSE headers ${folders})
set(all "${WITH}")
foreach(header ${headers})
  file(SHA256 ${header} hash)
  string(APPEND all "\n${hash}")
endforeach()
string(SHA256 stamp "${all}")
string(SUBSTRING ${stamp} 0 12 stamp)
set(text "#define GRAMLOOM_BUILD_STAMP \"${stamp}\"\n")
set(before "")
if(EXISTS ${OUTPUT})
  file(READ ${OUTPUT} before)
endif()
if(NOT before STREQUAL text)
  file(WRITE ${OUTPUT} "${text}")
endif()
