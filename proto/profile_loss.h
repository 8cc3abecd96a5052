#pragma once

#include <string>

#include "proto/checker.h"
#include "proto/profile_spec.h"

namespace tandem::pb {
class NetworkPath;
}

/// Private to proto/profile*.cpp: the loss models of one direction.
namespace tandem {

/// Fills the loss models of `path`; mistakes between numbers go to `checker` under `key`.
void loss_from(const pb::NetworkPath& in, ProfilePath& path, text::Checker& checker, const std::string& key);

}  // namespace tandem
