#pragma once

#include <optional>
#include <string>
#include <vector>

#include "proto/input_error.h"
#include "proto/profile_spec.h"

/// A network script after validation: every number finite and in range, rules between keys kept. Units are those of the
/// keys in proto/script.proto. Made by proto/script_text.h only.
namespace tandem {

struct ScriptRebind {
  double dead_after_ms = 0;
};

/// Exactly one of outage, profile, rebind is there.
struct ScriptEventSpec {
  double at_s = 0;
  std::vector<std::string> clients;  ///< none: all
  bool up = true, down = true;
  std::optional<ProfileOutage> outage;  ///< begins at at_s
  std::optional<std::string> profile;   ///< as written
  std::optional<ScriptRebind> rebind;
  InputError profile_place;  ///< for a mistake about the profile: everything but its message
};

struct ScriptSpec {
  std::vector<ScriptEventSpec> events;  ///< as written
};

}  // namespace tandem
