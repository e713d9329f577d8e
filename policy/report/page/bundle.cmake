# Makes the page one file: page.html with its style and its script in it, which esbuild bundles of source/ and Debian's libraries.
# usage: cmake -D ESBUILD=... -D LIBRARIES=/usr/share/javascript -D PAGE=policy/report/page -D OUTPUT=page.html -P bundle.cmake
get_filename_component(folder ${OUTPUT} DIRECTORY)
set(ENV{NODE_PATH} ${LIBRARIES})
execute_process(
  COMMAND ${ESBUILD} ${PAGE}/source/main.ts --bundle --minify --target=es2021 --charset=utf8 --legal-comments=inline --log-level=warning
          --loader:.png=dataurl --alias:chart.js=${LIBRARIES}/chart.js/chart.mjs --outdir=${folder}/bundle
  COMMAND_ERROR_IS_FATAL ANY)
file(READ ${PAGE}/page.html page)
file(READ ${folder}/bundle/main.css style)
file(READ ${folder}/bundle/main.js script)
if(script MATCHES "</script")
  message(FATAL_ERROR "the bundled script would end its own element")
endif()
# Leaflet's attribution, which the page does not show, would be the one link to another computer.
string(REGEX REPLACE "<a href=\"https://leafletjs[^>]*>Leaflet</a>" "Leaflet" script "${script}")
# The browser runs the script of this hash and no other, whatever a flight's text brings with it. The policy wants it in base64: four letters of six bits for three
# bytes, the last two bytes and a zero giving three letters and "=".
string(SHA256 left "${script}")
string(APPEND left "00")
set(letters ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/)
set(hash "")
while(left)
  string(SUBSTRING "${left}" 0 6 three)
  string(SUBSTRING "${left}" 6 -1 left)
  foreach(shift 18 12 6 0)
    math(EXPR index "(0x${three} >> ${shift}) & 63")
    string(SUBSTRING ${letters} ${index} 1 letter)
    string(APPEND hash ${letter})
  endforeach()
endwhile()
string(REGEX REPLACE ".$" "=" hash ${hash})
string(REPLACE "script-src 'unsafe-inline'" "script-src 'sha256-${hash}'" page "${page}")
string(REPLACE "<!--style-->" "<style>${style}</style>" page "${page}")
string(REPLACE "<!--script-->" "<script>${script}</script>" page "${page}")
file(WRITE ${OUTPUT} "${page}")
