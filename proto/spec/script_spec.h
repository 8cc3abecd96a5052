#pragma once

#include <optional>
#include <string>
#include <vector>

#include "netsim/models/path_spec.h"
#include "proto/spec/input_error.h"

/// A network script after validation: every number is finite and in range, and rules between keys hold. Units are those
/// of the keys in proto/schema/script.proto. Only proto/text/script_text.h creates it.
namespace tandem {

struct ScriptRebind {
  double dead_after_ms = 0;
};

/// One change. Exactly one of outage, profile and rebind is present.
struct ScriptEventSpec {
  double at_s = 0;
  std::vector<std::string> clients;  ///< empty: all
  bool up = true, down = true;
  std::optional<netsim::OutageSpec> outage;  ///< begins at at_s
  std::optional<std::string> profile;        ///< as written
  std::optional<ScriptRebind> rebind;
  InputError profile_place;  ///< location for an error about the profile: all fields but the message
};

struct ScriptSpec {
  std::vector<ScriptEventSpec> events;  ///< in the order of the file
};

}  // namespace tandem
