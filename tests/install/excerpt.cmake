# cmake -DPAGE=file.md -DSOURCE=file -DPART=name -P excerpt.cmake
# Checks that the code in a page is code that is compiled and run: the lines between [name] and [/name] in the source.
file(READ ${SOURCE} text)
if(NOT text MATCHES "\n( *)// \\[${PART}\\]\n(.*)\n *// \\[/${PART}\\]")
    message(FATAL_ERROR "${SOURCE} has no part between [${PART}] and [/${PART}]")
endif()
string(REPLACE "\n${CMAKE_MATCH_1}" "\n" snippet "\n${CMAKE_MATCH_2}")
string(STRIP "${snippet}" snippet)
file(READ ${PAGE} page)
string(FIND "${page}" "${snippet}" position)
if(position EQUAL -1)
    message(FATAL_ERROR "${PAGE} should show this part of ${SOURCE}:\n${snippet}")
endif()
