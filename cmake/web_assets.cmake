# Embeds text files in the program: what is inlined into a report must be there without the sources.

# zrobench_web_assets(OUTPUT VARIABLE FILE ...): a C++ source that defines web::VARIABLE for each FILE.
function(zrobench_web_assets output)
  set(source "#include \"rig/report/web_assets.h\"\n\nnamespace zrobench::web {\n\n")
  while(ARGN)
    list(POP_FRONT ARGN variable file)
    file(READ ${file} text)
    string(REGEX REPLACE "/[/*]# sourceMappingURL=[^\n]*" "" text "${text}")  # else asked for
    string(APPEND source "const std::string_view ${variable} = R\"zrobench(${text})zrobench\";\n")
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
  endwhile()
  string(APPEND source "\n}  // namespace zrobench::web\n")
  file(CONFIGURE OUTPUT ${output} CONTENT "@source@" @ONLY)
endfunction()
