# gramloom_public_headers(OUTPUT FOLDER...): the headers of src/FOLDERs, relative to src, that show nothing
# of a large library: neither they nor those that they include. What others build with them needs only
# what gramloomConfig.cmake looks for.
function(gramloom_public_headers output)
  set(source ${PROJECT_SOURCE_DIR}/src)
  list(TRANSFORM ARGN PREPEND ${source}/ OUTPUT_VARIABLE patterns)
  list(TRANSFORM patterns APPEND /*.h)
  file(GLOB_RECURSE public CONFIGURE_DEPENDS RELATIVE ${source} ${patterns})
  foreach(header ${public})
    file(STRINGS ${source}/${header} includes_of_${header} REGEX "^#include")
  endforeach()

  set(hidden "<(ATen|torch|c10|oneapi|OpenImageIO|embree[34])/")
  set(found TRUE)
  while(found)  # those that include one found last
    set(found)
    foreach(header ${public})
      if("${includes_of_${header}}" MATCHES "${hidden}")
        list(APPEND found ${header})
      endif()
    endforeach()
    list(REMOVE_ITEM public ${found})
    list(JOIN found "|" hidden)
    string(REPLACE "." "[.]" hidden "\"(${hidden})\"")
  endwhile()
  set(${output} ${public} PARENT_SCOPE)
endfunction()
