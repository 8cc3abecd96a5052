# Writes OUT, a C++ source with the files below FOLDER as gzip bytes: cmake -DFOLDER=... -DOUT=... -P embed.cmake
file(GLOB_RECURSE files RELATIVE ${FOLDER} ${FOLDER}/*)
list(SORT files)
set(arrays "")
set(rows "")
set(count 0)
foreach(name ${files})
  execute_process(COMMAND gzip --best --no-name --stdout ${FOLDER}/${name} OUTPUT_FILE ${OUT}.gz COMMAND_ERROR_IS_FATAL ANY)
  file(READ ${OUT}.gz bytes HEX)
  string(REGEX REPLACE "(..)" "\\\\x\\1" bytes "${bytes}")
  file(SHA256 ${FOLDER}/${name} digest)
  string(SUBSTRING ${digest} 0 32 digest)
  set(type "application/octet-stream")
  foreach(pair "html=text/html; charset=utf-8" "js=text/javascript" "css=text/css" "svg=image/svg+xml" "json=application/json" "png=image/png" "woff2=font/woff2")
    string(REGEX MATCH "^([a-z0-9]+)=(.*)$" matched "${pair}")
    string(REGEX MATCH "\\.${CMAKE_MATCH_1}$" ends "${name}")
    if(ends)
      string(REGEX REPLACE "^[a-z0-9]+=" "" type "${pair}")
    endif()
  endforeach()
  set(target "/${name}")
  if(name STREQUAL "index.html")
    set(target "/")
  endif()
  string(APPEND arrays "constexpr char kBytes${count}[] = \"${bytes}\";\n")
  string(APPEND rows "    {\"${target}\", \"${type}\", \"\\\"${digest}\\\"\", {kBytes${count}, sizeof kBytes${count} - 1}},\n")
  math(EXPR count "${count} + 1")
endforeach()
file(REMOVE ${OUT}.gz)
file(WRITE ${OUT} "#include \"server/console/app/page_files.h\"

namespace tandem::console {
namespace {

${arrays}
constexpr PageFile kFiles[] = {
${rows}};

}  // namespace

std::span<const PageFile> page_files() noexcept { return kFiles; }

}  // namespace tandem::console
")
