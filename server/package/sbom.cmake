# Writes the SBOM of one program: SPDX 2.3 in JSON. It lists the program, every Debian package of a linked shared
# library (DT_NEEDED), and the header-only libraries compiled into it.
#   cmake -DPROGRAM=... -DNAME=... -DVERSION=... -DHEADERS=PACKAGE;... -DOUT=... -P sbom.cmake
# SOURCE_DATE_EPOCH, if set, is the time in the SBOM.
cmake_minimum_required(VERSION 3.25)
set(ours Apache-2.0)  # LICENSE

function(run out)
  execute_process(COMMAND ${ARGN} OUTPUT_VARIABLE text ERROR_VARIABLE trouble RESULT_VARIABLE code OUTPUT_STRIP_TRAILING_WHITESPACE)
  if(NOT code EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "SBOM of ${NAME}: '${command}' failed: ${trouble}")
  endif()
  set(${out} "${text}" PARENT_SCOPE)
endfunction()

# The SPDX expression of a package. Fails if its copyright file does not contain the words in licences.txt.
function(licence_of out source package)
  file(STRINGS ${CMAKE_CURRENT_LIST_DIR}/licences.txt lines REGEX "^[^#]")
  foreach(line IN LISTS lines)
    string(REPLACE "\\;" ";" line "${line}")
    if(line MATCHES "^([^;]+); ([^;]+); (.+)$" AND CMAKE_MATCH_1 STREQUAL source)
      set(expression "${CMAKE_MATCH_2}")
      set(words "${CMAKE_MATCH_3}")
      file(READ /usr/share/doc/${package}/copyright copyright)
      string(FIND "${copyright}" "${words}" at)
      if(at EQUAL -1)
        message(FATAL_ERROR "SBOM of ${NAME}: /usr/share/doc/${package}/copyright no longer holds '${words}'; read it and correct licences.txt")
      endif()
      set(${out} "${expression}" PARENT_SCOPE)
      return()
    endif()
  endforeach()
  message(FATAL_ERROR "SBOM of ${NAME}: no licence of '${source}' (package ${package}) in licences.txt; read its copyright file and add a line")
endfunction()

# ---- contents of the program -------------------------------------------------------------------------------------------------
run(dynamic readelf -d ${PROGRAM})
string(REGEX MATCHALL "\\(NEEDED\\)[^\n]*\\[[^]\n]+\\]" needed "${dynamic}")
set(packages)
set(names)
foreach(line IN LISTS needed)
  string(REGEX REPLACE ".*\\[(.*)\\]" "\\1" library "${line}")
  list(APPEND names ${library})
endforeach()
# Uses the file that the loader selects: libraries of other architectures have the same names.
run(loaded ldd ${PROGRAM})
set(patterns)
foreach(library IN LISTS names)
  string(REPLACE "+" "[+]" expression "${library}")
  if(NOT loaded MATCHES "${expression} => [^ \n]*/([^/ \n]+/${expression}) ")
    message(FATAL_ERROR "SBOM of ${NAME}: the loader finds no ${library}")
  endif()
  list(APPEND patterns "*/${CMAKE_MATCH_1}")
endforeach()
run(owners dpkg-query -S ${patterns})
foreach(library pattern IN ZIP_LISTS names patterns)
  string(SUBSTRING "${pattern}" 2 -1 path)
  string(REPLACE "+" "[+]" path "${path}")
  if(NOT "\n${owners}\n" MATCHES "\n([^:\n]+)(:[^ \n]*)?: [^\n]*/${path}\n")
    message(FATAL_ERROR "SBOM of ${NAME}: no Debian package owns ${library}")
  endif()
  list(APPEND packages ${CMAKE_MATCH_1})
  list(APPEND libraries_of_${CMAKE_MATCH_1} ${library})
endforeach()
list(REMOVE_DUPLICATES packages)

# ---- the document --------------------------------------------------------------------------------------------------------
set(entries)
set(relations)
function(add_relation from kind to)
  list(APPEND relations "    {\"spdxElementId\": \"${from}\", \"relationshipType\": \"${kind}\", \"relatedSpdxElement\": \"${to}\"}")
  set(relations "${relations}" PARENT_SCOPE)
