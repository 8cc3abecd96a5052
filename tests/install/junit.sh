# shellcheck shell=bash
# Reads the results of ctest, for ./test.

# Reads ctest's JUnit file. Prints "passed NAME", "failed NAME" and "skipped NAME: REASON" lines. Prints "note TEXT" for a
# part that a test could not run on this machine: the test reports it with a line "[ NOT RUN ] TEXT".
read_junit() {  # file
  awk '
    function attribute(name,   s) {
      s = $0
      if (!sub(".* " name "=\"", "", s)) return ""
      sub("\".*", "", s)
      return plain(s)
    }
    function plain(s) {
      gsub(/&lt;/, "<", s); gsub(/&gt;/, ">", s); gsub(/&quot;/, "\"", s); gsub(/&apos;/, "\047", s)
      gsub(/&amp;/, "\\&", s)
      return s
    }
    /<testcase / {
      name = attribute("name"); status = attribute("status"); skipped = 0; why = ""; follows = 0
      if (status == "run") print "passed " name
      else if (status == "fail") print "failed " name
    }
    /<skipped / && status != "run" && status != "fail" {
      if (attribute("message") ~ /SKIP|Disabled/) skipped = 1; else print "failed " name
    }
    # GoogleTest prints the source location, then the reason on the next line.
    follows { why = plain($0); follows = 0 }
    /: Skipped$/ { follows = 1 }
    /^(.*<system-out>)?\[ NOT RUN +\] / {
      s = $0; sub(/.*\[ NOT RUN +\] /, "", s); sub(/<\/system-out>.*/, "", s)
      if (skipped) why = plain(s); else print "note " plain(s)
    }
    /<\/testcase>/ && skipped { print "skipped " name (why == "" ? "" : ": " why) }
  ' "$1"
}

# Reads the log that ctest writes while it runs, which is all that an interrupted ctest leaves. Prints "passed", "failed"
# or "skipped" for each test that has ended. The log calls skipped tests, and those without a program, passed.
read_log() {  # file
  awk '
    $0 == "Command: \"\"" { missing = 1 }
    # A script that exits with SKIP_RETURN_CODE says why in its last line.
    $0 == "<end of output>" && last ~ /^\[ NOT RUN +\] / { skipped = 1 }
    /^Test (Passed\.|Failed\.|Pass Reason:|Fail Reason:)$/ && last ~ /^-+$/ && before ~ /^Test time = / {
      failed = missing || /Fail/
      if (/Reason/) { getline; if (/^Skip regular expression/) skipped = 1 }
      print (failed ? "failed" : skipped ? "skipped" : "passed")
      missing = skipped = 0
    }
    { before = last; last = $0 }
  ' "$1"
}
