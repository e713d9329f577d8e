# For tests that something does not compile: a header is changed in a copy, which stands before the tree's own. Included by a script that is given
#   -D ROOT=<checkout> -D COMPILER=<C++ compiler> -D FOLDER=<to work in>
# and sets `source`, what is compiled. It must compile as it is.

function(compile_with_scratch RESULT OUTPUT)
  execute_process(COMMAND ${COMPILER} -std=c++20 -fsyntax-only -I ${FOLDER} -I ${ROOT} ${source} RESULT_VARIABLE result ERROR_VARIABLE output)
  set(${RESULT} "${result}" PARENT_SCOPE)
  set(${OUTPUT} "${output}" PARENT_SCOPE)
endfunction()

# expect_refused(HEADER BEFORE AFTER REASON): with AFTER in place of BEFORE in the header it does not compile, and the compiler's words match REASON.
function(expect_refused HEADER BEFORE AFTER REASON)
  file(READ ${ROOT}/${HEADER} text)
  string(REPLACE "${BEFORE}" "${AFTER}" changed "${text}")
  if(changed STREQUAL text)
    message(FATAL_ERROR "${HEADER} has no ${BEFORE} by now")
  endif()
  file(REMOVE_RECURSE ${FOLDER})
  file(WRITE ${FOLDER}/${HEADER} "${changed}")
  compile_with_scratch(result output)
  if(result EQUAL 0)
    message(FATAL_ERROR "${HEADER} compiles with \"${AFTER}\" in place of \"${BEFORE}\"")
  elseif(NOT output MATCHES "${REASON}")
    message(FATAL_ERROR "${HEADER} with \"${AFTER}\" in place of \"${BEFORE}\" does not compile, but not for ${REASON}:\n${output}")
  endif()
endfunction()

file(REMOVE_RECURSE ${FOLDER})
compile_with_scratch(result output)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "${source} as it is does not compile:\n${output}")
endif()
