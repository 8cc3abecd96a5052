#pragma once

#include "server/directory/directory.h"
#include "tests/server/directory/model_check.h"

namespace tandem::directory::test {

/// Changes a request on its way to the store, as a server without the guard would send it.
/// @param immortal  a lease that never ends
void weaken(Guard removed, LeaseId immortal, Request& request);
/// Returns the answer that a server without the confirmation of renewals gives itself; nothing for other requests.
std::optional<Reply> answer_without_store(Guard removed, const std::string& server, LeaseId own, OperationId operation,
                                          const Request& request);
/// Changes a reply on its way to a server, as a server without the guard would understand it.
void weaken(Guard removed, const std::string& server, LeaseId own, Reply& reply);

}  // namespace tandem::directory::test
