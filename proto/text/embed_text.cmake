# cmake -DOUT=FILE -DFILES=a;b -P embed_text.cmake: writes a table {name, text} of text files as C++ raw strings. Some
# compilers limit a raw string to 64 KiB; scenes are far below that.
set(table "")
foreach(file ${FILES})
  get_filename_component(name ${file} NAME_WE)
  file(READ ${file} text)
  string(APPEND table "{\"${name}\", R\"~scene~(${text})~scene~\"},\n")
endforeach()
file(WRITE ${OUT} "${table}")
