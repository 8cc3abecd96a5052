#include "server/app/service/service_list_file.h"

#include <chrono>
#include <string_view>
#include <utility>

#include "common/auth/io/serving_file.h"
#include "common/base/raw_bytes.h"
#include "common/io/thread_without_signals.h"

namespace tandem::server {
namespace {

constexpr auto kLookInterval = std::chrono::seconds(1);
constexpr const char* kListFile = auth::ServingFile::kServiceFile;

}  // namespace

void ServiceListFile::start() {
  thread_ = io::thread_without_signals([this] { run(); });
}

void ServiceListFile::stop() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  wake_.notify_one();
  thread_.join();
  if (folder_.has(kListFile)) static_cast<void>(folder_.remove(kListFile));
}

void ServiceListFile::run() {
  while (true) {
    std::string problem = update();
    if (!problem.empty() && problem != trouble_) on_trouble_(problem);
    trouble_ = std::move(problem);
    std::unique_lock lock(mutex_);
    if (wake_.wait_for(lock, kLookInterval, [this] { return stopping_; })) return;
  }
}

std::string ServiceListFile::update() {
  if (service_.quietly([this](const ServiceMember& member, Time now) { return reader_.look(member, now); }))
    written_ = false;
  if (written_) return {};
  std::string problem = folder_.replace(kListFile, std::string_view(to_text(reader_.list())));
  written_ = problem.empty();
  return problem;
}

std::expected<std::optional<ServiceList>, std::string> read_service_list(const auth::StateDirectory& folder) {
  if (!folder.has(kListFile)) return std::nullopt;
  const auto bytes = folder.read(kListFile);
  if (!bytes) return std::unexpected(bytes.error());
  if (!*bytes) return std::nullopt;
  auto list = parse_service_list(text_of(std::as_const(**bytes).bytes()));
  if (!list)
    return std::unexpected(folder.path_of(kListFile) +
                           ": is no list of the sessions of a service; delete the file, the running server writes "
                           "another when the sessions of the service change");
  return list;
}

}  // namespace tandem::server
