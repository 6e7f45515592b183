# Writes a C++ source that holds a text file: cmake -DFROM=file -DTO=file.cpp -P embed.cmake
# Pieces of a raw string each, since compilers limit the length of one.
file(READ "${FROM}" text)
string(LENGTH "${text}" length)
set(source "#include \"view/embedded.h\"\n\nnamespace holdfast::view {\n\nstd::string_view page_template() {\n  static constexpr char kText[] =\n")
set(at 0)
while(at LESS length)
  string(SUBSTRING "${text}" ${at} 8000 piece)
  string(APPEND source "R\"embedded(${piece})embedded\"\n")
  math(EXPR at "${at} + 8000")
endwhile()
string(APPEND source ";\n  return {kText, sizeof kText - 1};\n}\n\n}  // namespace holdfast::view\n")
file(WRITE "${TO}" "${source}")
