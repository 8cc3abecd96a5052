# cmake -DOUT=FILE -DFILES=a;b -P embed_text.cmake: a table of {name, text} of text files as C++ raw strings.
# A raw string may be at most 64 KiB long in some compilers; scenes are far below.
set(table "")
foreach(file ${FILES})
  get_filename_component(name ${file} NAME_WE)
  file(READ ${file} text)
  string(APPEND table "{\"${name}\", {}, R\"~scene~(${text})~scene~\"},\n")
endforeach()
file(WRITE ${OUT} "${table}")
