#include "server/app/commands/service_query.h"

#include <chrono>
#include <filesystem>
#include <thread>

#include "common/io/exit_code.h"
#include "proto/io/scene_file.h"
#include "proto/text/server_config_text.h"
#include "server/app/service/service_config.h"
#include "server/app/service/service_specs.h"
#include "server/app/service/service_thread.h"
#include "server/service/service_news.h"

namespace tandem::server {
namespace {

constexpr Duration kReadingMax = std::chrono::seconds(5);
constexpr Duration kRestsMax = std::chrono::seconds(2);
constexpr auto kQueryPause = std::chrono::milliseconds(5);

}  // namespace

ServiceQuery::ServiceQuery(const ServiceOptions& options, const std::string& config)
    : place_("etcd at " + joined_endpoints(options.etcd) + ", prefix \"" + options.prefix + "\" (" + config +
             "); if servers run, compare directory { endpoint, prefix } with theirs"),
      directory_(options.etcd),
      keys_(options.prefix),
      view_(directory::DirectoryKeys(options.prefix)),
      catalogue_(keys_) {}

std::expected<std::unique_ptr<ServiceQuery>, ServiceQuery::Failure> ServiceQuery::open(const std::string& config) {
  const auto text = read_text_file(config);
  if (!text) return std::unexpected(Failure{io::kExitUsage, to_text(text.error())});
  InputErrors errors;
  const auto read = read_server_config(*text, config, errors);
  std::optional<ServiceOptions> options;
  if (read) {
    const auto folder = std::filesystem::path(config).parent_path();
    options = service_options_from(
        *read, std::nullopt, [&](const std::string& named) { return (folder / named).string(); }, errors);
    if (!read->directory)
      errors.push_back(
          {config, 0, 0, "directory", "",
           "is missing: a server of this configuration is alone; `tandem-server sessions` shows its sessions"});
  }
  if (!errors.empty() || !options) return std::unexpected(Failure{io::kExitUsage, to_text(errors)});
  std::unique_ptr<ServiceQuery> query(new ServiceQuery(*options, config));
  if (query->wait(kReadingMax, [&] { return query->view_.readings() > 0 && query->catalogue_.readings() > 0; }))
    return query;
  return std::unexpected(
      Failure{io::kExitTrouble, "the directory of the service does not answer: " + query->trouble_ + ". " +
                                    directory_remedy(joined_endpoints(options->etcd), options->tls_options) + " (" +
                                    config + ")"});
}

LeaseRests ServiceQuery::lease_rests() {
  std::map<directory::OperationId, directory::LeaseId> asked;
  for (const auto& [name, server] : view_.servers()) {
    directory_.begin(++operation_, directory::Remaining{server.lease});
    asked.emplace(operation_, server.lease);
  }
  LeaseRests rests;
  static_cast<void>(wait(kRestsMax, [&] {
    std::erase_if(asked, [&](const auto& question) {
      const auto reply = other_replies_.find(question.first);
      if (reply == other_replies_.end()) return false;
      if (reply->second.outcome == directory::Outcome::kDone) rests[question.second] = reply->second.ttl;
      if (reply->second.outcome == directory::Outcome::kNoLease) rests[question.second] = std::nullopt;
      return true;
    });
    return asked.empty();
  }));
  return rests;
}

Time ServiceQuery::now() noexcept { return ServiceThread::now(); }

void ServiceQuery::pause() { std::this_thread::sleep_for(kQueryPause); }

void ServiceQuery::step() {
  const Time at = now();
  if (const auto request = view_.poll_request(at, operation_ + 1, kReadingMax))
    directory_.begin(++operation_, *request);
  if (const auto request = catalogue_.poll_request(at, operation_ + 1, kReadingMax))
    directory_.begin(++operation_, *request);
  while (const auto reply = directory_.poll()) {
    if (!reply->reason.empty()) trouble_ = reply->reason;
    if (!view_.on_reply(*reply) && !catalogue_.on_reply(*reply)) other_replies_.emplace(reply->operation, *reply);
  }
}

}  // namespace tandem::server
