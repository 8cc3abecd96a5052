#pragma once

#include <string>

#include "netsim/app/test_run.h"

namespace tandem::netsim {

/// For people: scenarios by seeds, the worst value of each limit beside it, and for each failure its causes and the one
/// command that replays it.
[[nodiscard]] std::string test_summary(const TestResult& result);

/// For machines. Equal seeds and build give equal bytes but for the keys called `cpu_s`:
/// {"version": 1, "verdict": "pass"|"fail", "interrupted": bool, "seeds_run": n, "seeds_failed": n, "seeds_not_run": n, "cpu_s": s, "scenarios":
///  [{"name", "file", "summary", "scene", "network", "seat_networks": [{"seat", "network"}], "duration_s", "verdict", "cpu_s",
///    "notes": [text, about the networks], "limits": [{"subject", "metric", "unit", "min"|null, "max"|null, "worst": value|null, "worst_seed"|null,
///                "margin_percent"|null}],
///    "seeds": [{"seed", "verdict": "pass"|"fail"|"trouble"|"crash"|"not run", "causes": [text], "values": [number|null, one
///               per limit], "violations": [{"invariant", "seat", "at_s", "expected", "count"}], "network": [{"seat", "band":
///               "green"|"amber"|"red"|"too short"}], "notes": [text], "duration_s", "trace_hash",
///               "cpu_s", "replay": command, "report": {...} if asked for}]}]}
/// A number that a run does not have is null.
[[nodiscard]] std::string test_json(const TestResult& result);

/// JUnit XML as CI servers read it: one testsuite per scenario, one testcase per seed; broken limits and invariants are
/// failures, troubles and crashes errors, seeds that were not run skipped; after an interruption the first
/// of these in each testsuite is an error, for readers take skipped ones for a pass. Times are CPU seconds.
[[nodiscard]] std::string junit_xml(const TestResult& result);

}  // namespace tandem::netsim