endfunction()

set(root SPDXRef-Package-${NAME})
string(APPEND entries "    {
      \"SPDXID\": \"${root}\",
      \"name\": \"${NAME}\",
      \"versionInfo\": \"${VERSION}\",
      \"supplier\": \"Organization: Tandem\",
      \"downloadLocation\": \"NOASSERTION\",
      \"filesAnalyzed\": false,
      \"licenseConcluded\": \"${ours}\",
      \"licenseDeclared\": \"${ours}\",
      \"copyrightText\": \"NOASSERTION\",
      \"primaryPackagePurpose\": \"APPLICATION\"
    }")
add_relation(SPDXRef-DOCUMENT DESCRIBES ${root})

foreach(package IN LISTS packages HEADERS)
  run(facts dpkg-query -W -f "\${Version}|\${source:Package}|\${source:Version}|\${Architecture}|\${Homepage}" ${package})
  string(REGEX MATCH "^([^|]*)[|]([^|]*)[|]([^|]*)[|]([^|]*)[|](.*)$" whole "${facts}")
  set(version "${CMAKE_MATCH_1}")
  set(source "${CMAKE_MATCH_2}")
  set(source_version "${CMAKE_MATCH_3}")
  set(architecture "${CMAKE_MATCH_4}")
  set(homepage "${CMAKE_MATCH_5}")
  licence_of(licence ${source} ${package})
  string(REGEX REPLACE "[^A-Za-z0-9.-]" "-" id "SPDXRef-Package-${package}")
  string(REPLACE "+" "%2B" purl_name "${package}")
  string(REPLACE "+" "%2B" purl_version "${version}")
  string(REPLACE ":" "%3A" purl_version "${purl_version}")
  set(home)
  if(homepage)
    set(home "\n      \"homepage\": \"${homepage}\",")
  endif()
  list(JOIN libraries_of_${package} ", " provides)
  if(NOT provides)
    set(provides "headers, compiled in")
  endif()
  string(APPEND entries ",
    {
      \"SPDXID\": \"${id}\",
      \"name\": \"${package}\",
      \"versionInfo\": \"${version}\",
      \"supplier\": \"Organization: Debian\",
      \"downloadLocation\": \"NOASSERTION\",${home}
      \"sourceInfo\": \"built by Debian from the source package ${source} ${source_version}\",
      \"filesAnalyzed\": false,
      \"licenseConcluded\": \"${licence}\",
      \"licenseDeclared\": \"${licence}\",
      \"copyrightText\": \"NOASSERTION\",
      \"comment\": \"${provides}\",
      \"externalRefs\": [{\"referenceCategory\": \"PACKAGE-MANAGER\", \"referenceType\": \"purl\",
                        \"referenceLocator\": \"pkg:deb/debian/${purl_name}@${purl_version}?arch=${architecture}\"}]
    }")
  if(package IN_LIST packages)
    add_relation(${root} DYNAMIC_LINK ${id})
  else()
    add_relation(${root} STATIC_LINK ${id})
  endif()
endforeach()

string(TIMESTAMP created "%Y-%m-%dT%H:%M:%SZ" UTC)
string(SHA256 content "${entries}${relations}")
string(SUBSTRING "${content}" 0 32 content)
list(JOIN relations ",\n" relations)
file(WRITE ${OUT} "{
  \"spdxVersion\": \"SPDX-2.3\",
  \"dataLicense\": \"CC0-1.0\",
  \"SPDXID\": \"SPDXRef-DOCUMENT\",
  \"name\": \"${NAME}-${VERSION}\",
  \"documentNamespace\": \"https://spdx.org/spdxdocs/${NAME}-${VERSION}-${content}\",
  \"creationInfo\": {
    \"created\": \"${created}\",
    \"creators\": [\"Organization: Tandem\", \"Tool: sbom.cmake\"]
  },
  \"packages\": [
${entries}
  ],
  \"relationships\": [
${relations}
  ]
}
")
