# Fetches the libraries of the report's page, in the versions of package-lock.json:
#   cmake -DNPM=npm -DFOLDER=folder -P fetch_libraries.cmake
execute_process(COMMAND ${NPM} ci --ignore-scripts --prefer-offline --no-audit --no-fund --loglevel=error
                WORKING_DIRECTORY ${FOLDER} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "npm could not fetch the libraries of the report's page (three, uplot, esbuild, typescript).\n"
                      "The first build needs a network or a filled npm cache: check the proxy and the registry "
                      "(npm config get registry), then build again. npm said:\n${output}")
endif()
file(TOUCH ${FOLDER}/node_modules/.package-lock.json)
