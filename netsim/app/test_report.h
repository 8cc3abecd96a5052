#pragma once

#include <string>

#include "netsim/app/test_run.h"

namespace tandem::netsim {

/// Returns the report for a terminal: scenarios by seeds, the worst value of each limit, and for each failure its
/// causes and the command that replays it.
[[nodiscard]] std::string test_summary(const TestResult& result);

/// Returns the report as JSON. Equal seeds and build give equal bytes, except for the keys called `cpu_s`. A number
/// that a run does not have is null.
/// {"version": 1, "verdict": "pass"|"fail", "interrupted": bool, "seeds_run": n, "seeds_failed": n,
///  "seeds_not_run": n, "cpu_s": s,
///  "recordings": {"folder", "written": n, "left_out": n}, with --record-failures only, "scenarios":
///  [{"name", "file", "summary", "scene", "network", "seat_networks": [{"seat", "network"}], "duration_s", "verdict",
///    "cpu_s", "notes": [text, about the networks],
///    "limits": [{"subject", "metric", "unit", "min"|null, "max"|null, "worst": value|null, "worst_seed"|null,
///                "margin_percent"|null}],
///    "seeds": [{"seed", "verdict": "pass"|"fail"|"trouble"|"crash"|"not run", "causes": [text],
///               "values": [number|null, one per limit],
///               "violations": [{"invariant", "seat", "at_s", "expected", "count"}],
///               "network": [{"seat", "band": "green"|"amber"|"red"|"too short"}], "notes": [text], "duration_s",
///               "trace_hash", "cpu_s", "replay": command, "report": {...} on request,
///               "recording": file, if there is one, "recording_problem": text, if there is one}]}]}
[[nodiscard]] std::string test_json(const TestResult& result);

/// Returns JUnit XML for CI servers: one testsuite per scenario, one testcase per seed. Broken limits and invariants
/// are failures, troubles and crashes are errors, seeds that were not run are skipped. After an interruption the first
/// of these in each testsuite is an error, because CI servers count a skipped case as passed. Times are CPU seconds.
/// A testcase with a recording has the property `recording` and the line `[[ATTACHMENT|FILE]]` in system-out, from
/// which Jenkins (plugin JUnit Attachments) and GitLab attach the file.
[[nodiscard]] std::string junit_xml(const TestResult& result);

}  // namespace tandem::netsim
