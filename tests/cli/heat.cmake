# The commands of docs/tutorial.md: a part, its mesh, its temperature.
foreach(command
        "${PYTHON}|${EXAMPLES}/make_part.py|${FOLDER}/heat.stl"
        "${PROGRAM}|mesh|${FOLDER}/heat.stl|-o|${FOLDER}/heat.mesh|-q"
        "${PYTHON}|${EXAMPLES}/heat.py|${FOLDER}/heat.mesh")
  string(REPLACE "|" ";" command "${command}")
  execute_process(COMMAND ${command} RESULT_VARIABLE code)
  if(code EQUAL 77)
    return()  # heat.py has said "skipped:"
  elseif(NOT code EQUAL 0)
    message(FATAL_ERROR "exit code ${code}: ${command}")
  endif()
endforeach()
