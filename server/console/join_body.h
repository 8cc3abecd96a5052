#pragma once

#include <cstddef>
#include <expected>
#include <string>
#include <string_view>

namespace tandem::console {

inline constexpr std::size_t kJoinBodyMax = 2048;    ///< body of POST /join [bytes]
inline constexpr std::size_t kTicketTextMax = 1024;  ///< base32 of rpc::kTicketMax bytes, and its prefix

/// A person signs in.
struct JoinBody {
  std::string ticket;  ///< output of `tandem-server ticket`; secret
  std::string name;    ///< 1 to 32 of A-Z a-z 0-9 _ -, or empty; for display only, nothing proves it
};

/// Parses the body of POST /join: a JSON object or a form [HTML, application/x-www-form-urlencoded] with `ticket` and
/// perhaps `name`.
/// @param content_type  header of the request, with or without parameters
/// @return error: cause and remedy, without the ticket
[[nodiscard]] std::expected<JoinBody, std::string> parse_join_body(std::string_view content_type,
                                                                   std::string_view body);

}  // namespace tandem::console
