#include "proto/text/server_config_text.h"

#include <algorithm>
#include <charconv>

#include "proto/schema/server_config.pb.h"
#include "proto/text/message_keys.h"
#include "proto/text/text_format_reader.h"

namespace tandem {
namespace {

using text::child_path;
using text::MessageKey;
using text::MessageValidator;

using Limits = ConnectionLimitsSpec;
constexpr std::array<MessageKey<Limits>, 9> kLimitKeys{{{"accepts_per_s", &Limits::accepts_per_s},
                                                        {"accepts_burst", &Limits::accepts_burst},
                                                        {"accepts_per_s_all", &Limits::accepts_per_s_all},
                                                        {"pending", &Limits::pending},
                                                        {"connections", &Limits::connections},
                                                        {"deadline_s", &Limits::deadline_s},
                                                        {"core_percent", &Limits::core_percent},
                                                        {"created_sessions", &Limits::created_sessions},
                                                        {"threads", &Limits::threads}}};
constexpr std::array<MessageKey<AuditSpec>, 2> kAuditKeys{
    {{"file_mib", &AuditSpec::file_mib}, {"older_files", &AuditSpec::older_files}}};

constexpr std::array<MessageKey<RecordingSpec>, 7> kRecordingKeys{{{"pseudonyms", &RecordingSpec::pseudonyms},
                                                                   {"from_start", &RecordingSpec::from_start},
                                                                   {"file_mib", &RecordingSpec::file_mib},
                                                                   {"file_minutes", &RecordingSpec::file_minutes},
                                                                   {"total_mib", &RecordingSpec::total_mib},
                                                                   {"mib_per_min", &RecordingSpec::mib_per_min},
                                                                   {"inputs_mib", &RecordingSpec::inputs_mib}}};

LocatedText placed(const std::string& value, const MessageValidator& validator, const std::string& key) {
  const text::SourceLocation place = validator.location(key);
  return {value, key, place.line, place.column};
}

/// Rejects an empty text that was written.
LocatedText not_empty(bool written, const std::string& value, MessageValidator& validator, const std::string& key,
                      const char* remedy) {
  if (written && value.empty()) validator.error(key, std::string("is empty; ") + remedy);
  return placed(value, validator, key);
}

/// Whether `name` can stand in a member file: 1 to 32 of A-Z a-z 0-9 _ -
bool is_server_name(std::string_view name) {
  return !name.empty() && name.size() <= 32 && std::ranges::all_of(name, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
}

DirectorySpec directory_from(const pb::DirectoryConfig& in, MessageValidator& validator) {
  constexpr std::size_t kPrefixMax = 128;
  const auto key = [](const char* name) { return child_path("directory", name); };
  DirectorySpec out;
  out.whole = placed("", validator, "directory");
  if (in.endpoint_size() == 0 && !validator.is_set(child_path("directory", "endpoint", 0)))
    validator.error(key("endpoint"), "is missing: name HOST:PORT of at least one member of etcd");
  for (int i = 0; i < in.endpoint_size(); ++i) {
    const std::string path = child_path("directory", "endpoint", i);
    const std::size_t colon = in.endpoint(i).rfind(':');
    const std::string_view port =
        colon == std::string::npos ? std::string_view{} : std::string_view(in.endpoint(i)).substr(colon + 1);
    int number = 0;
    const auto [end, error] = std::from_chars(port.data(), port.data() + port.size(), number);
    if (colon == 0 || port.empty() || error != std::errc{} || end != port.data() + port.size() || number < 1 ||
        number > 65535 || in.endpoint(i).find('/') != std::string::npos)
      validator.error(path, "must be HOST:PORT without a scheme, with a port from 1 to 65535, such as 10.0.0.5:2379");
    out.endpoints.push_back(placed(in.endpoint(i), validator, path));
  }
  if (in.has_prefix()) {
    out.prefix = in.prefix();
    if (out.prefix.size() > kPrefixMax || !out.prefix.starts_with('/') || !out.prefix.ends_with('/') ||
        std::ranges::any_of(out.prefix, [](char c) { return c < '!' || c > '~'; }))
      validator.error(
          key("prefix"),
          "must begin and end with \"/\" and have at most 128 visible ASCII characters, such as /tandem/v1/");
  }
  const auto file = [&](bool written, const std::string& value, const char* name) {
    return not_empty(written, value, validator, key(name), "name a file in PEM, or leave the key out");
  };
  out.authority = file(in.has_authority(), in.authority(), "authority");
  out.certificate = file(in.has_certificate(), in.certificate(), "certificate");
  out.private_key = file(in.has_private_key(), in.private_key(), "private_key");
  const int files = int{in.has_authority()} + int{in.has_certificate()} + int{in.has_private_key()};
  if (files != 0 && files != 3)
    validator.error("directory", "has only some of authority, certificate and private_key: TLS needs all three");
  out.name_in_certificate = in.name_in_certificate();
  if (files == 0 && !out.name_in_certificate.empty())
    validator.error(key("name_in_certificate"), "needs TLS: add authority, certificate and private_key");
  out.server = placed(in.server(), validator, key("server"));
  if (in.has_server() && !is_server_name(in.server()))
    validator.error(key("server"), "must have 1 to 32 of A-Z a-z 0-9 _ -, as in the member file of the server");
  out.address = not_empty(in.has_address(), in.address(), validator, key("address"),
                          "write HOST:PORT at which clients reach this server, or leave the key out");
  out.zone = in.zone();
  if (in.has_ttl_s()) out.ttl_s = in.ttl_s();
  if (in.has_balance()) out.balance = in.balance();
  return out;
}

ConfiguredSessionSpec session_from(const pb::ConfiguredSession& in, MessageValidator& validator,
                                   const std::string& key) {
  ConfiguredSessionSpec out;
  out.name = in.name();
  out.placed_name = placed(in.name(), validator, child_path(key, "name"));
  out.scene =
      not_empty(in.has_scene(), in.scene(), validator, child_path(key, "scene"), "name a shipped scene or a file");
  out.tickets_only = in.entry() == pb::ConfiguredSession::TICKETS;
  if (in.has_restart()) out.restart = in.restart();
  out.duration_s = in.duration_s();
  out.record = not_empty(in.has_record(), in.record(), validator, child_path(key, "record"),
                         "name a folder or a file NAME.mcap, or leave the key out");
  return out;
}

void set_directory(const DirectorySpec& in, pb::DirectoryConfig& out) {
  for (const LocatedText& endpoint : in.endpoints) out.add_endpoint(endpoint.text);
  out.set_prefix(in.prefix);
  if (!in.authority.text.empty()) {
    out.set_authority(in.authority.text);
    out.set_certificate(in.certificate.text);
    out.set_private_key(in.private_key.text);
  }
  if (!in.name_in_certificate.empty()) out.set_name_in_certificate(in.name_in_certificate);
  if (!in.server.text.empty()) out.set_server(in.server.text);
  if (!in.address.text.empty()) out.set_address(in.address.text);
  if (!in.zone.empty()) out.set_zone(in.zone);
  out.set_ttl_s(in.ttl_s);
  out.set_balance(in.balance);
}

}  // namespace

std::expected<ServerConfigSpec, InputErrors> parse_server_config(std::string_view text, std::string_view file_name) {
  InputErrors errors;
  auto config = read_server_config(text, file_name, errors);
  if (!errors.empty()) return std::unexpected(std::move(errors));
  return std::move(*config);
}

std::optional<ServerConfigSpec> read_server_config(std::string_view text, std::string_view file_name,
                                                   InputErrors& errors) {
  MessageValidator validator{file_name};
  pb::ServerConfig in;
  const bool read = text::read_document(text, file_name, in, validator);
  errors = validator.take();
  if (!read) return std::nullopt;

  ServerConfigSpec out;
  out.file = file_name;
  out.listen = not_empty(in.has_listen(), in.listen(), validator, "listen", "write HOST:PORT");
  out.state = not_empty(in.has_state(), in.state(), validator, "state", "name a folder, or leave the key out");
  out.metrics =
      not_empty(in.has_metrics(), in.metrics(), validator, "metrics", "write HOST:PORT, or leave the key out");
  out.reports = not_empty(in.has_reports(), in.reports(), validator, "reports", "name a folder, or leave the key out");
  out.scenes = not_empty(in.has_scenes(), in.scenes(), validator, "scenes", "name a folder, or leave the key out");
  out.record = not_empty(in.has_record(), in.record(), validator, "record", "name a folder, or leave the key out");
  if (in.session_size() == 0 && !validator.is_set("session[0]"))
    validator.error("session", "is missing: a server needs at least one session");
  for (int i = 0; i < in.session_size(); ++i) {
    const std::string key = child_path("", "session", i);
    for (const ConfiguredSessionSpec& other : out.sessions)
      if (!in.session(i).name().empty() && other.name == in.session(i).name())
        validator.error(child_path(key, "name"),
                        "is the name of another session already; each session needs a name of its own");
    out.sessions.push_back(session_from(in.session(i), validator, key));
  }
  text::read_keys(in.limits(), kLimitKeys, out.limits);
  if (in.limits().has_load_percent())
    out.limits.core_percent = std::min(out.limits.core_percent, in.limits().load_percent());
  for (int i = 0; i < in.metrics_host_size(); ++i) {
    const std::string& name = in.metrics_host(i);
    if (name.empty() || name.size() > 253 || name.find_first_of(": /[]\t") != std::string::npos)
      validator.error(child_path("", "metrics_host", i),
                      "must be a computer's name, 1 to 253 characters, without a port");
    out.metrics_hosts.push_back(name);
  }
  text::read_keys(in.audit(), kAuditKeys, out.audit);
  text::read_keys(in.recording(), kRecordingKeys, out.recording);
  if (in.has_directory()) out.directory = directory_from(in.directory(), validator);
  out.log.json = in.log().format() == pb::LogConfig::JSON;
  out.log.level = static_cast<LogSpec::Level>(in.log().level());
  add_unexplained(errors, validator.take());
  return out;
}

std::string effective_server_config_text(const ServerConfigSpec& config) {
  pb::ServerConfig out;
  out.set_version(1);
  out.set_listen(config.listen.text);
  if (!config.state.text.empty()) out.set_state(config.state.text);
  for (const ConfiguredSessionSpec& s : config.sessions) {
    auto& session = *out.add_session();
    session.set_name(s.name);
    session.set_scene(s.scene.text);
    session.set_entry(s.tickets_only ? pb::ConfiguredSession::TICKETS : pb::ConfiguredSession::CODE);
    session.set_restart(s.restart);
    if (s.duration_s > 0) session.set_duration_s(s.duration_s);
    if (!s.record.text.empty()) session.set_record(s.record.text);
  }
  text::write_keys(config.limits, kLimitKeys, *out.mutable_limits());
  out.mutable_log()->set_format(config.log.json ? pb::LogConfig::JSON : pb::LogConfig::TEXT);
  out.mutable_log()->set_level(static_cast<pb::LogConfig::Level>(config.log.level));
  if (!config.metrics.text.empty()) out.set_metrics(config.metrics.text);
  for (const std::string& name : config.metrics_hosts) out.add_metrics_host(name);
  if (!config.reports.text.empty()) out.set_reports(config.reports.text);
  if (!config.scenes.text.empty()) out.set_scenes(config.scenes.text);
  if (!config.record.text.empty()) out.set_record(config.record.text);
  text::write_keys(config.audit, kAuditKeys, *out.mutable_audit());
  text::write_keys(config.recording, kRecordingKeys, *out.mutable_recording());
  if (config.directory) set_directory(*config.directory, *out.mutable_directory());
  return text::listing(out);
}

}  // namespace tandem
