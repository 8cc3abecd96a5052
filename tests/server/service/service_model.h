#pragma once

#include "tests/server/directory/model_check.h"

namespace tandem::server::test {

/// Runs a schedule with whole `ServiceMember`s, as `run_schedule` does with cores of the ownership protocol: processes
/// begin again with what they have stored, sessions are opened from the directory, and the store may lose its data.
[[nodiscard]] directory::test::Verdict run_service_schedule(const directory::test::Schedule& schedule);

}  // namespace tandem::server::test
