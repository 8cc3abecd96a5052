#include "server/app/service/service_list_file.h"

#include <string_view>
#include <utility>

#include "common/auth/io/serving_file.h"
#include "common/base/raw_bytes.h"

namespace tandem::server {
namespace {

constexpr const char* kListFile = auth::ServingFile::kServiceFile;

}  // namespace

void ServiceListFile::stop() {
  if (!task_.running()) return;
  task_.stop();
  if (folder_.has(kListFile)) static_cast<void>(folder_.remove(kListFile));
}

std::string ServiceListFile::update() {
  const bool whole = looks_++ % kWhole == 0;
  const bool changed = service_.quietly([&](const ServiceMember& member, Time now) {
    return whole ? reader_.look(member, now) : reader_.look_at_directory(member, now);
  });
  if (changed) written_ = false;
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
