# Writes the names of all libraries that LIBRARY brings along, one a line and those first that others
# need, for core/modules.cpp. An empty file does no harm.
#   cmake -DLIBRARY=libgramloom_pictures.so -DOUTPUT=libgramloom_pictures.txt -P leaves_first.cmake
execute_process(COMMAND ldd ${LIBRARY} OUTPUT_VARIABLE found ERROR_QUIET)
string(REGEX MATCHALL "[^\t\n]+ => /" lines "${found}")
list(REVERSE lines)  # ldd names a library before what it needs
list(FILTER lines EXCLUDE REGEX gramloom)
list(TRANSFORM lines REPLACE " => /$" "\n")
string(JOIN "" names ${lines})
file(WRITE ${OUTPUT} "${names}")
