# Writes what core/modules.cpp asks of a module before it opens it: the stamp of its build, then the names of
# all libraries that it brings along, one a line and those first that others need.
#   cmake -DLIBRARY=libgramloom_pictures.so -DSTAMP=build_stamp_value.h -DOUTPUT=libgramloom_pictures.txt
#         -P module_list.cmake
file(READ ${STAMP} stamp)
string(REGEX REPLACE ".*\"(.*)\".*" "\\1" stamp "${stamp}")
execute_process(COMMAND ldd ${LIBRARY} OUTPUT_VARIABLE found ERROR_QUIET)
string(REGEX MATCHALL "[^\t\n]+ => /" lines "${found}")
list(REVERSE lines)  # ldd names a library before what it needs
list(FILTER lines EXCLUDE REGEX gramloom)
list(TRANSFORM lines REPLACE " => /$" "\n")
string(JOIN "" names ${lines})
file(WRITE ${OUTPUT} "${stamp}\n${names}")
