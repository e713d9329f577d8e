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
string(REPLACE "<!--style-->" "<style>${style}</style>" page "${page}")
string(REPLACE "<!--script-->" "<script>${script}</script>" page "${page}")
file(WRITE ${OUTPUT} "${page}")
