# The templates of a folder as C:
#   cmake -D "FILES=plots/*.gp" -D NAME=zp_templates -D OUTPUT=templates.c -P scripts/embed-templates.cmake
file(GLOB files ${FILES})
list(SORT files)
set(texts)
set(rows)
set(number 0)
foreach(file ${files})
  get_filename_component(name ${file} NAME)
  file(READ ${file} bytes HEX)
  string(REGEX REPLACE "(..)" "0x\\1," bytes "${bytes}")
  string(REGEX REPLACE "((0x..,){24})" "\\1\n" bytes "${bytes}")
  string(APPEND texts "static const unsigned char text_${number}[] = {\n${bytes}0};\n")
  string(APPEND rows "  {\"${name}\", (const char *)text_${number}},\n")
  math(EXPR number "${number} + 1")
endforeach()
file(WRITE ${OUTPUT} "/* Made by scripts/embed-templates.cmake. */\n#include \"io/drawing.h\"\n\n${texts}\n"
                     "extern const ZpTemplate ${NAME}[];\nconst ZpTemplate ${NAME}[] = {\n${rows}  {0},\n};\n")
