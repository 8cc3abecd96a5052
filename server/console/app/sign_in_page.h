#pragma once

#include <string>
#include <string_view>

#include "proto/rpc/rpc_limits.h"
#include "server/console/join_body.h"

namespace tandem::console {

/// Returns the page with the form of POST /join. It needs no script. The page's own form has the same rules
/// (server/console/web/src/logic/sign_in.ts). @param why  reason of a refusal, for display
[[nodiscard]] inline std::string sign_in_page(std::string_view why) {
  std::string shown;
  for (const char c : why) {
    const std::string_view escaped = c == '<'   ? "&lt;"
                                     : c == '>' ? "&gt;"
                                     : c == '&' ? "&amp;"
                                     : c == '"' ? "&quot;"
                                                : "";
    if (escaped.empty()) {
      shown += c;
    } else {
      shown += escaped;
    }
  }
  if (!shown.empty()) shown = "<p role=\"alert\">" + shown + "</p>";
  return "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
         "<meta name=\"viewport\" content=\"width=device-width\"><meta name=\"color-scheme\" content=\"light dark\">"
         "<link rel=\"icon\" href=\"/assets/icon.svg\" type=\"image/svg+xml\">"
         "<title>Tandem console: sign in</title></head>\n<body><main><h1>Tandem console</h1>" +
         shown +
         "<form method=\"post\" action=\"/join\" autocomplete=\"off\">"
         "<p><label for=\"ticket\">Ticket from the operator (tandem-server ticket)</label><br>"
         "<textarea id=\"ticket\" name=\"ticket\" rows=\"6\" cols=\"48\" maxlength=\"" +
         std::to_string(kTicketTextMax) +
         "\" required autofocus></textarea></p>"
         "<p><label for=\"name\">Name for others to see (optional: A-Z a-z 0-9 _ -)</label><br>"
         "<input id=\"name\" name=\"name\" maxlength=\"" +
         std::to_string(rpc::kNameMax) +
         "\" pattern=\"[A-Za-z0-9_\\-]*\"></p>"
         "<p><button>Sign in</button></p></form></main></body></html>\n";
}

}  // namespace tandem::console
