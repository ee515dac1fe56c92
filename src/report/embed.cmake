# Makes page_template.h: page.html with its style and scripts inside, as a text in C++.
#   cmake -DHTML=page.html -DCSS=page.css -DSCRIPTS=a.js,b.js -DOUTPUT=page_template.h -P embed.cmake
file(READ ${HTML} page)
file(READ ${CSS} style)
string(REPLACE "/*style*/" "${style}" page "${page}")
string(REPLACE "," ";" scripts "${SCRIPTS}")
set(all "")
foreach(script IN LISTS scripts)
  file(READ ${script} text)
  string(APPEND all "${text}")
endforeach()
string(REPLACE "/*scripts*/" "${all}" page "${page}")

# A compiler may limit a literal's length; neighbours are joined.
set(literals "")
string(LENGTH "${page}" length)
set(start 0)
while(start LESS length)
  string(SUBSTRING "${page}" ${start} 8000 piece)
  string(APPEND literals "R\"__page__(${piece})__page__\"\n")
  math(EXPR start "${start} + 8000")
endwhile()
file(WRITE ${OUTPUT} "#pragma once\n#include <string_view>\nnamespace gramloom {\ninline constexpr std::string_view page_template =\n${literals};\n}  // namespace gramloom\n")
